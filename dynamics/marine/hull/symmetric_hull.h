#pragma once

#include "dynamics/marine/hull/hull.h"

namespace blocklift::dynamics {

/// A hull that is symmetric in the plane through Bo square to `axis` (0: x, 1: y) but whose mesh is
/// not: the half on the positive side, cut at the plane, with its mirror image. Vertices nearer to
/// the plane than a twentieth of their smallest panel are moved onto it first, so that no slivers
/// arise. Panels across the plane that are warped are divided into their triangles.
/// @throws ModelError if the hull is not symmetric: volume or centre on the two sides differ by more
///   than a hundredth, or the result's moments of volume by more than two hundredths.
Hull made_symmetric(const Hull& hull, int axis);

}  // namespace blocklift::dynamics
