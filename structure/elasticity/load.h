#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/discretisation.h"
#include "structure/rigid_body.h"

namespace blocklift::structure {

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

}  // namespace blocklift::structure
