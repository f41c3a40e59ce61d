#pragma once

#include "dynamics/force/force_element.h"

namespace blocklift::dynamics {

/// @throws ModelError, naming spring and quantity, if a stiffness, damping or length is negative or
/// not finite.
void require_spring_value(const std::string& spring, const char* what, double value);

/// Straight spring and damper between two points; it pulls and pushes.
///
/// With L the distance of the points, the force that draws them together is
///   f = k (L - L0) + c dL/dt   (N).
class PointSpring {
 public:
  struct Definition {
    std::string name;
    BodyPoint from;
    BodyPoint to;
    double stiffness = not_a_number;    ///< k, N/m
    double damping = 0.0;               ///< c, N s/m
    double free_length = not_a_number;  ///< L0, m
  };

  /// @throws ModelError if stiffness, damping or free length is negative or not finite, or both
  /// points lie on one body.
  explicit PointSpring(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Tension along the line of the points, N; negative when it pushes.
  /// @throws ModelError if the points coincide (the direction of the force is undefined).
  double calc_tension(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Line {
    Vector3 direction_W;  ///< unit, from `from` to `to`
    double length;        ///< m
    double length_rate;   ///< m/s
  };
  Line calc_line(const MotionState& state) const;

  Definition definition_;
};

/// Spring and damper at one degree of freedom of a joint whose v is dq/dt:
///   tau = -k (q - q0) - c v,   N m where the joint turns, N where it slides.
class JointSpring {
 public:
  struct Definition {
    std::string name;
    BodyIndex body = -1;                    ///< the body that the joint carries
    int degree_of_freedom = 0;              ///< which of the joint's velocities, from 0
    double stiffness = not_a_number;        ///< k, N m/rad or N/m
    double damping = 0.0;                   ///< c, N m s/rad or N s/m
    double free_coordinate = not_a_number;  ///< q0, rad or m
  };

  /// @throws ModelError if the joint has no such degree of freedom or a quaternion (spherical,
  /// free), or stiffness or damping is negative or not finite.
  JointSpring(const Mechanism& mechanism, Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  Definition definition_;
  int q_index_ = -1;
  int v_index_ = -1;
};

static_assert(ForceElement<PointSpring> && ForceElement<JointSpring>);

}  // namespace blocklift::dynamics
