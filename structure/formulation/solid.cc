#include "structure/formulation/solid.h"

#include <Eigen/Dense>

#include "structure/index.h"
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

Eigen::Matrix<double, 6, 6> stiffness_law(const Material& material) {
  Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
  law.topLeftCorner<3, 3>().setConstant(material.lame_lambda());
  law.diagonal().head<3>().array() += 2 * material.shear_modulus();
  law.diagonal().tail<3>().setConstant(material.shear_modulus());
  return law;
}

}  // namespace

std::vector<SolidPoint> solid_points(const Mesh& mesh, const Solid& solid) {
  const SolidRule& rule = rule_of(solid.shape);
  const Eigen::Matrix3Xd places = places_of(mesh, solid);
  std::vector<SolidPoint> points;
  for (std::size_t q = 0; q < rule.values.size(); ++q) {
    const Eigen::Matrix3d jacobian = places * rule.slopes[q];
    points.push_back({rule.weights[static_cast<Eigen::Index>(q)] * jacobian.determinant(),
                      rule.values[q], jacobian.transpose().inverse() * rule.slopes[q].transpose()});
  }
  return points;
}

Eigen::MatrixXd solid_stiffness(const Mesh& mesh, const Solid& solid) {
  const Eigen::Matrix<double, 6, 6> law = stiffness_law(mesh.materials[at(solid.material)]);
  const auto size = 3 * static_cast<Eigen::Index>(solid.vertices.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (const SolidPoint& point : solid_points(mesh, solid)) {
    const Eigen::MatrixXd strain = strain_operator(point.gradients);
    stiffness.noalias() += strain.transpose() * (point.weight * law * strain);
  }
  return stiffness;
}

Eigen::MatrixXd solid_corner_stresses(const Space& space, int solid,
                                      const Eigen::Ref<const Eigen::MatrixXd>& motions) {
  const Mesh& mesh = space.mesh();
  const Solid& element = mesh.solids[at(solid)];
  const Eigen::Matrix<double, 6, 6> law = stiffness_law(mesh.materials[at(element.material)]);
  const int* nodes = space.solid_nodes(solid);
  Eigen::MatrixXd local(3 * static_cast<Eigen::Index>(element.vertices.size()), motions.cols());
  for (std::size_t i = 0; i < element.vertices.size(); ++i)
    local.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        motions.middleRows<3>(6 * static_cast<Eigen::Index>(nodes[i]));
  const Eigen::MatrixXd& to_corners = rule_of(element.shape).to_corners;
  Eigen::MatrixXd at_corners = Eigen::MatrixXd::Zero(6 * to_corners.rows(), motions.cols());
  const std::vector<SolidPoint> points = solid_points(mesh, element);
  for (std::size_t q = 0; q < points.size(); ++q) {
    const Eigen::MatrixXd stress = law * (strain_operator(points[q].gradients) * local);
    for (Eigen::Index c = 0; c < to_corners.rows(); ++c)
      at_corners.middleRows<6>(6 * c) += to_corners(c, static_cast<Eigen::Index>(q)) * stress;
  }
  return at_corners;
}

}  // namespace blocklift::structure
