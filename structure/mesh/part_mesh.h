#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

using Vector3 = Eigen::Vector3d;

/// Isoparametric Lagrange or serendipity element of one kind, tabulated: hexahedra, tetrahedra and
/// wedges, their faces and edges, and points. Local coordinates and order of nodes are Gmsh's.
struct ElementKind {
  std::string name;   ///< "Hexahedron 20"
  int dimension = 0;  ///< 3 for solids, 2 for faces, 1 for edges, 0 for points
  int order = 1;      ///< of the polynomial
  int nodes = 0;
  int corners = 0;         ///< the first of the nodes
  Eigen::Matrix3Xd local;  ///< of the nodes
  Eigen::Matrix3Xd rule;   ///< integration points, exact for twice the order
  Eigen::VectorXd weights;
  Eigen::MatrixXd values;              ///< rule points x nodes
  Eigen::MatrixXd gradients;           ///< row 3 q + a: d/dxi_a at rule point q
  Eigen::MatrixXd gradients_at_nodes;  ///< the same at the nodes
  /// Corner nodes of each mid-edge node, in the order in which VTK and Abaqus have those nodes.
  std::vector<int> corner_order;  ///< VTK's and Abaqus' corners, as nodes here
  std::vector<int> edge_order;    ///< their mid-edge nodes, as nodes here
};

/// One element: a place in a PartMesh.
struct Element {
  int kind = 0;
  int first = 0;        ///< of its nodes in PartMesh::element_nodes
  std::size_t tag = 0;  ///< its number in the file, for messages
};

/// Named set of elements of one dimension.
struct PartGroup {
  std::string name;
  int dimension = 0;
  std::vector<int> elements;
};

/// Any mesh of solid elements with named groups of solids, faces, edges and points.
struct PartMesh {
  Eigen::Matrix3Xd nodes;  ///< m
  std::vector<ElementKind> kinds;
  std::vector<Element> elements;   ///< of all dimensions
  std::vector<int> element_nodes;  ///< an element after another
  std::vector<int> solids;         ///< places of the elements of dimension 3
  std::vector<PartGroup> groups;
  bool meshed_here = false;  ///< the file held a geometry

  const ElementKind& kind(int element) const { return kinds[elements[element].kind]; }
  int node(int element, int local) const {
    const auto first = static_cast<std::size_t>(elements[element].first);
    return element_nodes[first + static_cast<std::size_t>(local)];
  }
  /// Places of an element's nodes, 3 x nodes, m.
  Eigen::Matrix3Xd places(int element) const;
  /// Mean of the corners, m.
  Vector3 centre(int element) const;
  /// null if there is none of that name.
  const PartGroup* find_group(const std::string& name) const;
  std::vector<std::string> group_names() const;
  /// "element 17 (Hexahedron 20) at (0.1, 0.2, 0.3) m".
  std::string describe(int element) const;
};

/// Number of the connected part (through shared nodes) that each node belongs to, from 0; -1 for
/// nodes of no solid.
std::vector<int> connected_bodies(const PartMesh& mesh);

/// @throws ModelError naming elements whose Jacobian is not positive at an integration point, or
///   nodes that do not exist; the first ten with their places.
void check_part_mesh(const PartMesh& mesh);

}  // namespace blocklift::structure
