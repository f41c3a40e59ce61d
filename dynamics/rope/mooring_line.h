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

/// Tugger line: a straight light line that pulls and never pushes. Of a winch that stands still,
///   T = max(0, k (L - L0) + c dL/dt) where L > L0, else 0   (N),
/// or of one that holds a tension, paying out and taking in as the ends move,
///   T = max(0, T0 + c dL/dt),
/// whose work -T0 dL/dt is supplied from outside. A tension above zero says which.
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
