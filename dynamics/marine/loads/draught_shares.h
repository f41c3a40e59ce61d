#pragma once

#include <vector>

#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// States of the water that a series may have, the dry one among them.
inline constexpr int most_draughts = 32;

/// Where the draught of a body that is lowered into the water is read: the depth of its point K, of
/// the keel below amidships, under the calm surface z = 0, m.
struct DraughtMark {
  BodyIndex body = -1;
  Vector3 p_BoK_B = Vector3::Constant(not_a_number);

  double calc_draught(const Kinematics& kinematics) const;
  /// From the pose of the body.
  double calc_draught(const Pose& X_WB) const { return -X_WB.apply(p_BoK_B).z(); }
  /// How fast it grows, m/s.
  double calc_rate(const Kinematics& kinematics) const;
};

/// What counts of each of a series' states at one draught.
struct DraughtShares {
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_draughts, 1>;

  Values weight = Values::Ones(1);  ///< of each state: 0 to 1, their sum is 1
  Values gain = Values::Ones(1);    ///< its square root
  /// Of each step from a state to the next deeper one: how much of it is done, 0 to 1; weight k is
  /// passed k-1 less passed k. And its derivative by the draught, 1/m, never negative.
  Values passed, slope;
  double rate = 0.0;  ///< of the draught, m/s
};

/// Interpolation between states of the water at several draughts, the first of which is dry (0 m).
///
/// Linear between the draughts, with corners rounded by parabolas over a tenth of the lesser step
/// on either side, so that what is interpolated has a continuous derivative: weights are not
/// negative, and a linear function is met exactly outside of the corners. At and above the surface
/// all is that of the dry state; the first corner lies between 0 and a tenth of the first draught.
/// Beyond the greatest draught nothing changes.
class DraughtInterpolation {
 public:
  /// A single state at whatever draught.
  DraughtInterpolation() = default;
  /// @throws ModelError if the first draught (m) is not zero, they do not ascend, or are more than
  ///   most_draughts.
  explicit DraughtInterpolation(const std::vector<double>& draughts);

  /// Number of states.
  Eigen::Index count() const { return corner_.size() == 0 ? 1 : corner_.size(); }
  /// At a draught (m); its rate is left to the caller. Does not allocate.
  DraughtShares calc_shares(double draught) const;

 private:
  DraughtShares::Values corner_, half_width_;  ///< m
};

}  // namespace blocklift::dynamics
