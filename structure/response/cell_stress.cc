#include "structure/response/cell_stress.h"

#include <utility>

#include <Eigen/Dense>

namespace blocklift::structure {

CellStress::CellStress(const HexMesh& mesh, const Discretisation& space, Eigen::Matrix3Xd points)
    : mesh_(mesh),
      space_(space),
      points_(std::move(points)),
      gradients_(space.element.gradients(points_)) {}

Eigen::Matrix<double, 6, Eigen::Dynamic> CellStress::operator()(
    int cell, const Eigen::VectorXd& displacement) const {
  Eigen::MatrixX3d local(space_.nodes_per_cell, 3);
  for (int i = 0; i < space_.nodes_per_cell; ++i)
    local.row(i) = displacement.segment<3>(3 * space_.node(cell, i)).transpose();
  const Eigen::MatrixX3d by_unit = gradients_ * local;  // row 3 q + c: du/dxi_c
  const bool affine = space_.shape_affine[static_cast<std::size_t>(
                          space_.cell_shape[static_cast<std::size_t>(cell)])] != 0;
  Eigen::Matrix3d inverse = jacobian(mesh_, cell, points_.col(0)).inverse();
  const Material& material = mesh_.material_of_cell(cell);
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress(6, points_.cols());
  for (Eigen::Index q = 0; q < points_.cols(); ++q) {
    if (!affine) inverse = jacobian(mesh_, cell, points_.col(q)).inverse();
    stress.col(q) =
        stress_of_gradient(material, by_unit.middleRows<3>(3 * q).transpose() * inverse);
  }
  return stress;
}

Eigen::MatrixXd CellStress::of_all(int cell, const Eigen::MatrixXd& displacements) const {
  const Eigen::Index cases = displacements.cols();
  Eigen::MatrixXd local(space_.nodes_per_cell, 3 * cases);  // column 3 m + a: u_a of case m
  for (int i = 0; i < space_.nodes_per_cell; ++i)
    for (Eigen::Index m = 0; m < cases; ++m)
      local.block<1, 3>(i, 3 * m) =
          displacements.block<3, 1>(3 * space_.node(cell, i), m).transpose();
  const Eigen::MatrixXd by_unit = gradients_ * local;  // (3 q + c, 3 m + a): du_a/dxi_c
  const Material& material = mesh_.material_of_cell(cell);
  Eigen::MatrixXd stress(6 * points_.cols(), cases);
  for (Eigen::Index q = 0; q < points_.cols(); ++q) {
    const Eigen::Matrix3d inverse = jacobian(mesh_, cell, points_.col(q)).inverse();
    for (Eigen::Index m = 0; m < cases; ++m)
      stress.block<6, 1>(6 * q, m) =
          stress_of_gradient(material, by_unit.block<3, 3>(3 * q, 3 * m).transpose() * inverse);
  }
  return stress;
}

Eigen::VectorXd CellStress::von_mises(int cell, const Eigen::VectorXd& displacement) const {
  const auto stress = (*this)(cell, displacement);
  Eigen::VectorXd result(stress.cols());
  for (Eigen::Index q = 0; q < stress.cols(); ++q) result[q] = structure::von_mises(stress.col(q));
  return result;
}

}  // namespace blocklift::structure
