#include "pipeline/coupling/edge_loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "algebra/decompositions.h"
#include "dynamics/rope/edge_wrap.h"
#include "dynamics/rope/rope.h"
#include "structure/response/line_loads.h"

namespace blocklift::pipeline {

namespace {

using dynamics::EdgeHistory;
using dynamics::History;
using dynamics::PlacedEdge;
using dynamics::RopeHistory;
using dynamics::Vector3;

constexpr int gauss_points = 10;  // exact to rounding for wraps up to a full turn

/// Points and weights on (0, 1), by the eigenvalues of Jacobi's matrix (Golub and Welsch 1969).
std::array<std::pair<double, double>, gauss_points> make_gauss_rule() {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(gauss_points, gauss_points);
  for (int k = 1; k < gauss_points; ++k)
    jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
  const auto [values, vectors] = algebra::symmetric_eigensystem<Eigen::Dynamic>(jacobi);
  std::array<std::pair<double, double>, gauss_points> rule;
  for (int k = 0; k < gauss_points; ++k) {
    const double first = vectors(0, k);
    rule[k] = {0.5 * (1 + values[k]), first * first};
  }
  return rule;
}

/// Shares of equal steps from `low` to `high` in a value between them.
struct Steps {
  double low = 0, width = 0;
  int count = 1;  // of places

  Steps(double from, double to, double widest, int most) : low(from) {
    if (!(to - from > 1e-9)) return;
    const double steps = std::ceil((to - from) / widest - 1e-9);
    count = 1 + static_cast<int>(std::clamp(steps, 1.0, static_cast<double>(most)));
    width = (to - from) / (count - 1);
  }
  double place(int i) const { return low + i * width; }
  /// The lower neighbour of a value and the share of the upper one.
  std::pair<int, double> share(double value) const {
    if (count == 1) return {0, 0};
    const double steps = std::clamp((value - low) / width, 0.0, count - 1.0);
    const int below = std::min(static_cast<int>(steps), count - 2);
    return {below, steps - below};
  }
};

/// What one rope does at one edge.
class RopeAtEdge {
 public:
  RopeAtEdge(const BuiltLift& lift, const LiftRope& rope, std::size_t edge,
             const History& static_history, const History& dynamic_history)
      : edge_(lift.system.ropes()[rope.rope].edges()[edge].in_body()),
        length_(rope.edges[edge].length),
        contact_length_(rope.edges[edge].contact_length) {
    take(static_history, lift.system, rope.rope, edge, pushes_[0]);
    take(dynamic_history, lift.system, rope.rope, edge, pushes_[1]);
  }

  bool presses() const { return low_place_ <= high_place_; }

  /// Adds its unit loads, and their factors in both histories.
  void add_to(EdgeBasis& basis, int rope, const structure::LineLoads& lines) const {
    const bool round = edge_.radius > 0;
    const int most = round ? 8 : 24;
    const Steps places(low_place_, high_place_, 0.5 * contact_length_, most);
    const Steps angles(low_angle_, high_angle_, std::numbers::pi / 6, 12);
    const Eigen::Index unit_forces = 3 * static_cast<Eigen::Index>(places.count) * angles.count;
    const auto samples = [&](int history) {
      return static_cast<Eigen::Index>(pushes_[history].size());
    };
    std::array<Eigen::MatrixXd, 2> factors;
    for (int history = 0; history < 2; ++history) {
      Eigen::MatrixXd& of = factors[history];
      of = Eigen::MatrixXd::Zero(unit_forces, samples(history));
      for (Eigen::Index sample = 0; sample < samples(history); ++sample)
        for (const EdgePush& push : pushes_[history][sample])
          share_out(push, places, angles, of.col(sample));
    }
    const double half = std::max(0.5 * contact_length_, places.width);
    for (int k = 0; k < places.count; ++k)
      for (int j = 0; j < angles.count; ++j) {
        const Eigen::Index row = 3 * (static_cast<Eigen::Index>(k) * angles.count + j);
        if (factors[0].middleRows<3>(row).isZero(0) && factors[1].middleRows<3>(row).isZero(0))
          continue;
        structure::LineStretch stretch;
        stretch.middle_B = edge_.begin_W + places.place(k) * edge_.along_W;
        stretch.along_B = edge_.along_W;
        stretch.half_length = half;
        if (round) stretch.to_plates_B = edge_.radius * edge_.normal_W(angles.place(j));
        append(basis.loads, lines.unit_forces(stretch));
        Eigen::Matrix<double, 6, 3> resultants;
        resultants.topRows<3>().setIdentity();
        for (int axis = 0; axis < 3; ++axis)
          resultants.col(axis).tail<3>() = stretch.middle_B.cross(Vector3::Unit(axis));
        append(basis.resultants, resultants);
        basis.ropes.insert(basis.ropes.end(), 3, rope);
        append_rows(basis.static_factors, factors[0].middleRows<3>(row));
        append_rows(basis.dynamic_factors, factors[1].middleRows<3>(row));
      }
  }

