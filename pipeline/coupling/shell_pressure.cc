#include "pipeline/coupling/shell_pressure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include "algebra/decompositions.h"
#include "dynamics/marine/hull/wet_triangle.h"

namespace blocklift::pipeline {

namespace {

using dynamics::HullForce;
using dynamics::Pose;
using dynamics::Vector3;
using dynamics::WaveField;

// Height of each point above the surface (m), and pressure over rho g there.
void find_water(const WaveField& waves, bool in_waves, double time, const Pose& X_WB,
                const std::vector<Vector3>& points_B, Eigen::VectorXd& height,
                Eigen::VectorXd& head) {
  std::array<Vector3, WaveField::most_points> place;
  std::array<double, WaveField::most_points> elevation{}, dynamic_head{};
  for (std::size_t first = 0; first < points_B.size(); first += WaveField::most_points) {
    const std::size_t count = std::min(points_B.size() - first, WaveField::most_points);
    for (std::size_t i = 0; i < count; ++i) place[i] = X_WB.apply(points_B[first + i]);
    if (in_waves)
      waves.calc_surface(time, {place.data(), count}, {elevation.data(), count},
                         {dynamic_head.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<Eigen::Index>(first + i);
      height[at] = place[i].z() - elevation[i];
      head[at] = dynamic_head[i] - place[i].z();
    }
  }
}

// Wrenches of a history, a column a sample.
Eigen::MatrixXd wrenches_of(const ShellPressure& pressure, Eigen::Index rows, const HullForce& hull,
                            const dynamics::History& history) {
  const HullForce::Definition& definition = hull.definition();
  const dynamics::BodyHistory& body = history.bodies[definition.body - 1];
  const bool in_waves = definition.wave_loading == dynamics::WaveLoading::froude_krylov &&
                        !definition.sea->waves.is_still();
  Eigen::MatrixXd wrenches(rows, history.sample_count());
  for (Eigen::Index sample = 0; sample < history.sample_count(); ++sample)
    pressure.calc_wrenches(*definition.sea, in_waves, history.time(sample), body.X_WB(sample),
                           wrenches.col(sample));
  return wrenches;
}

// Force and moment about Bo of regions' wrenches, a column each.
Eigen::MatrixXd resultants_of(const structure::ShellRegions& shell,
                              const Eigen::MatrixXd& wrenches) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(6, wrenches.cols());
  for (std::size_t r = 0; r < shell.regions().size(); ++r) {
    const auto of_region = wrenches.middleRows<6>(6 * r);
    sum += of_region;
    for (Eigen::Index k = 0; k < wrenches.cols(); ++k)
      sum.col(k).tail<3>() +=
          shell.regions()[r].centre_B.cross(Vector3(of_region.col(k).head<3>()));
  }
  return sum;
}

// The fewest modes (columns of `modes`, most important first) that leave no more than the tolerance
// of the largest column, and what they leave.
std::pair<Eigen::Index, double> count_modes(const Eigen::MatrixXd& modes,
                                            const Eigen::MatrixXd& columns, double tolerance) {
  Eigen::VectorXd left = columns.colwise().squaredNorm();
  const double largest = left.maxCoeff();
  Eigen::Index count = 0;
  while (count < modes.cols() && left.maxCoeff() > tolerance * tolerance * largest) {
    left -= (modes.col(count).transpose() * columns).colwise().squaredNorm().transpose();
    ++count;
  }
  return {count, std::sqrt(std::max(0.0, left.maxCoeff()) / largest)};
}

}  // namespace

ShellPressure::ShellPressure(const dynamics::Hull& hull, const structure::ShellRegions& shell)
    : points_B_(hull.vertices()) {
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const auto corners = hull.panel(panel);
    const int region =
        shell.nearest(hull.panel_midpoint(panel), hull.panel_area_vector(panel).normalized());
    for (std::size_t i = 2; i < corners.size(); ++i)
      panels_.push_back({{corners[0], corners[i - 1], corners[i]}, region});
  }
  for (const structure::ShellRegion& region : shell.regions())
    centres_B_.push_back(region.centre_B);
}

