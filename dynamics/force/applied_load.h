#pragma once

#include "dynamics/force/force_element.h"
#include "dynamics/force/load_table.h"

namespace blocklift::dynamics {

/// Force at a point of a body, and moment on the body, given over time:
///   F_Q = (moment, force), along the axes of the world (the load keeps its direction) or of the
///     body
///   (it turns with the body, as a thruster's).
class AppliedLoad {
 public:
  enum class Axes { world, body };
  struct Definition {
    std::string name;
    BodyPoint point;
    Axes axes = Axes::world;
    LoadTable force = LoadTable(Vector3::Zero());   ///< N
    LoadTable moment = LoadTable(Vector3::Zero());  ///< N m
  };

  /// @throws ModelError if the load acts on the world, or the point is not finite.
  explicit AppliedLoad(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  /// All its power is supplied from outside.
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  /// Moment and force about the point, in W.
  ForceVector calc_load(const MotionState& state) const;

  Definition definition_;
};

/// Force or moment at one degree of freedom of a joint, given over time: tau_k = f(t), N where the
/// joint slides, N m where it turns. The carrier feels the opposite.
class JointLoad {
 public:
  struct Definition {
    std::string name;
    BodyIndex body = -1;                          ///< the body that the joint carries
    int degree_of_freedom = 0;                    ///< which of the joint's velocities, from 0
    LoadTable load = LoadTable(Vector3::Zero());  ///< its x component counts, N or N m
  };

  /// @throws ModelError if the joint has no such degree of freedom.
  JointLoad(const Mechanism& mechanism, Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  void add_forces(const MotionState& state, Loads& loads) const;
  /// It changes with time alone.
  void add_derivatives(const MotionState&, ForceDerivatives&) const {}
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  Definition definition_;
  int v_index_ = -1;
};

static_assert(ForceElement<AppliedLoad> && ForceElement<JointLoad>);

}  // namespace blocklift::dynamics
