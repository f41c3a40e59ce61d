#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace blocklift::pipeline {

/// Where a rope of the rigging ends.
struct RiggingEnd {
  enum class Kind { fixed, hook, load, bar } kind = Kind::fixed;
  int index = -1;  ///< of the hook or of the spreader bar
  /// Of load and bars: from the centre of mass, m.
  Eigen::Vector3d r_W = Eigen::Vector3d::Zero();
};

/// Rope of the rigging about a state of equilibrium.
struct RiggingRope {
  RiggingEnd lower, upper;
  Eigen::Vector3d direction_W =
      Eigen::Vector3d::UnitZ();  ///< unit, from the lower to the upper end
  double tension = 0;            ///< N
  double length = 0;             ///< between its ends, m
  double compliance = 0;         ///< m/N
};

/// How tensions share anew about a state of equilibrium: a rigid load on taut elastic ropes, hooks
/// that move freely and rigid spreader bars between them, to the first order of small
/// displacements,
///   K x = f + B^T F^-1 e,   dT = F^-1 (B x - e),   K = B^T F^-1 B + K_g,
/// B the elongation of each rope by the displacements x of load and bars (6 each) and hooks (3
/// each), F the ropes' compliance with those of the load at its lugs and of frames at their eyes, e
/// how much longer than meant each rope is,
/// K_g what the tensions turn with (strings and pendulum), f outer forces. A rope that would push
/// is taken off and the rest solved again. For four equal slings on one hook and a rigid load the
/// errors +d, -d, +d, -d give dT = EA d / L each. Source: Przemieniecki (1968), Theory of Matrix
/// Structural Analysis, chapters 8 and 15.
class RiggingBalance {
 public:
  /// @param compliance of the load and of what else gives way at the ropes' ends along them, ropes
  ///   x ropes, m/N; empty: all but the ropes is rigid.
  RiggingBalance(std::vector<RiggingRope> ropes, int hooks, Eigen::MatrixXd compliance = {},
                 int bars = 0);

  /// Tensions (N) where ropes are longer than meant, m.
  Eigen::VectorXd with_length_errors(const Eigen::VectorXd& errors) const;
  /// Tensions under an additional moment on the load, in W about its centre of mass, N m.
  Eigen::VectorXd with_moment(const Eigen::Vector3d& moment_W) const;

  /// Visits the tensions of each set of signs of the lengths' tolerances (m, 0: exact).
  /// @throws std::invalid_argument with more than most_toleranced ropes of a tolerance.
  void visit_sets(const Eigen::VectorXd& tolerance,
                  const std::function<void(const Eigen::VectorXd& tension)>& visit) const;
  /// The largest tension of each rope over all of them.
  Eigen::VectorXd largest_by_tolerance(const Eigen::VectorXd& tolerance) const;

  static constexpr int most_toleranced = 12;

 private:
  Eigen::VectorXd solve(const Eigen::VectorXd& errors, const Eigen::VectorXd& force) const;
  void add_rope(std::size_t rope);
  Eigen::Index first_of(const RiggingEnd& end) const;
  Eigen::MatrixXd displacement_of(const RiggingEnd& end) const;

  std::vector<RiggingRope> ropes_;
  int bars_ = 0;
  bool turns_freely_ = false;   ///< All hangs on one rope.
  Eigen::MatrixXd elongation_;  ///< B
  Eigen::MatrixXd compliance_;  ///< F
  Eigen::VectorXd tension_;
  std::vector<Eigen::MatrixXd> turning_;  ///< K_g of each rope
};

/// Rigging at an instant at rest whose lengths are not exact, without what frames give way.
struct TolerancedRigging {
  /// A spreader's attitude, and its centre of mass in its own axes, m.
  struct Bar {
    Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  };
  std::vector<RiggingRope> ropes;
  std::vector<Bar> bars;
  int hooks = 0;
  Eigen::MatrixXd load_compliance;  ///< ropes x ropes, m/N; empty: the load is rigid
  Eigen::VectorXd tolerance;        ///< of each rope's length, m
  std::vector<int> in_system;       ///< index of each rope in the lift's system
};

}  // namespace blocklift::pipeline
