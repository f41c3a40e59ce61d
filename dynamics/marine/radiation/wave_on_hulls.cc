#include "dynamics/marine/radiation/wave_on_hulls.h"

#include <numbers>

#include "dynamics/marine/radiation/incident_wave.h"

namespace blocklift::dynamics {
namespace {

struct PointOnPanel {
  Vector3 p_W;
  double area;  ///< its share of the panel's
};

/// 2 x 2 points of Gauss' rule. The fourth vertex of a triangle is its third: the map onto the
/// square is singular there and nowhere else, and no point lies there.
std::array<PointOnPanel, 4> points_on(const Panel& panel) {
  constexpr double at = std::numbers::inv_sqrt3;
  const auto& [a, b, c, d] = panel.vertices;
  std::array<PointOnPanel, 4> points;
  std::size_t count = 0;
  for (const double u : {-at, at}) {
    for (const double v : {-at, at}) {
      const Vector3 along = 0.25 * ((1 - v) * (b - a) + (1 + v) * (c - d));
      const Vector3 across = 0.25 * ((1 - u) * (d - a) + (1 + u) * (c - b));
      points[count++] = {0.25 * ((1 - u) * (1 - v) * a + (1 + u) * (1 - v) * b +
                                 (1 + u) * (1 + v) * c + (1 - u) * (1 + v) * d),
                         along.cross(across).dot(panel.normal)};
    }
  }
  return points;
}

}  // namespace

WaveOnHulls::WaveOnHulls(const PanelModel& model)
    : water_(model.water()), moves_(Eigen::VectorXd::Zero(model.mode_count())) {
  Eigen::Index first_mode = 0;
  for (const WettedBody& body : model.bodies()) {
    for (const Panel& panel : expand_symmetry(body.hull).panels) {
      for (const PointOnPanel& point : points_on(panel)) {
        Eigen::Matrix<double, 6, 1> direction;
        direction << panel.normal, (point.p_W - body.reference_point).cross(panel.normal);
        samples_.push_back({point.p_W, first_mode, point.area * direction});
      }
    }
    first_mode += modes_per_body;
  }
  for (const Parity& parity : model.parities()) {
    const Eigen::MatrixXd velocities = model.normal_velocities(parity);
    for (Eigen::Index m = 0; m < moves_.size(); ++m) {
      if (!velocities.col(m).isZero(0.0)) moves_[m] = 1.0;
    }
  }
}

Eigen::MatrixXcd WaveOnHulls::integrate_potential(double frequency,
                                                  const std::vector<double>& headings) const {
  Eigen::MatrixXcd result =
      Eigen::MatrixXcd::Zero(moves_.size(), static_cast<Eigen::Index>(headings.size()));
  for (std::size_t h = 0; h < headings.size(); ++h) {
    const IncidentWave wave(water_, frequency, headings[h]);
    auto column = result.col(static_cast<Eigen::Index>(h));
    for (const Sample& sample : samples_) {
      column.segment<modes_per_body>(sample.first_mode) +=
          wave.potential(sample.p_W) * sample.direction;
    }
  }
  return moves_.asDiagonal() * result;
}

}  // namespace blocklift::dynamics
