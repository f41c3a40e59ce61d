#pragma once

#include "dynamics/marine/hull/hull.h"

namespace blocklift::dynamics {

/// A hull that is symmetric in planes through Bo square to `axes` (0: x, 1: y) but whose mesh is
/// not: what lies on the positive side of all planes, cut there, with its mirror images. Vertices
/// nearer to a plane than a twentieth of their smallest panel are moved onto it first: no slivers
/// arise. Panels across a plane that are warped are divided into their triangles.
/// @throws ModelError if the hull is not symmetric: the result's volume, or its centre over the
///   hull's size, differ by more than a hundredth, or the moments of volume by two hundredths.
Hull made_symmetric(const Hull& hull, const std::vector<int>& axes);

}  // namespace blocklift::dynamics
