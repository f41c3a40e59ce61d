#include "structure/mesh/element_tables.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

namespace blocklift::structure {

namespace {

using Pairs = std::vector<std::array<int, 2>>;

// Corner pairs of the mid-edge nodes in the order that VTK and Abaqus share.
Pairs edges_of(int dimension, int corners) {
  if (dimension == 3 && corners == 8)
    return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
            {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  if (dimension == 3 && corners == 4) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  if (dimension == 3 && corners == 6)
    return {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  return {};
}

void find_orders(ElementKind& kind) {
  for (int corner = 0; corner < kind.corners; ++corner) kind.corner_order.push_back(corner);
  if (kind.order < 2) return;
  for (const auto& [a, b] : edges_of(kind.dimension, kind.corners)) {
    const Vector3 middle = (kind.local.col(a) + kind.local.col(b)) / 2;
    Eigen::Index node = 0;
    (kind.local.colwise() - middle).colwise().squaredNorm().minCoeff(&node);
    kind.edge_order.push_back(static_cast<int>(node));
  }
}

Eigen::MatrixXd basis(int type, const std::vector<double>& points, const char* function, int rows,
                      int nodes) {
  int components = 0, orientations = 0;
  std::vector<double> values;
  gmsh::model::mesh::getBasisFunctions(type, points, function, components, values, orientations);
  // A point after another; for each, a node after another; for each, its components.
  const auto count = static_cast<Eigen::Index>(points.size() / 3);
  Eigen::MatrixXd table(rows * count, nodes);
  for (Eigen::Index q = 0; q < count; ++q)
    for (int n = 0; n < nodes; ++n)
      for (int c = 0; c < rows; ++c)
        table(rows * q + c, n) = values[(q * nodes + n) * components + c];
  return table;
}

struct Rule {
  Eigen::Matrix3Xd points;
  Eigen::VectorXd weights;
};

Rule rule_of(int type, int degree) {
  std::vector<double> points, weights;
  gmsh::model::mesh::getIntegrationPoints(type, fmt::format("Gauss{}", degree), points, weights);
  const auto count = static_cast<Eigen::Index>(weights.size());
  return {Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, count),
          Eigen::Map<const Eigen::VectorXd>(weights.data(), count)};
}

// The product of a rule in the first local coordinates with one on a line in the next.
Rule product(const Rule& base, const Rule& line, int axis) {
  Rule rule{Eigen::Matrix3Xd::Zero(3, base.weights.size() * line.weights.size()),
            Eigen::VectorXd(base.weights.size() * line.weights.size())};
  Eigen::Index q = 0;
  for (Eigen::Index j = 0; j < line.weights.size(); ++j)
    for (Eigen::Index i = 0; i < base.weights.size(); ++i, ++q) {
      rule.points.col(q) = base.points.col(i);
      rule.points(axis, q) = line.points(0, j);
      rule.weights[q] = base.weights[i] * line.weights[j];
    }
  return rule;
}

// Exact for polynomials of twice the element's order: in all coordinates together for simplices, in
// each for products.
void find_rule(int type, ElementKind& kind) {
  constexpr int line_type = 1, triangle_type = 2;
  const int degree = 2 * kind.order;
  const Rule line = rule_of(line_type, degree);
  Rule rule;
  if (kind.corners == kind.dimension + 1)
    rule = rule_of(type, degree);
  else if (kind.dimension == 2)
    rule = product(line, line, 1);
  else if (kind.corners == 6)
    rule = product(rule_of(triangle_type, degree), line, 2);
  else
    rule = product(product(line, line, 1), line, 2);
  kind.rule = rule.points;
  kind.weights = rule.weights;
}

}  // namespace

ElementKind tabulate_element(int type) {
  ElementKind kind;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, kind.name, kind.dimension, kind.order, kind.nodes,
                                          local, kind.corners);
  kind.local.setZero(3, kind.nodes);
  for (int n = 0; n < kind.nodes; ++n)
    for (int a = 0; a < kind.dimension; ++a) kind.local(a, n) = local[n * kind.dimension + a];
  find_orders(kind);
  if (kind.dimension == 0) return kind;
  find_rule(type, kind);
  const std::vector<double> points(kind.rule.data(), kind.rule.data() + kind.rule.size());
  kind.values = basis(type, points, "Lagrange", 1, kind.nodes);
  kind.gradients = basis(type, points, "GradLagrange", 3, kind.nodes);
  const std::vector<double> nodes(kind.local.data(), kind.local.data() + kind.local.size());
  kind.gradients_at_nodes = basis(type, nodes, "GradLagrange", 3, kind.nodes);
  return kind;
}

namespace {

// The solid's node at a local place.
int node_at(const ElementKind& solid, const Vector3& place) {
  Eigen::Index node = 0;
  (solid.local.colwise() - place).colwise().squaredNorm().minCoeff(&node);
  return static_cast<int>(node);
}

// Gmsh's types of triangles and quadrangles by their numbers of nodes.
int face_type(std::size_t nodes) {
  switch (nodes) {
    case 3:
      return 2;
    case 6:
      return 9;
    case 4:
      return 3;
    case 8:
      return 16;
    default:
      return 10;
  }
}

}  // namespace

std::vector<ElementFace> element_faces(const ElementKind& solid) {
  using Corners = std::vector<std::vector<int>>;
  static const Corners tetrahedron = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};
  static const Corners wedge = {{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  static const Corners hexahedron = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::vector<ElementFace> faces;
  for (const std::vector<int>& corners : solid.corners == 4   ? tetrahedron
                                         : solid.corners == 6 ? wedge
                                                              : hexahedron) {
    ElementFace face{0, static_cast<int>(corners.size()), corners};
    if (solid.order > 1) {
      Vector3 middle = Vector3::Zero();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3 from = solid.local.col(corners[i]);
        const Vector3 to = solid.local.col(corners[(i + 1) % corners.size()]);
        face.nodes.push_back(node_at(solid, (from + to) / 2));
        middle += from / static_cast<double>(corners.size());
      }
      const int inner = node_at(solid, middle);
      if (corners.size() == 4 && (solid.local.col(inner) - middle).norm() < 1e-6)
        face.nodes.push_back(inner);
    }
    face.gmsh_type = face_type(face.nodes.size());
    faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace blocklift::structure
