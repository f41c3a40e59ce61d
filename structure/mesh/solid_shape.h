#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/element_shape.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// How the nodes of a solid of one shape lie: corners first, then the middles of its edges, as
/// Abaqus counts them (C3D10, C3D15, C3D20).
struct SolidTopology {
  int corners = 0;
  std::vector<std::array<int, 2>> edges;  ///< corners at their ends
  std::vector<std::vector<int>> faces;    ///< corners around each, seen from outside; S1, S2, ...
  std::vector<int> mirrored;              ///< nodes in the order that turns the solid's inside out
  /// Quadratic, with a rule that is exact for the stiffness of solids with straight edges and
  /// parallel faces: 27 points of a hexahedron, 10 of a tetrahedron, 18 of a wedge at least, 36 of
  /// a pyramid.
  ElementKind kind;
  ElementKind linear_kind;     ///< of the corners alone, without a rule
  Eigen::MatrixXd to_corners;  ///< corners x points of the rule: their fit to what is known there

  int nodes() const { return corners + static_cast<int>(edges.size()); }
};

const SolidTopology& topology_of(SolidShape shape);

/// Shape functions through all nodes, and through the corners alone.
const ElementShape& shape_of(SolidShape shape);
const ElementShape& linear_shape_of(SolidShape shape);

/// Places of a solid's nodes, 3 x nodes, m.
Eigen::Matrix3Xd places_of(const Mesh& mesh, const Solid& solid);

/// The middles of edges that solids have in common, and the next free label of a vertex.
struct SolidEdgeMiddles {
  explicit SolidEdgeMiddles(const Mesh& mesh);

  std::map<std::pair<int, int>, int> vertices;
  long next_label = 1;
};

/// Makes a solid of corners quadratic: middles of edges that are not known become vertices of the
/// mesh, with labels of their own. Turns it where its nodes run the other way round.
void complete_solid(Mesh& mesh, Solid& solid, SolidEdgeMiddles& middles);

/// The least determinant of the Jacobian at the nodes, the centre and the points of the rule, over
/// the largest.
double least_jacobian_ratio(const Mesh& mesh, const Solid& solid);

/// The face of a solid whose corners are these vertices, in any order: its place among the faces
/// of the solid's topology; -1: it has none.
int face_of(const Solid& solid, std::vector<int> corners);

/// A face that one solid alone has.
struct SolidFace {
  int solid = 0;
  std::vector<int> corners;  ///< of the solid, in order around the face, seen from outside
};
std::vector<SolidFace> outer_faces(const Mesh& mesh);

}  // namespace blocklift::structure
