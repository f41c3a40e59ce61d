#pragma once

#include <memory>

#include "dynamics/force/force_element.h"
#include "dynamics/marine/hull/hull_clusters.h"
#include "dynamics/marine/waves/sea.h"

namespace blocklift::dynamics {

/// Morison's drag on a straight slender member of a body. Per length, with u the velocity of the
/// water (waves and current) relative to the member and u_n its part square to the axis:
///
///   f = 1/2 rho C_D D |u_n| u_n        (N/m),
///
/// integrated along the part that is in the water, by Gauss' rule with 2 points on each of
/// `segments` pieces (each cut at the surface, so that the force is continuous). The part along the
/// axis and the inertia of the water are not in it.
/// Source: Morison et al. (1950); DNV-RP-C205, 6.2.
class MorisonMember {
 public:
  struct Definition {
    std::string name;
    BodyIndex body = -1;
    Vector3 p_BoP_B = Vector3::Constant(not_a_number);  ///< one end, m
    Vector3 p_BoQ_B = Vector3::Constant(not_a_number);  ///< the other, m
    double diameter = not_a_number;                     ///< D, m
    double drag_coefficient = not_a_number;             ///< C_D: 0.7 to 1.2 for a tube
    int segments = 8;
    std::shared_ptr<const Sea> sea;
  };

  /// @throws ModelError if the ends coincide, diameter or coefficient is negative or not finite,
  ///   there is no segment or no sea.
  explicit MorisonMember(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Force on the body about Bo in W.
  ForceVector calc_force(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  /// By the velocity and the turning of the member; how water velocities and the wetted length
  /// change with its place is left out.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  /// The supplied power is that of the force on the moving body: negative where the water brakes.
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  /// Calls `at(r_W, u_W, weight)` for each wet Gauss point: place from Bo, velocity of the water
  /// relative to it, and the length (m) that it stands for.
  template <class Function>
  void for_each_wet_point(const MotionState& state, Function&& at) const;

  Definition definition_;
};

/// Linear and quadratic damping of a hull's motion through the water, above all of its rolling.
///
/// In the axes of the body, with V the velocity of the point P of the body relative to the current
/// (angular; linear), for each of the six components
///
///   F_i = -s (b_i V_i + c_i |V_i| V_i),   s = min(1, displaced volume / reference volume),
///
/// so that a hull out of the water is not damped. Power is only taken out relative to the current:
/// whoever drifts with the water is not held back, whatever frame that is seen from, and a hull
/// that lies still in a current is pulled by the linear part as well. What radiated waves damp is
/// not in it: their memory brakes no steady motion (RadiatedWater). Source: Himeno (1981),
/// equivalent linear and quadratic roll damping.
class QuadraticDamping {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  struct Definition {
    std::string name;
    BodyPoint point;                   ///< P, where linear velocities are taken
    Vector6 linear = Vector6::Zero();  ///< b: roll, pitch, yaw (N m s), surge, sway, heave (N s/m)
    Vector6 quadratic = Vector6::Zero();  ///< c: N m s2 (three), N s2/m2 (three)
    std::shared_ptr<const Sea> sea;
    std::shared_ptr<const HullClusters> hull;  ///< of the body; null: s = 1 always
    double reference_volume = not_a_number;    ///< afloat, m3; needed with a hull
  };

  /// @throws ModelError if a coefficient is negative or not finite, the sea is missing, or a hull
  ///   comes without a positive reference volume.
  explicit QuadraticDamping(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  void add_forces(const MotionState& state, Loads& loads) const;
  /// How the current changes with the height is left out.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Drag {
    ForceVector F_P_W;        ///< about P
    MotionVector relative_W;  ///< velocity of P relative to the current
    MotionVector V_P_W;       ///< velocity of P
    Vector3 p_BoP_W;
    Vector6 V_B;  ///< relative velocity in the axes of the body
    Vector6 F_B;  ///< force about P there, were the hull wholly wet
    double wet;   ///< s
  };
  Drag calc_drag(const MotionState& state) const;

  Definition definition_;
};

static_assert(ForceElement<MorisonMember> && ForceElement<QuadraticDamping>);

}  // namespace blocklift::dynamics