void ShellPressure::calc_wrenches(const dynamics::Sea& sea, bool in_waves, double time,
                                  const Pose& X_WB, Eigen::Ref<Eigen::VectorXd> wrenches) const {
  wrenches.setZero();
  const auto count = static_cast<Eigen::Index>(points_B_.size());
  Eigen::VectorXd height(count), head(count);
  find_water(sea.waves, in_waves, time, X_WB, points_B_, height, head);
  if (height.minCoeff() >= 0) return;
  const double rho_g = sea.water().density * sea.water().gravity;
  for (const Panel& panel : panels_) {
    std::array<Vector3, 3> p;
    std::array<double, 3> heights{}, heads{};
    for (std::size_t i = 0; i < 3; ++i) {
      const int point = panel.points[i];
      p[i] = points_B_[point] - centres_B_[panel.region];
      heights[i] = height[point];
      heads[i] = head[point];
    }
    const Vector3 area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
    dynamics::ForceVector F = dynamics::ForceVector::zero();
    dynamics::add_wet_part({&p[0], &p[1], &p[2]}, heights, heads, area, F);
    wrenches.segment<3>(6 * panel.region) += rho_g * F.force;
    wrenches.segment<3>(6 * panel.region + 3) += rho_g * F.moment;
  }
}

const HullForce* find_hull(const dynamics::LiftSystem& system, dynamics::BodyIndex body) {
  for (const HullForce& hull : std::get<std::vector<HullForce>>(system.elements()))
    if (hull.definition().body == body) return &hull;
  return nullptr;
}

std::optional<PressureBasis> find_pressure_basis(const structure::ElasticModel& model,
                                                 const HullForce& at_rest,
                                                 const dynamics::History& static_history,
                                                 const HullForce& in_motion,
                                                 const dynamics::History& dynamic_history,
                                                 const PressureSettings& settings) {
  const structure::ShellRegions shell(model, settings.region_size);
  const ShellPressure pressure(in_motion.definition().hull->hull(), shell);
  const auto regions = static_cast<Eigen::Index>(shell.regions().size());
  const Eigen::Index static_count = static_history.sample_count();
  Eigen::MatrixXd wrenches(6 * regions, static_count + dynamic_history.sample_count());
  wrenches << wrenches_of(pressure, 6 * regions, at_rest, static_history),
      wrenches_of(pressure, 6 * regions, in_motion, dynamic_history);
  if (wrenches.isZero(0)) return {};

  Eigen::VectorXd scale(6 * regions);
  scale.reshaped(6, regions).topRows<3>().setOnes();
  scale.reshaped(6, regions).bottomRows<3>().setConstant(2 / settings.region_size);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * wrenches;
  const auto system = algebra::symmetric_eigensystem<Eigen::Dynamic>(scaled * scaled.transpose());
  const Eigen::MatrixXd modes = system.vectors.rowwise().reverse();
  const auto [count, error] = count_modes(modes, scaled, settings.tolerance);

  PressureBasis basis;
  basis.regions = static_cast<int>(regions);
  basis.error = error;
  const Eigen::MatrixXd factors = modes.leftCols(count).transpose() * scaled;
  const Eigen::MatrixXd fields = scale.cwiseInverse().asDiagonal() * modes.leftCols(count);
  basis.loads = shell.loads(fields);
  basis.resultants = resultants_of(shell, fields);
  basis.static_factors = factors.leftCols(static_count);
  basis.dynamic_factors = factors.rightCols(dynamic_history.sample_count());
  basis.largest_force = (basis.resultants.topRows<3>() * factors).colwise().norm().maxCoeff();
  return basis;
}

}  // namespace blocklift::pipeline
