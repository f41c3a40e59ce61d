#include "structure/formulation/solid.h"

#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "structure/mesh/directional.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// 6 x 3 nodes: strains xx, yy, zz, xy, yz, zx (engineering shear) of the displacements.
Eigen::MatrixXd strain_operator(const Eigen::Matrix3Xd& g) {
  Eigen::MatrixXd strain = Eigen::MatrixXd::Zero(6, 3 * g.cols());
  for (Eigen::Index i = 0; i < g.cols(); ++i) {
    auto own = strain.middleCols<3>(3 * i);
    own.diagonal() = g.col(i);
    own.row(3) << g(1, i), g(0, i), 0;
    own.row(4) << 0, g(2, i), g(1, i);
    own.row(5) << g(2, i), 0, g(0, i);
  }
  return strain;
}

}  // namespace

std::vector<SolidPoint> solid_points(const ElementKind& kind, const Eigen::Matrix3Xd& places) {
  std::vector<SolidPoint> points;
  points.reserve(kind.weights.size());
  for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
    const auto by_unit = kind.gradients.middleRows<3>(3 * q);
    const Eigen::Matrix3d jacobian = places * by_unit.transpose();
    points.push_back({kind.weights[q] * jacobian.determinant(),
                      places * kind.values.row(q).transpose(), kind.values.row(q),
                      jacobian.inverse().transpose() * by_unit});
  }
  return points;
}

Eigen::MatrixXd solid_stiffness(const ElementKind& kind, const Eigen::Matrix3Xd& places,
                                const Material& material) {
  const double lambda = material.lame_lambda(), mu = material.shear_modulus();
  const std::vector<SolidPoint> points = solid_points(kind, places);
  const Eigen::Index n = kind.nodes;
  // Of each axis the slopes at all points and weighted ones: products of long rows are fast.
  std::array<Eigen::MatrixXd, 3> slopes, weighted;
  for (std::size_t a = 0; a < 3; ++a) {
    slopes[a].resize(points.size(), n);
    for (std::size_t q = 0; q < points.size(); ++q) slopes[a].row(q) = points[q].gradients.row(a);
    weighted[a] = slopes[a];
    for (std::size_t q = 0; q < points.size(); ++q) weighted[a].row(q) *= points[q].weight;
  }
  Eigen::MatrixXd stiffness(3 * n, 3 * n);
  using Strided = Eigen::Map<Eigen::MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>>;
  const auto block = [&](int a, int b) {
    return Strided(&stiffness(a, b), n, n, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>(9 * n, 3));
  };
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b <= a; ++b) {
      const Eigen::MatrixXd product = weighted[a].transpose() * slopes[b];
      block(a, b) = lambda * product + mu * product.transpose();
      if (a == b)
        laplacian += product;
      else
        block(b, a) = block(a, b).transpose();
    }
  for (int a = 0; a < 3; ++a) block(a, a) += mu * laplacian;
  return stiffness;
}

Eigen::MatrixXd solid_stiffness(const ElementKind& kind, const Eigen::Matrix3Xd& places,
                                const Elasticity& elasticity) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * kind.nodes, 3 * kind.nodes);
  for (const SolidPoint& point : solid_points(kind, places)) {
    const Eigen::MatrixXd strain = strain_operator(point.gradients);
    stiffness.noalias() += strain.transpose() * (point.weight * elasticity * strain);
  }
  return stiffness;
}

Eigen::MatrixXd solid_mass(const ElementKind& kind, const Eigen::Matrix3Xd& places,
                           double density) {
  Eigen::MatrixXd of_nodes = Eigen::MatrixXd::Zero(kind.nodes, kind.nodes);
  for (const SolidPoint& point : solid_points(kind, places))
    of_nodes.noalias() += density * point.weight * point.values * point.values.transpose();
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(3 * kind.nodes, 3 * kind.nodes);
  for (Eigen::Index j = 0; j < kind.nodes; ++j)
    for (Eigen::Index i = 0; i < kind.nodes; ++i)
      mass.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(of_nodes(i, j));
  return mass;
}

std::vector<SolidPoint> solid_points(const Mesh& mesh, const Solid& solid) {
  return solid_points(topology_of(solid.shape).kind, places_of(mesh, solid));
}

Eigen::MatrixXd solid_stiffness(const Mesh& mesh, const Solid& solid) {
  const ElementKind& kind = topology_of(solid.shape).kind;
  const Eigen::Matrix3Xd places = places_of(mesh, solid);
  return solid.elasticity >= 0 ? solid_stiffness(kind, places, mesh.elasticities[solid.elasticity])
                               : solid_stiffness(kind, places, mesh.materials[solid.material]);
}

Eigen::MatrixXd solid_stresses(const Space& space, int solid,
                               const Eigen::Ref<const Eigen::MatrixXd>& motions,
                               const CellHeat* heat) {
  const Mesh& mesh = space.mesh();
  const Solid& element = mesh.solids[solid];
  const Elasticity law = elasticity_of(mesh, element);
  const int* nodes = space.solid_nodes(solid);
  Eigen::MatrixXd local(3 * static_cast<Eigen::Index>(element.vertices.size()), motions.cols());
  for (std::size_t i = 0; i < element.vertices.size(); ++i)
    local.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        motions.middleRows<3>(6 * static_cast<Eigen::Index>(nodes[i]));
  const std::vector<SolidPoint> points = solid_points(mesh, element);
  Eigen::MatrixXd stresses(6 * static_cast<Eigen::Index>(points.size()), motions.cols());
  for (std::size_t q = 0; q < points.size(); ++q)
    stresses.middleRows<6>(6 * static_cast<Eigen::Index>(q)) =
        law * (strain_operator(points[q].gradients) * local);
  if (heat != nullptr)
    stresses -= heat->solid_stresses(solid, topology_of(element.shape).kind.values);
  return stresses;
}

Eigen::MatrixXd solid_corner_stresses(const Space& space, int solid,
                                      const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                      const CellHeat* heat) {
  const Eigen::MatrixXd& to_corners = topology_of(space.mesh().solids[solid].shape).to_corners;
  const Eigen::MatrixXd at_points = solid_stresses(space, solid, motions, heat);
  Eigen::MatrixXd at_corners = Eigen::MatrixXd::Zero(6 * to_corners.rows(), motions.cols());
  for (Eigen::Index q = 0; q < to_corners.cols(); ++q)
    for (Eigen::Index c = 0; c < to_corners.rows(); ++c)
      at_corners.middleRows<6>(6 * c) += to_corners(c, q) * at_points.middleRows<6>(6 * q);
  return at_corners;
}

}  // namespace blocklift::structure
