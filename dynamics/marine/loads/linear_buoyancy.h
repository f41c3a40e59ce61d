#pragma once

#include "dynamics/force/force_element.h"
#include "dynamics/multibody/added_inertia.h"

namespace blocklift::dynamics {

/// Buoyancy by its stiffness at rest, as databases and publications have it, in place of the
/// pressure on a hull (HullForce).
///
/// With H the frame of a database or publication at its point R, whose axes are level at rest, zeta
/// the height of R above where it is at rest, and u the world's vertical in the axes of H,
///
///   y = (zeta; u_y; -u_x),   U = y.C y/2 - W (zeta + p_x u_x + p_y u_y),
///   force on R = -dU/dzeta upwards,   moment about R = u x dU/du  (in H).
///
/// W is the buoyancy at rest and (p_x, p_y) where it passes R; at small motions y is heave, roll
/// and pitch. Since u alone tells the attitude, a vessel may drift and turn about the vertical as
/// far as it likes; the moment has no part about it; and there is a potential at motions of any
/// size, although the law fits small ones. At rest -dF/dX is the stiffness of hydrostatics.h, the
/// columns of yaw included.
/// Source: Newman, Marine Hydrodynamics (1977), sec. 6.16, to the first order in the motion.
class LinearBuoyancy {
 public:
  struct Definition {
    std::string name;
    BodyFrame frame;                    ///< H
    double rest_height = not_a_number;  ///< of R in W, m
    double buoyancy = not_a_number;     ///< W, N
    /// (p_x, p_y): centre of buoyancy at rest from R, along the level axes of H, m.
    Eigen::Vector2d centre = Eigen::Vector2d::Constant(not_a_number);
    /// C of heave, roll, pitch, of the buoyancy without any weight: N/m, N, N m.
    Matrix3 stiffness = Matrix3::Constant(not_a_number);
  };

  /// @throws ModelError if a value is not finite, the body is the world, W is negative or C is not
  ///   symmetric.
  explicit LinearBuoyancy(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Shift {
    Vector3 p_BoR_W;
    Matrix3 R_WH;
    Vector3 u;         ///< the vertical, in H
    Vector3 y;         ///< (zeta; u_y; -u_x)
    double lift;       ///< -dU/dzeta, N
    Vector3 gradient;  ///< dU/du, N m
  };
  Shift calc_shift(const MotionState& state) const;

  Definition definition_;
};

static_assert(ForceElement<LinearBuoyancy>);

/// What the weight (N) of a body adds to the stiffness of heave, roll and pitch about a point from
/// which its centre of mass lies at `arm` (m): C of publications holds it, that of LinearBuoyancy
/// does not. Weight above the point takes stiffness away.
Matrix3 calc_stiffness_of_weight(double weight, const Vector3& arm);

}  // namespace blocklift::dynamics
