#pragma once

#include "dynamics/force/force_element.h"
#include "dynamics/force/one_sided.h"
#include "dynamics/rope/catenary.h"

namespace blocklift::dynamics {

/// Mooring line: an elastic catenary that is at rest at each instant (no inertia, no drag of its
/// own), from an anchor to a fairlead. See catenary.h.
class MooringLine {
 public:
  struct Definition {
    std::string name;
    BodyPoint anchor;    ///< lower end; a point of the world where the line lies on the bottom
    BodyPoint fairlead;  ///< upper end
    CatenaryLine line;
  };

  /// @throws ModelError if length, weight or stiffness is not positive, both ends are on one body,
  ///   or a line on the bottom has its anchor on a body that moves.
  explicit MooringLine(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Shape and forces at a state. @throws SimulationError as calc_catenary.
  Catenary calc_shape(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  /// Exact: the inverse of the derivative of the shape.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Ends {
    Vector3 level_W;       ///< unit, from the anchor to the fairlead, level
    double span;           ///< m
    double rise;           ///< m
    double anchor_height;  ///< m
  };
  Ends find_ends(const MotionState& state) const;

  Definition definition_;
};

/// A tugger line's load at one instant.
struct TuggerLoad {
  Vector3 direction_W = Vector3::Constant(not_a_number);  ///< unit, from `from` to `to`
  Vector3 relative_velocity_W = Vector3::Constant(not_a_number);
  double length = not_a_number;         ///< m
  double rate = not_a_number;           ///< of the length, m/s
  double elastic_force = not_a_number;  ///< N; negative when slack
  double damping_force = not_a_number;  ///< N
  double tension = not_a_number;        ///< N
  bool acts = false;                    ///< does the line pull?

  /// Positive where the line pulls, negative where it is slack, continuous between: N.
  double slack_indicator() const { return one_sided_indicator(elastic_force, damping_force); }
};

/// Tugger line: a straight light line that pulls and never pushes, by the law of ropes
/// (one_sided_force) with a damping force c dL/dt. If its winch stands still, the elastic force is
///   F = k (L - L0)   (N);
/// where the winch holds a tension, paying out and taking in as the ends move, it is
///   F = T0,
/// and its work -T0 dL/dt is supplied from outside. A tension above zero says which. A slack line
/// stores nothing, and its winch does no work.
///
/// It is one of the lift's contacts (Contacts): an integration declares it taut or slack for a
/// step, and ends the step where that changes. A load of 20 t that falls 1 m into a line of 40 MN
/// over 20 m, with a damping of 0.005 s, takes as many right-hand sides as on the same rope.
///
/// It is no Rope: a winch that holds a tension leaves no length out that one could tell, and stores
/// nothing.
class TuggerLine {
 public:
  struct Definition {
    std::string name;
    BodyPoint from;
    BodyPoint to;
    double stiffness = not_a_number;           ///< k, N/m; 0 where a tension is held
    double damping = 0.0;                      ///< c, N s/m
    double unstretched_length = not_a_number;  ///< L0, m; 0 where a tension is held
    double tension = 0.0;                      ///< T0 that is held, N; 0: the winch stands
  };

  /// @throws ModelError if a number is negative or not finite, both ends are on one body, or a
  ///   tension is held by a line that has a stiffness.
  explicit TuggerLine(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Load by the law above.
  /// @throws ModelError if the ends coincide (the direction of the pull is undefined).
  TuggerLoad calc_load(const Kinematics& kinematics) const;
  /// Load where the line is known to be taut or slack: the same law without its kink.
  TuggerLoad calc_load(const Kinematics& kinematics, bool acts) const;

  void add_forces(const Kinematics& kinematics, const TuggerLoad& load, Loads& loads) const;
  void add_derivatives(const Kinematics& kinematics, const TuggerLoad& load,
                       ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const TuggerLoad& load) const;

  // The same by the law above.
  double calc_tension(const MotionState& state) const {
    return calc_load(state.kinematics).tension;
  }
  void add_forces(const MotionState& state, Loads& loads) const {
    add_forces(state.kinematics, calc_load(state.kinematics), loads);
  }
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
    add_derivatives(state.kinematics, calc_load(state.kinematics), derivatives);
  }
  EnergyAccount calc_energy(const MotionState& state) const {
    return calc_energy(calc_load(state.kinematics));
  }

 private:
  TuggerLoad calc_elastic_and_damping(const Kinematics& kinematics) const;

  Definition definition_;
};

static_assert(ForceElement<MooringLine> && ForceElement<TuggerLine>);

}  // namespace blocklift::dynamics
