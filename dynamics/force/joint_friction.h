#pragma once

#include "dynamics/force/force_element.h"

namespace blocklift::dynamics {

/// Dry friction at one degree of freedom of a joint whose v is dq/dt:
///   tau = -F tanh(v / v0),   N m where the joint turns, N where it slides.
///
/// A regularised Coulomb law: from a few v0 on it is the full friction F, and below a force P < F
/// it does not hold but creeps at v0 artanh(P / F). At rest it does nothing, so that equilibria are
/// those without friction; natural modes have it as a damper F / v0, which holds the joint.
class JointFriction {
 public:
  struct Definition {
    std::string name;
    BodyIndex body = -1;             ///< the body that the joint carries
    int degree_of_freedom = 0;       ///< which of the joint's velocities, from 0
    double friction = not_a_number;  ///< F, N m or N
    double creep = not_a_number;     ///< v0, rad/s or m/s
  };

  /// @throws ModelError if the joint has no such degree of freedom or a quaternion (spherical,
  /// free), the friction is negative or the creep not positive, or one is not finite.
  JointFriction(const Mechanism& mechanism, Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  double share(const MotionState& state) const;

  Definition definition_;
  int v_index_ = -1;
};

static_assert(ForceElement<JointFriction>);

}  // namespace blocklift::dynamics
