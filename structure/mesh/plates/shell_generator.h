#pragma once

#include "structure/mesh/mesh.h"
#include "structure/mesh/plates/block_description.h"

namespace blocklift::structure {

/// Shells of a stiffened block: quadrangles on the mid-planes of its plates, conforming.
///
/// Plates end on the mid-plane of the plate that they meet; where they cross, both are there, so
/// the mass is that of all mid-planes times their thickness. Cuts run only as far as conformity
/// asks, and what lies between two is divided evenly into edges no longer than the largest element.
/// Each sheet (one plate at one position, a pad, a lug) is a region, in that order; its shells'
/// normals point along its axis. Groups are the plates (all positions of a name together), pads,
/// lugs and rows of stiffeners. Stiffeners are beams on the shells' edges, their centroid off the
/// mid-plane by half the plate's thickness and the profile's own offset; those of one row on one
/// sheet are a region, after the sheets. Each bar is a group and a region, the last ones. What
/// several sheets share belongs to the lug before the pad before the thickest plate. Labels count
/// from 1, shells before beams.
///
/// @throws ModelError naming the parts: what spread_into_sheets and SheetGrid refuse, elements so
///   small that no memory holds them, parts that are not joined to the rest along an edge, a lug
///   that touches no pad, a pin outside any reach of its lug, bars upon one another.
Mesh generate_shell_mesh(const BlockDescription& description);

}  // namespace blocklift::structure
