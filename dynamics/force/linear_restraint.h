#pragma once

#include "dynamics/force/force_element.h"

namespace blocklift::dynamics {

/// Spring and damper in all six freedoms between a body and the place in the world where it rests,
/// by two matrices of 6 x 6: a mooring or restoring as publications give it.
///
/// With R the frame at rest, P the point of the body that is at its origin there, and in the axes
/// of R: x = (theta; d) the rotation vector of the body's turn from R (the shorter way round) and
/// the displacement of P, V = (w; v) the angular velocity and that of P,
///
///   g = K x,    force on P    = -g_d - (C V)_v,
///               moment about P = -J^-T(theta) g_theta - (C V)_w,
///
/// J the left Jacobian of SO(3): dtheta/dt = J^-1(theta) w. A symmetric K has therefore the
/// potential x . K x / 2 at turns of any size; at small ones the moment is -g_theta. What an
/// antisymmetric part of K does is accounted for as supplied.
class LinearRestraint {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  struct Definition {
    std::string name;
    BodyPoint point;                      ///< P
    Pose X_WR;                            ///< the frame R; the body's axes at rest are those of R
    Matrix6 stiffness = Matrix6::Zero();  ///< K: (moment; force) by (turn; displacement)
    Matrix6 damping = Matrix6::Zero();    ///< C: (moment; force) by (angular; linear velocity)
  };

  /// Does the damping drive some motion: has its symmetric part a negative eigenvalue?
  static bool adds_energy(const Matrix6& damping);

  /// @throws ModelError if a value is not finite, the body is the world, or the damping adds
  ///   energy.
  explicit LinearRestraint(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  void add_forces(const MotionState& state, Loads& loads) const;
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Shift {
    Vector3 p_BoP_W;
    Vector6 x;               ///< in R
    Vector6 V;               ///< in R
    Matrix3 growth;          ///< J^-1(theta)
    Vector6 spring, damper;  ///< (moment; force) on P, in R
  };
  Shift calc_shift(const MotionState& state) const;

  Definition definition_;
};

static_assert(ForceElement<LinearRestraint>);

}  // namespace blocklift::dynamics
