#pragma once

#include <vector>

#include "structure/mesh/plates/block_description.h"
#include "structure/mesh/plates/free_plates.h"

namespace blocklift::structure {

/// The lines of a block's bars, a group and a region for each bar behind those of the mesh.
/// Patterns have no section yet.
/// @throws ModelError naming bars without a profile or length, and materials that are not there.
std::vector<BeamLine> add_bars(const BlockDescription& block, Mesh& mesh);

/// Gives the bars of a mesh, whose regions are its last ones, their profiles, once plates have
/// their sections, and hinges their ends.
/// @throws ModelError naming a bar that runs along the direction towards which it stands.
void finish_bars(const BlockDescription& block, Mesh& mesh);

}  // namespace blocklift::structure
