#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "dynamics/marine/hull/hull.h"
#include "dynamics/marine/panels/panel_mesh.h"

namespace blocklift::dynamics {

/// Triangles of a surface, in one frame, m.
using Triangles = std::vector<std::array<Vector3, 3>>;

/// The triangles that a hull stands for, at its pose in the world.
Triangles triangles_of(const Hull& hull, const Pose& X_WB);
/// Those of panels, images included.
Triangles triangles_of(const PanelMesh& mesh);

/// Where two bodies are in each other's way: a point in which an edge of one meets the surface of
/// the other, or, where they coincide or one holds the other whole, the middle of a triangle within
/// the other; none if they are apart. Surfaces may be open above, as hulls cut at the water are: a
/// point is inside where a line straight down from it leaves the surface once more than it enters.
/// Bodies that only touch do not intersect.
std::optional<Vector3> find_intersection(std::span<const std::array<Vector3, 3>> first,
                                         std::span<const std::array<Vector3, 3>> second);

}  // namespace blocklift::dynamics
