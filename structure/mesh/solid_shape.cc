#include "structure/mesh/solid_shape.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/Dense>
#include <deal.II/base/quadrature_lib.h>

#include "algebra/decompositions.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

/// Gauss' rule in the coordinates in which a pyramid is a cube: x = (1 - z) xi, y = (1 - z) eta.
/// There its shape functions and their slopes are polynomials.
dealii::Quadrature<3> pyramid_rule() {
  const dealii::QGauss<1> across(3), up(4);
  std::vector<dealii::Point<3>> points;
  std::vector<double> weights;
  for (unsigned k = 0; k < up.size(); ++k)
    for (unsigned j = 0; j < across.size(); ++j)
      for (unsigned i = 0; i < across.size(); ++i) {
        const double left = 1 - up.point(k)[0];
        points.emplace_back(left * (2 * across.point(i)[0] - 1),
                            left * (2 * across.point(j)[0] - 1), up.point(k)[0]);
        weights.push_back(4 * left * left * across.weight(i) * across.weight(j) * up.weight(k));
      }
  return {points, weights};
}

dealii::Quadrature<3> unit_rule(int corners) {
  if (corners == 5) return pyramid_rule();
  if (corners == 4) return dealii::QGaussSimplex<3>(3);
  if (corners == 6) return dealii::QGaussWedge<3>(3);
  return dealii::QGauss<3>(3);
}

void tabulate_rule(ElementKind& kind) {
  const dealii::Quadrature<3> unit = unit_rule(kind.corners);
  const auto count = static_cast<Eigen::Index>(unit.size());
  const ElementShape shape(kind);
  kind.rule.resize(3, count);
  kind.weights.resize(count);
  kind.values.resize(count, kind.nodes);
  kind.gradients.resize(3 * count, kind.nodes);
  for (Eigen::Index q = 0; q < count; ++q) {
    const auto& x = unit.point(static_cast<unsigned>(q));
    // deal.II's unit cells end at 0 and 1; here hexahedra and the height of wedges at -1 and 1.
    Vector3 xi(x[0], x[1], x[2]);
    double stretch = 1;
    if (kind.corners == 8) {
      xi = 2 * xi - Vector3::Ones();
      stretch = 8;
    } else if (kind.corners == 6) {
      xi.z() = 2 * xi.z() - 1;
      stretch = 2;
    }
    kind.rule.col(q) = xi;
    kind.weights[q] = stretch * unit.weight(static_cast<unsigned>(q));
    kind.values.row(q) = shape.values(xi).transpose();
    kind.gradients.middleRows<3>(3 * q) = shape.gradients(xi).transpose();
  }
}

Eigen::MatrixXd values_at_rule(const ElementKind& kind, const ElementKind& linear) {
  const ElementShape shape(linear);
  Eigen::MatrixXd at_points(kind.rule.cols(), linear.nodes);
  for (Eigen::Index q = 0; q < kind.rule.cols(); ++q)
    at_points.row(q) = shape.values(kind.rule.col(q)).transpose();
  return at_points;
}

SolidTopology make_topology(const char* name, const Eigen::Matrix3Xd& corners,
                            std::vector<std::array<int, 2>> edges,
                            std::vector<std::vector<int>> faces, std::vector<int> mirrored) {
  SolidTopology topology;
  topology.corners = static_cast<int>(corners.cols());
  topology.edges = std::move(edges);
  topology.faces = std::move(faces);
  topology.mirrored = std::move(mirrored);
  ElementKind& kind = topology.kind;
  kind.name = name;
  kind.dimension = 3;
  kind.order = 2;
  kind.nodes = topology.nodes();
  kind.corners = topology.corners;
  kind.local.resize(3, kind.nodes);
  kind.local.leftCols(corners.cols()) = corners;
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    kind.local.col(corners.cols() + static_cast<Eigen::Index>(e)) =
        0.5 * (corners.col(topology.edges[e][0]) + corners.col(topology.edges[e][1]));
  topology.linear_kind = kind;
  topology.linear_kind.order = 1;
  topology.linear_kind.nodes = kind.corners;
  topology.linear_kind.local = corners;
  tabulate_rule(kind);
  topology.to_corners = algebra::pseudo_inverse(values_at_rule(kind, topology.linear_kind));
  return topology;
}

