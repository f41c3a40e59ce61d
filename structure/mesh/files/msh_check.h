#pragma once

#include <string>

namespace blocklift::structure {

/// Looks through a mesh file of Gmsh's format 2 in text for elements that name nodes which do not
/// exist: Gmsh itself falls over them. Files of other formats are left to Gmsh.
/// @throws ModelError naming element and node.
void require_known_nodes(const std::string& path);

}  // namespace blocklift::structure
