#pragma once

#include <vector>

#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics {

/// Makes bodies that mirror each other, or themselves, in a vertical plane of the world do so panel
/// by panel: cutting a hull at the water may divide panels otherwise on one side than on the other.
///
/// `vertices_W` are the vertices of each body's whole hull at its place (m). In a plane in which
/// each vertex of every body has an image among those of some body, one half is taken and mirrored,
/// panels across the plane being cut there; in others nothing is changed. The planes are x = 0 and
/// y = 0.
void mirror_bodies(const std::vector<std::vector<Vector3>>& vertices_W,
                   std::vector<WettedBody>& bodies);

}  // namespace blocklift::dynamics
