#pragma once

#include <vector>

#include "structure/mesh/files/deck/deck.h"
#include "structure/mesh/plates/sheet_grid.h"

namespace blocklift::structure {

struct FreeSheet;

/// A line of a bar or a row of stiffeners between two points, and its beams with all but vertices
/// and label.
struct BeamLine {
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< m
  Beam pattern;
  std::string bar = {};  ///< its name; empty: of a row of stiffeners
};

/// Meshes a block with plates of any orientation: the grid's panels, the frames about its openings
/// and the free plates are surfaces that OpenCASCADE cuts at their joints and Gmsh meshes, with
/// sizes that fall towards openings and the pins of lugs.
///
/// A shell's region is the place of its sheet in the grid; those of free plates follow. Shells of
/// sheets have their normals along the sheet's axis. Sections of shells are -1. It is done in a
/// child process, since the libraries keep one global session.
/// @throws ModelError naming free plates which lie upon other plates, pads that reach beyond their
///   plates, openings outside of their plates, bars upon other bars or stiffeners, and what
///   OpenCASCADE cannot make.
Mesh mesh_with_free_plates(const BlockDescription& block, const SheetGrid& grid,
                           const std::vector<SheetPanel>& panels,
                           const std::vector<FreeSheet>& free_sheets,
                           const std::vector<BeamLine>& beams);

/// @throws ModelError naming groups whose plates or bars are not joined to the largest connected
///   part.
void require_one_part(const Mesh& mesh);

}  // namespace blocklift::structure
