#pragma once

#include <array>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Axes of a beam along a line: the rows are axes 1 (along it), 2 and 3, unit vectors.
/// @param axis_2 in the plane of axes 1 and 2; not along the line, else they are not finite.
Eigen::Matrix3d axes_along(const Vector3& line, const Vector3& axis_2);

/// The same of a beam between the ends of its centroid's line.
Eigen::Matrix3d beam_axes(const Mesh& mesh, const Beam& beam);

/// From the first end of a beam to its second one, m.
/// @param beside of its ends from its vertices, m: Beam::offset of the centroid's line.
Vector3 line_beside(const Mesh& mesh, const Beam& beam, const std::array<Vector3, 2>& beside);

}  // namespace blocklift::structure
