#pragma once

#include <Eigen/Core>

#include "structure/elasticity/part_model.h"

namespace blocklift::structure {

/// Adds the nodal forces (N, 3 a node) of a pin that presses on its hole:
/// SurfaceLoad::Kind::bearing.
///
/// The part of the force across the hole's axis becomes the pressure
///   p(theta, z) = (1 + k z) p_0 cos(theta - theta_0) over the half of the hole before the pin,
///     else 0,
/// along radial lines of the axis; what is along the axis (a sling pulled sideways) is spread over
/// the whole hole as a traction of a + b cos(theta) + c sin(theta). The free numbers are such that
/// the sum of the nodal forces is the force itself and their moment about the load's point
/// vanishes, to rounding. On an ideal hole with the point in its middle p_0 = 4 F / (pi d t),
/// theta_0 is the force's direction, and k, b and c vanish. Source: API RP 2A and DNV practice for
/// padeyes; Bickley (1928), Phil. Trans. Royal Society A 227.
/// @throws ModelError if the group holds no faces, a face lies on the axis, or they cannot bear
///   the force: no whole hole, or the point lies far outside of it.
void add_bearing_load(const PartMesh& mesh, const SurfaceLoad& load, const PartGroup& hole,
                      Eigen::VectorXd& forces);

}  // namespace blocklift::structure
