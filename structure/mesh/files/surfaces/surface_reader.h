#pragma once

#include <string>
#include <vector>

#include "structure/mesh/files/deck/deck.h"
#include "structure/mesh/files/surfaces/group_finder.h"
#include "structure/mesh/files/surfaces/surface_mesher.h"

namespace blocklift::structure {

/// How a file of surfaces becomes a deck.
struct SurfaceReading {
  UnitSystem units;  ///< its length alone counts
  GivenGroups given;
  SurfaceSizes sizes;  ///< of a geometry's elements
  bool leave_solids_out = false;
};

/// Reads a mesh of Gmsh (.msh), a universal file (.unv) or a geometry (STEP, IGES, BREP) into plates
/// and bars that have no properties yet: shells and beams with section -1, and the names of their
/// groups.
///
/// Surfaces of a geometry are cut at their joints and meshed; those of one group that lie upon one
/// another count once. Curves that bound no surface are bars if their group is given a section:
/// they share nodes with the surfaces that they lie in or touch. All of it is done in a child
/// process: damaged files crash the libraries that read them, or keep them busy for ever.
/// @throws DeckError if the file cannot be read or meshed, has no plates and bars, has solids that
///   are not to be left out, or has surfaces of two groups upon one another; or if the child
///   process dies.
Deck read_surfaces(const std::string& path, const SurfaceReading& reading);

}  // namespace blocklift::structure