 private:
  using Samples = std::vector<std::vector<EdgePush>>;

  void take(const History& history, const dynamics::LiftSystem& system, int rope, std::size_t edge,
            Samples& samples) {
    for (Eigen::Index sample = 0; sample < history.sample_count(); ++sample) {
      std::vector<EdgePush> pushes = edge_pushes(history, sample, system, rope, edge);
      for (EdgePush& push : pushes) {
        push.place = std::clamp(push.place, 0.0, length_);
        low_place_ = std::min(low_place_, push.place);
        high_place_ = std::max(high_place_, push.place);
        low_angle_ = std::min(low_angle_, push.angle);
        high_angle_ = std::max(high_angle_, push.angle);
      }
      samples.push_back(std::move(pushes));
    }
  }

  static void share_out(const EdgePush& push, const Steps& places, const Steps& angles,
                        Eigen::Ref<Eigen::VectorXd> factors) {
    const auto [place, of_next_place] = places.share(push.place);
    const auto [angle, of_next_angle] = angles.share(push.angle);
    for (int k = 0; k < std::min(2, places.count); ++k)
      for (int j = 0; j < std::min(2, angles.count); ++j) {
        const double weight = (k == 0 ? 1 - of_next_place : of_next_place) *
                              (j == 0 ? 1 - of_next_angle : of_next_angle);
        factors.segment<3>(3 * (static_cast<Eigen::Index>(place + k) * angles.count + angle + j)) +=
            weight * push.force_B;
      }
  }

  static void append(Eigen::MatrixXd& all, const Eigen::MatrixXd& more) {
    all.conservativeResize(more.rows(), all.cols() + more.cols());
    all.rightCols(more.cols()) = more;
  }
  static void append_rows(Eigen::MatrixXd& all, const Eigen::MatrixXd& more) {
    all.conservativeResize(all.rows() + more.rows(), more.cols());
    all.bottomRows(more.rows()) = more;
  }

  PlacedEdge edge_;
  double length_, contact_length_;
  std::array<Samples, 2> pushes_;  // at rest, in motion
  double low_place_ = std::numeric_limits<double>::infinity();
  double high_place_ = -std::numeric_limits<double>::infinity();
  double low_angle_ = std::numeric_limits<double>::infinity();
  double high_angle_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<EdgePush> edge_pushes(const History& history, Eigen::Index sample,
                                  const dynamics::LiftSystem& system, int rope, std::size_t edge) {
  const RopeHistory& pulling = history.ropes[rope];
  const EdgeHistory& at = pulling.edges[edge];
  if (!at.touches(sample) || !(pulling.tension[sample] > 0)) return {};
  const dynamics::RopeEdge& definition = system.ropes()[rope].edges()[edge];
  if (!(definition.radius > 0)) {
    const dynamics::Pose X_WB = history.bodies[definition.body - 1].X_WB(sample);
    return {{at.first_place[sample], 0,
             X_WB.R.transpose() * Vector3(at.force.row(sample).transpose())}};
  }
  static const auto rule = make_gauss_rule();
  const PlacedEdge placed = definition.in_body();
  const double turned = at.last_angle[sample] - at.first_angle[sample];
  const double advance = at.last_place[sample] - at.first_place[sample];
  const double across = definition.radius * at.wrap[sample];
  const double cosine = across / std::hypot(across, advance);
  const double sine = advance / std::hypot(across, advance);
  const double first = at.first_tension[sample], last = at.last_tension[sample];
  const double growth = first > 0 && last > 0 ? std::log(last / first) : 0;
  std::vector<EdgePush> pushes;
  for (const auto& [share, weight] : rule) {
    EdgePush push;
    push.place = at.first_place[sample] + share * advance;
    push.angle = at.first_angle[sample] + share * turned;
    const double tension = first * std::exp(growth * share);
    const Vector3 direction =
        cosine * (turned < 0 ? -1 : 1) * placed.tangent_W(push.angle) + sine * placed.along_W;
    push.force_B = tension * weight *
                   (growth * direction - cosine * at.wrap[sample] * placed.normal_W(push.angle));
    pushes.push_back(push);
  }
  return pushes;
}

std::optional<EdgeBasis> find_edge_basis(const structure::ElasticModel& model,
                                         const BuiltLift& lift, const History& static_history,
                                         const History& dynamic_history) {
  EdgeBasis basis;
  std::optional<structure::LineLoads> lines;
  for (const LiftRope& rope : lift.ropes)
    for (std::size_t edge = 0; edge < rope.edges.size(); ++edge) {
      const RopeAtEdge at(lift, rope, edge, static_history, dynamic_history);
      if (!at.presses()) continue;
      if (!lines) lines.emplace(model.space());
      at.add_to(basis, rope.rope, *lines);
    }
  if (basis.ropes.empty()) return std::nullopt;
  return basis;
}

}  // namespace blocklift::pipeline
