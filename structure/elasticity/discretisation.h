#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/reference_element.h"
#include "structure/mesh/hex_mesh.h"

namespace blocklift::structure {

/// Nodes that belong to exactly the same cells, numbered one after another. The stiffness couples
/// whole entities, so ordering, pattern and assembly work on them instead of on single unknowns.
struct NodeEntity {
  int first_node = 0;
  int node_count = 0;
  std::vector<int> cells;
};

/// Finite-element nodes on a mesh of hexahedra, numbered by nested dissection for the Cholesky
/// factorisation. Unknown 3 n + a is the displacement of node n along axis a.
struct Discretisation {
  /// Numbers the nodes of FE_Q(degree) on `mesh` (deal.II) and orders them (METIS).
  Discretisation(const HexMesh& mesh, int degree);

  ReferenceElement element;
  int nodes_per_cell = 0;
  Eigen::Matrix3Xd nodes;            ///< places, m
  std::vector<int> cell_nodes;       ///< nodes_per_cell a cell, in the order of element.nodes()
  std::vector<NodeEntity> entities;  ///< in order of their nodes
  std::vector<std::vector<int>> cell_entities;  ///< a cell, ascending
  /// Cells of one shape (equal Jacobian throughout) bear one number, `affine_shape` tells whether
  /// its Jacobian is constant; other cells have a number each.
  std::vector<int> cell_shape;
  std::vector<int> shape_cell;     ///< a cell of each shape
  std::vector<char> shape_affine;  ///< of each shape

  int node_count() const { return static_cast<int>(nodes.cols()); }
  int unknowns() const { return 3 * node_count(); }
  int cell_count() const { return static_cast<int>(cell_shape.size()); }
  int node(int cell, int local) const {
    return cell_nodes[static_cast<std::size_t>(cell) * static_cast<std::size_t>(nodes_per_cell) +
                      static_cast<std::size_t>(local)];
  }
};

}  // namespace blocklift::structure