SolidTopology tetrahedron() {
  Eigen::Matrix3Xd corners(3, 4);
  corners << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  return make_topology("tetrahedron", corners, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                       {1, 0, 2, 3, 4, 6, 5, 8, 7, 9});
}

SolidTopology wedge() {
  Eigen::Matrix3Xd corners(3, 6);
  corners << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, -1, -1, -1, 1, 1, 1;
  return make_topology("wedge", corners,
                       {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
                       {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
                       {3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8, 12, 13, 14});
}

SolidTopology hexahedron() {
  Eigen::Matrix3Xd corners(3, 8);
  corners << -1, 1, 1, -1, -1, 1, 1, -1, -1, -1, 1, 1, -1, -1, 1, 1, -1, -1, -1, -1, 1, 1, 1, 1;
  return make_topology(
      "hexahedron", corners,
      {{0, 1},
       {1, 2},
       {2, 3},
       {3, 0},
       {4, 5},
       {5, 6},
       {6, 7},
       {7, 4},
       {0, 4},
       {1, 5},
       {2, 6},
       {3, 7}},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
      {4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11, 16, 17, 18, 19});
}

SolidTopology pyramid() {
  Eigen::Matrix3Xd corners(3, 5);
  corners << -1, 1, 1, -1, 0, -1, -1, 1, 1, 0, 0, 0, 0, 0, 1;
  return make_topology("pyramid", corners,
                       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
                       {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                       {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10});
}

// The shapes, in the order of SolidShape.
const std::array<SolidTopology, 4>& topologies() {
  static const std::array<SolidTopology, 4> all{tetrahedron(), wedge(), hexahedron(), pyramid()};
  return all;
}

Vector3 centre_of(const SolidTopology& topology) {
  return topology.linear_kind.local.rowwise().mean();
}

/// d N_i / d xi_a, three rows a point, where a solid's shape is judged: at its nodes, its centre
/// and the points of its rule.
Eigen::MatrixXd find_judged_gradients(SolidShape form) {
  const SolidTopology& topology = topology_of(form);
  const ElementKind& kind = topology.kind;
  const Eigen::Index own = 3L * (kind.nodes + 1);
  Eigen::MatrixXd gradients(own + kind.gradients.rows(), kind.nodes);
  for (Eigen::Index i = 0; i < kind.nodes; ++i)
    gradients.middleRows<3>(3 * i) = shape_of(form).gradients(kind.local.col(i)).transpose();
  gradients.middleRows<3>(3L * kind.nodes) =
      shape_of(form).gradients(centre_of(topology)).transpose();
  gradients.bottomRows(kind.gradients.rows()) = kind.gradients;
  return gradients;
}

const Eigen::MatrixXd& judged_gradients(SolidShape form) {
  static const std::array<Eigen::MatrixXd, 4> all{
      find_judged_gradients(SolidShape::tetrahedron), find_judged_gradients(SolidShape::wedge),
      find_judged_gradients(SolidShape::hexahedron), find_judged_gradients(SolidShape::pyramid)};
  return all[static_cast<std::size_t>(form)];
}

}  // namespace

const SolidTopology& topology_of(SolidShape shape) {
  return topologies()[static_cast<std::size_t>(shape)];
}

const ElementShape& shape_of(SolidShape shape) {
  static const std::array<ElementShape, 4> all{
      ElementShape(topologies()[0].kind), ElementShape(topologies()[1].kind),
      ElementShape(topologies()[2].kind), ElementShape(topologies()[3].kind)};
  return all[static_cast<std::size_t>(shape)];
}

const ElementShape& linear_shape_of(SolidShape shape) {
  static const std::array<ElementShape, 4> all{
      ElementShape(topologies()[0].linear_kind), ElementShape(topologies()[1].linear_kind),
      ElementShape(topologies()[2].linear_kind), ElementShape(topologies()[3].linear_kind)};
  return all[static_cast<std::size_t>(shape)];
}

Eigen::Matrix3Xd places_of(const Mesh& mesh, const Solid& solid) {
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(solid.vertices.size()));
  for (std::size_t i = 0; i < solid.vertices.size(); ++i)
    places.col(i) = mesh.vertices[solid.vertices[i]];
  return places;
}

SolidEdgeMiddles::SolidEdgeMiddles(const Mesh& mesh) {
  for (const long label : mesh.vertex_labels) next_label = std::max(next_label, label + 1);
}

void complete_solid(Mesh& mesh, Solid& solid, SolidEdgeMiddles& middles) {
  const SolidTopology& topology = topology_of(solid.shape);
  solid.vertices.resize(topology.nodes(), -1);
  // The other way round at its centre: its nodes are counted against the rule.
  const Eigen::Matrix3Xd corners = places_of(
      mesh, {solid.shape, {solid.vertices.begin(), solid.vertices.begin() + topology.corners}});
  const Eigen::Matrix3d jacobian =
      corners * linear_shape_of(solid.shape).gradients(centre_of(topology));
  if (jacobian.determinant() < 0) {
    const std::vector<int> given = solid.vertices;
    for (std::size_t i = 0; i < given.size(); ++i) solid.vertices[i] = given[topology.mirrored[i]];
  }
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    int& middle = solid.vertices[at(topology.corners) + e];
    const int a = solid.vertices[topology.edges[e][0]], b = solid.vertices[topology.edges[e][1]];
    const auto [known, is_new] = middles.vertices.try_emplace(std::minmax(a, b), middle);
    if (middle < 0) middle = known->second;
    if (middle >= 0) continue;
    middle = known->second = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    if (!mesh.vertex_labels.empty()) mesh.vertex_labels.push_back(middles.next_label++);
  }
}

