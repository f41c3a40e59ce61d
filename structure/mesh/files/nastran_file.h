#pragma once

#include <string>

#include "structure/mesh/files/abaqus_file.h"

namespace blocklift::structure {

/// Reads the solids of a Nastran bulk data file: GRID, CTETRA (4 or 10 nodes), CPENTA (6 or 15),
/// CHEXA (8 or 20), in small, large and free fields, with their continuations; coordinates as they
/// stand.
///
/// Elements of one property P become the element set "property P"; grids that SPC or SPC1 cards of
/// set S name the node set "constraint S"; triangles and quadrangles that lie on solids (CTRIA3,
/// CTRIA6, CQUAD4, CQUAD8) of property P, and the faces of PLOAD4 cards of set S, the surfaces
/// "property P" and "load S". Values of constraints and loads, materials and everything else are
/// passed over: a part's file has them.
///
/// Gmsh's own reader takes the corners of hexahedra and wedges alone.
/// @returns a mesh without elements if the file has no solids.
/// @throws ModelError "file:line: ..." where a card cannot be understood, names what is not there,
///   or stands in a coordinate system of its own.
AbaqusMesh read_nastran(const std::string& path);

}  // namespace blocklift::structure
