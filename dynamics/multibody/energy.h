#pragma once

#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// Kinetic energy of all bodies in W, as rigid ones, J.
double calc_kinetic_energy(const Mechanism& mechanism, const Kinematics& kinematics);

/// Kinetic energy of the elastic modes, J.
double calc_vibration_energy(const Mechanism& mechanism, ConstVectorRef v);

/// Potential energy of gravity, -sum m g . p_WBcm, J: zero where all masses lie at Wo.
double calc_gravity_potential(const Mechanism& mechanism, const Kinematics& kinematics);

/// Momentum of all bodies in W: angular about Wo (kg m2/s, in `moment`) and linear (kg m/s, in
/// `force`).
ForceVector calc_momentum(const Mechanism& mechanism, const Kinematics& kinematics);

/// Power that the viscous damping of joints and elastic modes takes out, sum d v^2, W.
double calc_damping_power(const Mechanism& mechanism, ConstVectorRef v);

/// Mass, centre of mass and inertia about it, in W, of a body and all that it carries; of the whole
/// mechanism for the world.
RigidBodyInertia calc_mass_properties(const Mechanism& mechanism, const Kinematics& kinematics,
                                      BodyIndex body = world_index);

}  // namespace blocklift::dynamics
