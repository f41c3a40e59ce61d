#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "structure/mesh/files/abaqus_file.h"

namespace blocklift::structure {

/// Puts a mesh into Gmsh's current model: elements and faces that are in the same sets are one
/// discrete volume or surface, and each set is a physical group of its name. Plates in no set are
/// left out where there are solids, whose faces they are.
///
/// A node set becomes the group of the outer faces all of whose nodes it names, if these faces have
/// all of its nodes; else it is returned, as a set of points. A node set of the name of an element
/// set is called "NAME nodes", a surface of the name of either "NAME surface".
std::map<std::string, std::vector<std::size_t>> add_to_gmsh(const AbaqusMesh& mesh);

/// The outer faces of the mesh all of whose nodes are in the set; none unless these faces have all of
/// the set's nodes.
std::vector<AbaqusFace> outer_faces_made_of(const AbaqusMesh& mesh,
                                            const std::set<std::size_t>& nodes);

}  // namespace blocklift::structure
