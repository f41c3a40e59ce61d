#pragma once

#include "structure/mesh/hex_mesh.h"
#include "structure/mesh/plates/block_description.h"

namespace blocklift::structure {

/// Mesh of a stiffened block: conforming hexahedra, one layer a plate, a column of plate-thickness
/// size where plates cross, pads and lugs in further layers on both sides of their plate.
///
/// Cuts run only as far as conformity asks. Groups are the plates (all positions of a name
/// together), pads and lugs; a cell that several share belongs to the lug before the pad before
/// the thickest plate. Where plates of different thickness meet in one plane, the elements on both
/// sides of the joint taper to the mean thickness.
///
/// @throws ModelError naming the parts: what spread_into_sheets and PlateGrid refuse, parts that
///   are not joined to the rest, an opening in a plate that does not exist, a lug that touches no
///   pad, a pin outside any reach of its lug.
BlockMesh generate_block_mesh(const BlockDescription& description);

}  // namespace blocklift::structure
