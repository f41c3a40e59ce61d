#pragma once

#include <Eigen/Core>

namespace blocklift::structure {

using Vector3 = Eigen::Vector3d;

/// Force and moment about the origin of the block frame B, in B.
struct Wrench {
  Vector3 force = Vector3::Zero();   ///< N
  Vector3 moment = Vector3::Zero();  ///< N m
};

/// Motion of the block frame as the structure feels it, in B. Material at r (from B's origin, m)
/// carries the body force, N/m^3,
///   b(r) = -rho (a + alpha x r + omega x (omega x r)),
/// with a the acceleration of B's origin less gravity. The last term is linear in the products
/// w_ij = omega_i omega_j: omega x (omega x r) = W r - tr(W) r.
struct InertiaField {
  Vector3 acceleration_less_gravity = Vector3::Zero();  ///< a, m/s^2
  Vector3 angular_acceleration = Vector3::Zero();       ///< alpha, rad/s^2
  /// w_xx, w_yy, w_zz, w_xy, w_yz, w_zx, rad^2/s^2
  Eigen::Matrix<double, 6, 1> angular_velocity_products = Eigen::Matrix<double, 6, 1>::Zero();

  /// Field of a body at rest: only gravity g_B (m/s^2, in B) acts.
  static InertiaField at_rest(const Vector3& gravity_B);
  /// Field of a moving body; acceleration_B is that of B's origin, all in B.
  static InertiaField moving(const Vector3& acceleration_B, const Vector3& gravity_B,
                             const Vector3& angular_acceleration_B,
                             const Vector3& angular_velocity_B);
  /// The twelve numbers in the order of the members.
  Eigen::Matrix<double, 12, 1> coefficients() const;
};

/// Mass of the model. With a stated mass and centre, the density of each point is the material's
/// times 1 + what outfitting adds: factor(x) = alpha + beta . (x - c), c the centre of the steel,
/// so that mass and centre agree exactly.
struct MassProperties {
  double mass = 0;                                           ///< kg, outfitting included
  Vector3 centre_of_mass_B = Vector3::Zero();                ///< m
  Eigen::Matrix3d inertia_BBcm_B = Eigen::Matrix3d::Zero();  ///< about the centre of mass, kg m^2
  double steel_mass = 0;                                     ///< kg, of the mesh alone
  Vector3 steel_centre_B = Vector3::Zero();                  ///< m
  double outfitting_mass = 0;                                ///< kg, mass - steel_mass
  double factor_alpha = 1;
  Vector3 factor_beta = Vector3::Zero();  ///< 1/m
  double smallest_density_factor = 1;
  double largest_density_factor = 1;

  double density_factor(const Vector3& x) const {
    return factor_alpha + factor_beta.dot(x - steel_centre_B);
  }
};

/// Moments of a mass: int dm (1, x, x x').
struct MassMoments {
  double mass = 0;                                   ///< kg
  Vector3 first = Vector3::Zero();                   ///< kg m
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< kg m^2

  void add(double dm, const Vector3& x) {
    mass += dm;
    first += dm * x;
    second += dm * x * x.transpose();
  }
  /// Second moment about a centre, kg m^2.
  Eigen::Matrix3d about(const Vector3& centre) const {
    return second - mass * centre * centre.transpose();
  }
};

/// Resultant of nodal forces (3 a node, N) about the origin.
Wrench resultant(const Eigen::Matrix3Xd& nodes, const Eigen::Ref<const Eigen::VectorXd>& load);

/// Field whose rigid-body inertia balances a wrench: the steady acceleration that it gives a free
/// body (no angular velocity). Use it for load tables, where the motion is not known.
InertiaField balancing_field(const MassProperties& mass, const Wrench& wrench);

}  // namespace blocklift::structure
