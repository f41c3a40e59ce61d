#pragma once

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
/// each), F the
/// ropes' compliance with that of the load at its lugs, e how much longer than meant each rope is,
/// K_g what the tensions turn with (strings and pendulum), f outer forces. A rope that would push
/// is taken off and the rest solved again. For four equal slings on one hook and a rigid load the
/// errors +d, -d, +d, -d give dT = EA d / L each. Source: Przemieniecki (1968), Theory of Matrix
/// Structural Analysis, chapters 8 and 15.
class RiggingBalance {
 public:
  /// @param load_compliance of the load at the ropes' ends along them, ropes x ropes, m/N; empty:
  /// the
  ///   load is rigid.
  RiggingBalance(std::vector<RiggingRope> ropes, int hooks, Eigen::MatrixXd load_compliance = {},
                 int bars = 0);

  /// Tensions (N) where ropes are longer than meant, m.
  Eigen::VectorXd with_length_errors(const Eigen::VectorXd& errors) const;
  /// Tensions under an additional moment on the load, in W about its centre of mass, N m.
  Eigen::VectorXd with_moment(const Eigen::Vector3d& moment_W) const;

  /// The largest tension of each rope over all signs of its length's tolerance (m, 0: exact).
  /// @throws std::invalid_argument with more than most_toleranced ropes of a tolerance.
  Eigen::VectorXd largest_by_tolerance(const Eigen::VectorXd& tolerance) const;

  static constexpr int most_toleranced = 12;

 private:
  Eigen::VectorXd solve(const Eigen::VectorXd& errors, const Eigen::VectorXd& force) const;
  void add_rope(std::size_t rope);
  Eigen::Index first_of(const RiggingEnd& end) const;
  Eigen::MatrixXd displacement_of(const RiggingEnd& end) const;

  std::vector<RiggingRope> ropes_;
  int bars_ = 0;
  Eigen::MatrixXd elongation_;  ///< B
  Eigen::MatrixXd compliance_;  ///< F
  Eigen::VectorXd tension_;
  std::vector<Eigen::MatrixXd> turning_;  ///< K_g of each rope
};

}  // namespace blocklift::pipeline
