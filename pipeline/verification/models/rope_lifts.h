#pragma once

#include <limits>
#include <vector>

#include "dynamics/simulation/lift_system.h"

/// Loads on ropes with references in closed form or from other programs: of the verification suite,
/// and shared by tests and benchmarks.
namespace blocklift::dynamics::examples {

inline constexpr double g = 9.81;  ///< m/s2

/// Limits so wide that a move is as good as instant in its speed: "grips at once".
inline MotionLimits abrupt(double speed) { return {speed, 1e6 * speed, 1e13 * speed}; }

/// A point load on one rope from a fixed point at the origin, hanging below it.
struct SingleRopeLift {
  double mass = 10e3;                                                ///< kg
  double length = 20.0;                                              ///< unstretched, m
  double axial_stiffness = 40e6;                                     ///< N
  std::vector<TensionPoint> tension_points = {};                     ///< in place of it
  double damping_time = 0.0;                                         ///< s
  double crane_stiffness = std::numeric_limits<double>::infinity();  ///< N/m
  double duration = 2.0;                                             ///< s
  double payout = 0.0;                                               ///< m, from `payout_start` on
  double payout_start = 0.0;
  MotionLimits limits = {1.0, 1.0, 1.0};

  double stiffness() const { return 1.0 / (length / axial_stiffness + 1.0 / crane_stiffness); }
  LiftSystem build() const;
};

/// Inertia of a uniform box about its centre of mass, kg m2; its edges run along the axes, m.
Matrix3 box_inertia(double mass, double x, double y, double z);

/// The 860 t block on six ropes of the references: uniform box 24 x 16 x 10 m hoisted at 0.05 m/s
/// for 120 s, with 2 s ramps. Its initial motion is in v_start.
LiftSystem block_on_six_ropes();

}  // namespace blocklift::dynamics::examples
