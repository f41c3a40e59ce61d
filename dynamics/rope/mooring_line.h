#pragma once

#include "dynamics/force/force_element.h"
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

/// Tugger line: a straight light line that pulls and never pushes, by the law of ropes
/// (one_sided_force) with a damping force c dL/dt. Of a winch that stands still the elastic force
/// is
///   F = k (L - L0)   (N);
/// of one that holds a tension, paying out and taking in as the ends move, it is
///   F = T0,
/// and its work -T0 dL/dt is supplied from outside. A tension above zero says which.
///
/// It is no Rope: a winch that holds a tension leaves no length out that one could tell, and stores
/// nothing. Nor does the integration declare a line taut or slack for a step, as it does ropes. Its
/// steps find the change by failing there: a load of 20 t that falls 1 m into a line of 40 MN over
/// 20 m, with a damping of 0.005 s, takes 1,534 right-hand sides where the same rope takes 845
/// (tolerance 1e-8), and ends as near the place that a tolerance of 1e-12 gives. The energy that is
/// dissipated is known less well, since the damping force sets in at once: it errs by 0.1 % to
/// 0.9 % of the largest kinetic energy at any tolerance from 1e-4 to 1e-10, whereas with a rope the
/// error shrinks with the tolerance. So what falls into its line again and again is modelled as a
/// rope.
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

  /// @throws ModelError if the ends coincide (the direction of the pull is undefined).
  double calc_tension(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Pull {
    Vector3 direction_W;  ///< unit, from `from` to `to`
    Vector3 relative_velocity_W;
    double length, rate;  ///< m, m/s
    double elastic;       ///< N
    double tension;       ///< N
  };
  Pull calc_pull(const MotionState& state) const;

  Definition definition_;
};

static_assert(ForceElement<MooringLine> && ForceElement<TuggerLine>);

}  // namespace blocklift::dynamics