double least_jacobian_ratio(const Mesh& mesh, const Solid& solid) {
  const Eigen::MatrixXd& gradients = judged_gradients(solid.shape);
  const Eigen::Matrix3Xd places = places_of(mesh, solid);
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  for (Eigen::Index row = 0; row < gradients.rows(); row += 3) {
    const Eigen::Matrix3d jacobian = places * gradients.middleRows<3>(row).transpose();
    const double here = jacobian.determinant();
    least = std::min(least, here);
    largest = std::max(largest, here);
  }
  return largest > 0 ? least / largest : -1;
}

int face_of(const Solid& solid, std::vector<int> corners) {
  std::sort(corners.begin(), corners.end());
  const auto& faces = topology_of(solid.shape).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::vector<int> own;
    for (const int corner : faces[f]) own.push_back(solid.vertices[corner]);
    std::sort(own.begin(), own.end());
    if (own == corners) return static_cast<int>(f);
  }
  return -1;
}

std::vector<SolidFace> outer_faces(const Mesh& mesh) {
  std::map<std::vector<int>, std::pair<int, SolidFace>> faces;
  for (std::size_t s = 0; s < mesh.solids.size(); ++s)
    for (const std::vector<int>& face : topology_of(mesh.solids[s].shape).faces) {
      std::vector<int> key;
      for (const int corner : face) key.push_back(mesh.solids[s].vertices[corner]);
      std::sort(key.begin(), key.end());
      auto& [count, known] = faces[key];
      if (count++ == 0) known = {static_cast<int>(s), face};
    }
  std::vector<SolidFace> outer;
  for (auto& [key, face] : faces)
    if (face.first == 1) outer.push_back(std::move(face.second));
  // In the solids' order, which is the file's.
  std::stable_sort(outer.begin(), outer.end(),
                   [](const SolidFace& a, const SolidFace& b) { return a.solid < b.solid; });
  return outer;
}

}  // namespace blocklift::structure
