#pragma once

#include <vector>

#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// Forces of a sea of many waves, found ahead of an integration (ForecastForces): a sum over
/// hundreds of waves at hundreds of points of a hull costs far more than all else of a lift, whose
/// steps are as short as its ropes vibrate, while hulls and waves change slowly.
///
/// At each instant of equal distance, once a step is about to come to it, the force of waves on
/// each HullForce, and each DiffractionForce, is found where the bodies will be: at
///
///   q (+) (v h + vdot h^2/2)    from the last accepted state, h ahead.
///
/// Of a hull's force only what is left beside that of a plane surface is interpolated between these
/// instants: the plane (WaterPlaneOfWaves) is interpolated too, and its force, which is exact at
/// any pose, is that of the pose itself. So a hull that is not quite where it was to be meets the
/// stiffness of the water as the waves raise and tilt it, however shallow it floats; what is left
/// changes with the place by k d of itself over a distance d. Were buoyancy that of still water,
/// a hull of draught T that is d too high would meet a force that is d / T of its weight off as
/// soon as waves are higher than its freeboard.
///
/// Interpolation leaves ForecastForces::remainder (w h)^6 of a wave of frequency w. The distance h
/// of the instants is the largest that leaves `tolerance` of the sea's elevation in the square
/// mean, `share_of_heave` over the frequency sqrt(2 g / D) at most for a hull of the depth D (at
/// which it bobs, floating with half of its depth), and `longest_interval` at most. The force on a
/// hull that bobs faster than `fastest_heave` is found at each state: it moves as fast as the steps
/// are.
///
/// What cannot be foreseen is found out. With each instant the interpolation's error follows from
/// sixth differences. Forces are also found at accepted states themselves and held against what was
/// forecast for them: at each instant until all are trusted, and then after twice as many each
/// time, `instants_of_check` at most. A force is made use of once it has passed `passes_to_trust`
/// checks in a row. Where either is off by more than the share sqrt(relative tolerance) of the
/// largest force of waves on that body so far, `largest_share` at most, the force rests: it is
/// found at each state for `first_rest`, and for twice as long each time that it was trusted. The
/// integration starts anew then.
class WaveForecast {
 public:
  static constexpr double tolerance = 1e-5;
  static constexpr double share_of_heave = 0.2;
  static constexpr double fastest_heave = 4.0;     ///< rad/s
  static constexpr double longest_interval = 0.2;  ///< s
  static constexpr double largest_share = 5e-4;
  static constexpr int instants_of_check = 8;
  static constexpr int passes_to_trust = 3;
  static constexpr double first_rest = 2.0;  ///< s

  /// Of a lift without many waves: nothing is ever forecast.
  WaveForecast(const LiftSystem& system, double relative_tolerance);

  /// Is there anything to forecast?
  bool is_needed() const { return interval_ > 0.0; }
  /// The run begins at this time (s).
  void begin(double time, LiftWorkspace& w);
  /// Is there something to do before a step from `time` to `until` (s)?
  bool is_due(double time, double until, const LiftWorkspace& w) const;
  /// Checks the forecast and carries it on, from the workspace's q, v and vdot, which are those
  /// accepted at `time`. Does not allocate. Does a force rest now that was trusted, so that forces
  /// jump?
  bool carry_on(double time, double until, LiftWorkspace& w);

 private:
  struct Standing {
    long first = 0;            ///< instant from which on the force is found ahead
    int passed = 0;            ///< checks in a row
    double rest = first_rest;  ///< the next one, s
    bool is_trusted() const { return passed >= passes_to_trust; }
  };
  /// Pose and velocities so far (s) ahead of the workspace's.
  void foresee(double ahead, const LiftWorkspace& w);
  void add_instant(double ahead, LiftWorkspace& w);
  void check(double time, LiftWorkspace& w);
  /// Of the force `number`, at a state; what waves add to still water may be the largest so far.
  ForceVector find_exact(std::size_t number, const MotionState& state);
  /// Is the error small enough? If not the force rests from now on.
  bool judge(std::size_t number, const ForceVector& error, double time, LiftWorkspace& w);

  const LiftSystem& system_;
  const std::vector<HullForce>& hulls_;
  const std::vector<DiffractionForce>& others_;
  double share_;
  double interval_ = 0.0;  ///< s
  Kinematics kinematics_;
  Eigen::VectorXd q_, velocity_;
  std::vector<WaterPlaneOfWaves> planes_;  ///< of each hull
  long next_check_ = 0;                    ///< instant
  bool any_rests_ = false;                 ///< of those trusted, since carry_on was called
  int between_checks_ = 1;                 ///< instants
  // Of each force, of hulls first:
  std::vector<double> largest_force_, largest_moment_;  ///< N, N m
  std::vector<Standing> standing_;
};

}  // namespace blocklift::dynamics
