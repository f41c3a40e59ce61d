#include "structure/response/block_field.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

constexpr double slack = 1e-6;  // of the unit coordinates

bool near_box(const HexMesh& mesh, int cell, const Vector3& place) {
  Vector3 lower = Vector3::Constant(1e300), upper = -lower;
  for (const int v : mesh.cells[static_cast<std::size_t>(cell)]) {
    lower = lower.cwiseMin(mesh.vertices[static_cast<std::size_t>(v)]);
    upper = upper.cwiseMax(mesh.vertices[static_cast<std::size_t>(v)]);
  }
  const Vector3 margin = slack * (upper - lower) + Vector3::Constant(1e-9);
  return (place - lower + margin).minCoeff() >= 0 && (upper + margin - place).minCoeff() >= 0;
}

}  // namespace

CellPlace find_cell(const HexMesh& mesh, const Vector3& place) {
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (!near_box(mesh, cell, place)) continue;
    Vector3 xi = Vector3::Constant(0.5);
    constexpr int most = 20;
    for (int i = 0; i < most; ++i) {
      const Vector3 step = jacobian(mesh, cell, xi).inverse() * (place - position(mesh, cell, xi));
      xi += step;
      if (step.norm() < 1e-13) break;
    }
    if (xi.minCoeff() >= -slack && xi.maxCoeff() <= 1 + slack) return {cell, xi};
  }
  return {};
}

Eigen::MatrixXd displacements_at(const ElasticModel& model, const Eigen::MatrixXd& displacements,
                                 const Eigen::Matrix3Xd& places) {
  const Discretisation& space = model.space();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * places.cols(), displacements.cols());
  for (Eigen::Index p = 0; p < places.cols(); ++p) {
    const CellPlace place = find_cell(model.mesh(), places.col(p));
    if (place.cell < 0)
      throw ModelError(
          fmt::format("there is no material of the block at ({:.6g}, {:.6g}, {:.6g}) m",
                      places(0, p), places(1, p), places(2, p)));
    const Eigen::MatrixXd values = space.element.values(place.xi);
    for (int i = 0; i < space.nodes_per_cell; ++i)
      result.middleRows<3>(3 * p) +=
          values(0, i) * displacements.middleRows<3>(3 * space.node(place.cell, i));
  }
  return result;
}

Eigen::MatrixXd stresses_at(const ElasticModel& model, const Eigen::MatrixXd& displacements,
                            const CellPlace& place) {
  return CellStress(model.mesh(), model.space(), place.xi).of_all(place.cell, displacements);
}

}  // namespace blocklift::structure
