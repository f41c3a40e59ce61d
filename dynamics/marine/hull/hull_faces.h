#pragma once

#include "dynamics/marine/hull/hull.h"

namespace blocklift::dynamics {

/// The same surface of far fewer panels where it is flat: two neighbours that lie in one plane, to
/// 1e-9 of their size, and are convex together become one, again and again. Vertices that have
/// become the middle of an edge are left out of that panel, so that edges need not match those of
/// neighbours any more: for integrals over the surface, which stay the same to that share.
Hull join_flat_panels(const Hull& hull);

/// The same surface, each flat and convex panel divided by lines along and across its longest edge
/// into pieces no longer than `size` from corner to corner (m). Edges need not match those of
/// neighbours.
Hull divide_flat_panels(const Hull& hull, double size);

}  // namespace blocklift::dynamics
