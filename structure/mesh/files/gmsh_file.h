#pragma once

#include <map>
#include <string>

#include "structure/mesh/hex_mesh.h"

namespace blocklift::structure {

/// Writes a block mesh through Gmsh (`.msh`, format 4.1): a discrete volume with a named physical
/// group for each plate, pad and lug, numbered from 1 in the order of HexMesh::groups; the columns
/// where plates cross are volumes of their own that also belong to the group "crossings".
/// @throws ModelError if Gmsh cannot write the file.
void write_gmsh(const BlockMesh& mesh, const std::string& path);

/// Reads the hexahedra (with 8 or with 27 nodes) of a file that Gmsh opens; each needs a physical group, whose name
/// (or number, if it has none) must be a key of `materials`, or `materials` has the key "".
/// Gmsh's own session is opened and closed again here.
/// @throws ModelError if the file cannot be read, holds other volume elements, both kinds
///   or no hexahedra, or
///   a group has no material.
HexMesh read_gmsh(const std::string& path, const std::map<std::string, Material>& materials);

}  // namespace blocklift::structure
