#pragma once

#include <vector>

#include "structure/mesh/part_mesh.h"

namespace blocklift::structure {

/// Tabulates one of Gmsh's element types (its manual, "Node ordering"). Gmsh's session is open.
ElementKind tabulate_element(int gmsh_type);

/// A face of a solid as an element of its own.
struct ElementFace {
  int gmsh_type = 0;
  int corners = 3;         ///< the first of its nodes, one after the other around it
  std::vector<int> nodes;  ///< of the solid, in Gmsh's order for the face
};

/// The faces of a kind of solids.
std::vector<ElementFace> element_faces(const ElementKind& solid);

}  // namespace blocklift::structure
