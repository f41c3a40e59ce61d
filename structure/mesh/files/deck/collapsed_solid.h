#pragma once

#include <optional>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Has a solid a vertex at more than one of its corners?
bool has_repeated_corners(const Solid& solid);

/// What a solid is whose corners fall together: a hexahedron with two neighbouring parallel edges
/// that are points is a wedge, one with a face that is a point a pyramid, and so on to a
/// tetrahedron. Its faces and the middles of its edges are the given ones.
/// @returns none if what is left is no wedge, pyramid or tetrahedron, or two middles are given for
///   one edge.
std::optional<Solid> without_repeated_corners(const Solid& solid);

}  // namespace blocklift::structure
