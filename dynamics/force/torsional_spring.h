#pragma once

#include "dynamics/force/force_element.h"

namespace blocklift::dynamics {

/// Spring and damper that draw the orientation of one body back to that in which it is free of
/// moment, as seen from another: alike about every axis, whatever joints lie between.
///
/// With theta the rotation vector of the turn from the free to the present orientation of T seen
/// from F (the shorter way round, at most half a turn) and w_FT the angular velocity, the moment on
/// T is
///   m = -k theta - c w_FT    (N m), the opposite on F.
/// Its potential is k theta^2 / 2: the rate of theta^2 / 2 is theta . w, since w differs from
/// dtheta/dt by what is perpendicular to theta only (Shuster 1993, J. Astronaut. Sci. 41(4), rates
/// of the rotation vector).
class TorsionalSpring {
 public:
  struct Definition {
    std::string name;
    BodyIndex from = -1;                      ///< F
    BodyIndex to = -1;                        ///< T
    double stiffness = not_a_number;          ///< k, N m/rad
    double damping = 0.0;                     ///< c, N m s/rad
    Matrix3 R_FT_free = Matrix3::Identity();  ///< orientation of T in F without moment
  };

  /// @throws ModelError if stiffness or damping is negative or not finite, or both ends are one
  /// body.
  explicit TorsionalSpring(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// theta, rad, in W.
  Vector3 calc_turn(const MotionState& state) const;
  /// Moment on T, N m, in W.
  Vector3 calc_moment(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  Vector3 relative_velocity(const MotionState& state) const;

  Definition definition_;
};

static_assert(ForceElement<TorsionalSpring>);

}  // namespace blocklift::dynamics
