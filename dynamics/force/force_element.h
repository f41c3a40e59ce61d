#pragma once

#include <concepts>
#include <string>
#include <vector>

#include "dynamics/force/force_derivatives.h"

namespace blocklift::dynamics {

/// What a force element may look at: time, joint coordinates, and where the bodies are.
struct MotionState {
  double time;                          ///< s
  Eigen::Ref<const Eigen::VectorXd> q;  ///< joint coordinates, nq
  Eigen::Ref<const Eigen::VectorXd> v;  ///< joint velocities, nv
  const Kinematics& kinematics;         ///< of q and v
};

/// The sum of what acts on a mechanism from outside and between its bodies; gravity is not in it.
struct Loads {
  Loads() = default;
  explicit Loads(const Mechanism& mechanism)
      : F_Bo_W(static_cast<std::size_t>(mechanism.body_count()), ForceVector::zero()),
        tau(Eigen::VectorXd::Zero(mechanism.nv())) {}

  void set_zero() {
    for (ForceVector& F : F_Bo_W) F = ForceVector::zero();
    tau.setZero();
  }

  std::vector<ForceVector> F_Bo_W;  ///< on each body, about its origin, in W
  Eigen::VectorXd tau;              ///< at the joints, one for each v, N or N m
};

/// Account of one element's energy. For every element
///   power on the bodies = supplied_power - dissipated_power - d(stored_energy)/dt.
struct EnergyAccount {
  double stored_energy = 0.0;     ///< J
  double dissipated_power = 0.0;  ///< W, never negative
  double supplied_power = 0.0;    ///< from outside the model (wind, winch), W

  EnergyAccount& operator+=(const EnergyAccount& other) {
    stored_energy += other.stored_energy;
    dissipated_power += other.dissipated_power;
    supplied_power += other.supplied_power;
    return *this;
  }
};

/// The one interface of everything that pushes or pulls on bodies.
///
/// An element is immutable after it has been built (names are resolved to indices then), adds its
/// forces to `Loads` without allocating, says how they change with the motion (add_derivatives:
/// every force of add_forces that acts at a body point is also declared there by add_held_force or
/// add_tension), and accounts for its energy. A new kind is one class that meets this concept and
/// one entry in `ForceElements` (lift_system.h).
template <class Element>
concept ForceElement = requires(const Element& element, const MotionState& state, Loads& loads,
                                ForceDerivatives& derivatives) {
  { element.name() } -> std::convertible_to<const std::string&>;
  { element.add_forces(state, loads) } -> std::same_as<void>;
  { element.add_derivatives(state, derivatives) } -> std::same_as<void>;
  { element.calc_energy(state) } -> std::same_as<EnergyAccount>;
};

/// A point fixed in a body.
struct BodyPoint {
  BodyIndex body = world_index;
  Vector3 p_BoQ_B = Vector3::Constant(not_a_number);  ///< m, in the body's frame
};

/// The point seen from its body's origin, in W, m.
inline Vector3 arm_W(const Kinematics& kinematics, const BodyPoint& point) {
  return kinematics.X_WB[point.body].R * point.p_BoQ_B;
}

}  // namespace blocklift::dynamics
