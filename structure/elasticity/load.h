#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/discretisation.h"

namespace blocklift::structure {

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

/// Integrates the mesh; with `stated_mass` (kg) and `stated_centre` (m), spreads the difference.
/// @throws ModelError if the density would be negative somewhere, the message naming the mass and
///   the centre of the steel.
MassProperties find_mass_properties(const HexMesh& mesh, const Discretisation& space,
                                    const double* stated_mass, const Vector3* stated_centre);

/// Zeroth and first moments of the shape functions weighted by a density rho (any unit per m^3):
/// row n holds int rho N_n dV and int rho N_n x dV. Loads linear in x are products with them.
using NodalMoments = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
NodalMoments nodal_moments(const HexMesh& mesh, const Discretisation& space,
                           const std::function<double(int cell, const Vector3&)>& density);
/// The same over some of the cells.
NodalMoments nodal_moments(const HexMesh& mesh, const Discretisation& space,
                           const std::vector<int>& cells,
                           const std::function<double(int cell, const Vector3&)>& density);

/// Load vectors of the twelve unit inertia fields (columns, in the order of
/// InertiaField::coefficients), N.
Eigen::MatrixXd inertia_loads(const NodalMoments& mass_moments);

/// Load vectors of unit forces along x, y, z at a pin, spread over the volume that
/// `volume_moments` was integrated on, as b(x) = c + d x (x - pin) with c and d such that the
/// resultant is the unit force and its moment about the pin vanishes (a 6 x 6 system).
/// @throws ModelError if the volume is empty.
Eigen::MatrixXd pin_loads(const NodalMoments& volume_moments, const Eigen::Matrix3Xd& nodes,
                          const Vector3& pin);

/// Adds to load vectors (a column each) wrenches about a point (force, moment; a column each), spread over
/// the volume of the moments likewise: c and d such that the resultant is the wrench. Over a flat plate a
/// force across it is a pressure linear in place.
/// @throws ModelError if the volume is empty.
void add_spread_wrenches(const NodalMoments& volume_moments, const Eigen::Matrix3Xd& nodes,
                         const Vector3& point, const Eigen::MatrixXd& wrenches,
                         Eigen::Ref<Eigen::MatrixXd> loads);

/// Load vector of a body force, N, by Gauss points (`extra` more an axis than the degree plus 1).
Eigen::VectorXd body_load(const HexMesh& mesh, const Discretisation& space,
                          const std::function<Vector3(const Vector3&)>& force_density,
                          int extra = 1);

/// Load vector of tractions (Pa) on boundary faces: traction(place, outward unit normal), asked
/// for on faces that `selects` (centre, normal) chooses.
Eigen::VectorXd traction_load(
    const HexMesh& mesh, const Discretisation& space,
    const std::function<bool(const Vector3&, const Vector3&)>& selects,
    const std::function<Vector3(const Vector3&, const Vector3&)>& traction);

/// Resultant of nodal forces about B's origin.
Wrench resultant(const Eigen::Matrix3Xd& nodes, const Eigen::Ref<const Eigen::VectorXd>& load);

/// Field whose rigid-body inertia balances a wrench: the steady acceleration that it gives a free
/// body (no angular velocity). Use it for load tables, where the motion is not known.
InertiaField balancing_field(const MassProperties& mass, const Wrench& wrench);

}  // namespace blocklift::structure
