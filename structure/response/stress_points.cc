#include "structure/response/stress_points.h"

#include <algorithm>
#include <utility>

#include <Eigen/Dense>

#include "structure/formulation/beam.h"
#include "structure/index.h"
#include "structure/space/joints.h"

namespace blocklift::structure {

namespace {

// The nodes' places, a little inside: at the edge of a triangle that is a point there are no tangents.
Eigen::Matrix2Xd points_of_cell(int degree) {
  const std::vector<double> line = lagrange_places(degree);
  Eigen::Matrix2Xd points(2, (degree + 1) * (degree + 1));
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i <= degree; ++i)
      points.col(j * (degree + 1) + i) << 0.01 + 0.98 * line[at(i)], 0.01 + 0.98 * line[at(j)];
  return points;
}

}  // namespace

Eigen::Matrix3d plane_stress_law(const Material& material) {
  const double nu = material.poisson_ratio;
  Eigen::Matrix3d law;
  law << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return material.youngs_modulus / (1 - nu * nu) * law;
}

StressPoints::StressPoints(const Space& space)
    : space_(space),
      shell_points_(2 * space.nodes_per_shell() * static_cast<int>(space.shells().size())) {
  for (std::size_t cell = 0; cell < space.beams().size(); ++cell) {
    const Beam& beam = space.mesh().beams[at(space.beams()[cell].beam)];
    for (const Eigen::Vector2d& point : space.mesh().section_of(beam).stress_points)
      for (const int end : {0, 1}) beam_points_.push_back({static_cast<int>(cell), end, point});
  }
}

int StressPoints::region(int point) const {
  const Mesh& mesh = space_.mesh();
  if (point < shell_points_)
    return mesh.shells[at(space_.shells()[at(point / points_per_cell())].shell)].region;
  const BeamPointOf& of_beam = beam_points_[at(point - shell_points_)];
  return mesh.beams[at(space_.beams()[at(of_beam.cell)].beam)].region;
}

Vector3 StressPoints::place(int point) const {
  if (point < shell_points_)
    return space_.nodes().col(
        space_.shell_nodes(point / points_per_cell())[point % points_per_cell() / 2]);
  const BeamPointOf& of_beam = beam_points_[at(point - shell_points_)];
  const std::vector<int>& nodes = space_.beams()[at(of_beam.cell)].nodes;
  return space_.nodes().col(of_beam.end == 0 ? nodes.front() : nodes.back());
}

std::unique_ptr<ShellOperator> StressPoints::borrow() const {
  {
    const std::lock_guard lock(lending_);
    if (!operators_.empty()) {
      std::unique_ptr<ShellOperator> one = std::move(operators_.back());
      operators_.pop_back();
      return one;
    }
  }
  return std::make_unique<ShellOperator>(space_, points_of_cell(space_.degree()));
}

void StressPoints::give_back(std::unique_ptr<ShellOperator> one) const {
  const std::lock_guard lock(lending_);
  operators_.push_back(std::move(one));
}

Eigen::MatrixXd StressPoints::stresses(int first, int count, const Eigen::MatrixXd& motions) const {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6 * count, motions.cols());
  const int shells = std::clamp(shell_points_ - first, 0, count);
  if (shells > 0) shell_stresses(first, shells, motions, rows.topRows(6 * shells));
  for (int i = shells; i < count; ++i)
    rows.row(6 * i) = beam_stress(beam_points_[at(first + i - shell_points_)], motions);
  return rows;
}

void StressPoints::shell_stresses(int first, int count, const Eigen::MatrixXd& motions,
                                  Eigen::Ref<Eigen::MatrixXd> rows) const {
  std::unique_ptr<ShellOperator> shell_operator = borrow();
  const Mesh& mesh = space_.mesh();
  Eigen::MatrixXd local(6 * space_.nodes_per_shell(), motions.cols());
  int known_cell = -1;
  Eigen::Matrix3d law;
  double half = 0;
  for (int i = 0; i < count; ++i) {
    const int point = first + i, cell = point / points_per_cell();
    if (cell != known_cell) {
      known_cell = cell;
      shell_operator->reinit(cell);
      for (int node = 0; node < space_.nodes_per_shell(); ++node)
        local.middleRows<6>(6 * node) = motions.middleRows<6>(6 * space_.shell_nodes(cell)[node]);
      const Shell& shell = mesh.shells[at(space_.shells()[at(cell)].shell)];
      law = plane_stress_law(mesh.material_of(shell));
      half = mesh.section_of(shell).thickness / 2;
    }
    const auto& strain = shell_operator->points()[at(point % points_per_cell() / 2)].strain;
    const double height = point % 2 == 0 ? half : -half;
    const Eigen::MatrixXd stress =
        law *
        ((strain.middleRows<3>(membrane_11) + height * strain.middleRows<3>(curvature_11)) * local);
    rows.row(6 * i) = stress.row(0);
    rows.row(6 * i + 1) = stress.row(1);
    rows.row(6 * i + 3) = stress.row(2);
  }
  give_back(std::move(shell_operator));
}

Eigen::RowVectorXd StressPoints::beam_stress(const BeamPointOf& point,
                                             const Eigen::MatrixXd& motions) const {
  const BeamCell& cell = space_.beams()[at(point.cell)];
  const Beam& beam = space_.mesh().beams[at(cell.beam)];
  const BeamPoint strained = beam_point(space_, point.cell, point.end);
  Eigen::MatrixXd local(6 * static_cast<Eigen::Index>(cell.nodes.size()), motions.cols());
  for (std::size_t i = 0; i < cell.nodes.size(); ++i)
    local.middleRows<6>(6 * static_cast<Eigen::Index>(i)) =
        motions.middleRows<6>(6 * cell.nodes[i]);
  const Eigen::MatrixXd strain = strained.strain * local;
  const Material& material = space_.mesh().materials[at(space_.mesh().section_of(beam).material)];
  return material.youngs_modulus *
         (strain.row(0) + point.at[1] * strain.row(4) - point.at[0] * strain.row(5));
}

}  // namespace blocklift::structure
