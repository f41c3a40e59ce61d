#include "structure/stress/stress_points.h"

#include <algorithm>
#include <utility>

#include <Eigen/Dense>

#include "structure/formulation/solid.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/joints.h"
#include "structure/stress/beam_stress.h"

namespace blocklift::structure {

namespace {

// The nodes' places, a little inside: at the edge of a triangle that is a point there are no
// tangents.
Eigen::Matrix2Xd points_of_cell(int degree) {
  const std::vector<double> line = lagrange_places(degree);
  Eigen::Matrix2Xd points(2, (degree + 1) * (degree + 1));
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i <= degree; ++i)
      points.col(j * (degree + 1) + i) << 0.01 + 0.98 * line[i], 0.01 + 0.98 * line[j];
  return points;
}

}  // namespace

StressPoints::StressPoints(const Space& space)
    : space_(space),
      shell_points_(2 * space.nodes_per_shell() * static_cast<int>(space.shells().size())) {
  for (std::size_t cell = 0; cell < space.beams().size(); ++cell) {
    const BeamCell& located = space.beams()[cell];
    // Between the ends, too: one cell may be all that a deck has between two supports.
    for (const double xi : {0.0, 0.5, 1.0}) {
      const std::size_t points = points_of_beam(space.mesh(), space.mesh().beams[located.beam],
                                                located.origin + located.size * xi)
                                     .size();
      for (std::size_t point = 0; point < points; ++point)
        beam_points_.push_back({static_cast<int>(cell), xi, static_cast<int>(point)});
    }
  }
  const std::vector<Solid>& solids = space.mesh().solids;
  for (std::size_t s = 0; s < solids.size(); ++s)
    for (int corner = 0; corner < topology_of(solids[s].shape).corners; ++corner)
      solid_points_.push_back({static_cast<int>(s), corner});
}

int StressPoints::region(int point) const {
  const Mesh& mesh = space_.mesh();
  if (point < shell_points_)
    return mesh.shells[space_.shells()[point / points_per_cell()].shell].region;
  if (is_of_solid(point)) return mesh.solids[solid_point(point).solid].region;
  const BeamPointOf& of_beam = beam_points_[point - shell_points_];
  return mesh.beams[space_.beams()[of_beam.cell].beam].region;
}

Vector3 StressPoints::place(int point) const {
  if (point < shell_points_)
    return space_.nodes().col(
        space_.shell_nodes(point / points_per_cell())[point % points_per_cell() / 2]);
  if (is_of_solid(point)) {
    const SolidPointOf& of_solid = solid_point(point);
    return space_.nodes().col(space_.solid_nodes(of_solid.solid)[of_solid.corner]);
  }
  const BeamPointOf& of_beam = beam_points_[point - shell_points_];
  const std::vector<int>& nodes = space_.beams()[of_beam.cell].nodes;
  return (1 - of_beam.xi) * space_.nodes().col(nodes.front()) +
         of_beam.xi * space_.nodes().col(nodes.back());
}

std::unique_ptr<ShellStress> StressPoints::borrow() const {
  {
    const std::lock_guard lock(lending_);
    if (!recoveries_.empty()) {
      std::unique_ptr<ShellStress> one = std::move(recoveries_.back());
      recoveries_.pop_back();
      return one;
    }
  }
  return std::make_unique<ShellStress>(space_, points_of_cell(space_.degree()));
}

void StressPoints::give_back(std::unique_ptr<ShellStress> one) const {
  const std::lock_guard lock(lending_);
  recoveries_.push_back(std::move(one));
}

Eigen::MatrixXd StressPoints::stresses(int first, int count,
                                       const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                       const CellHeat* heat) const {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6 * count, motions.cols());
  const int shells = std::clamp(shell_points_ - first, 0, count);
  if (shells > 0) shell_stresses(first, shells, motions, heat, rows.topRows(6 * shells));
  Eigen::MatrixXd of_end;
  int known_solid = -1;
  for (int i = shells; i < count; ++i) {
    if (is_of_solid(first + i)) {
      const SolidPointOf& of_solid = solid_point(first + i);
      if (of_solid.solid != known_solid)
        of_end = solid_corner_stresses(space_, of_solid.solid, motions, heat);
      known_solid = of_solid.solid;
      rows.middleRows<6>(6 * i) = of_end.middleRows<6>(6 * of_solid.corner);
      continue;
    }
    const BeamPointOf& point = beam_points_[first + i - shell_points_];
    if (i == shells || point.at == 0)
      of_end = beam_stresses(space_, point.cell, point.xi, motions, heat);
    rows.middleRows<6>(6 * i) = of_end.middleRows<6>(6 * point.at);
  }
  return rows;
}

void StressPoints::shell_stresses(int first, int count,
                                  const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                  const CellHeat* heat, Eigen::Ref<Eigen::MatrixXd> rows) const {
  std::unique_ptr<ShellStress> recovery = borrow();
  int known_cell = -1;
  Eigen::MatrixXd of_cell;
  for (int i = 0; i < count; ++i) {
    const int point = first + i, cell = point / points_per_cell();
    if (cell != known_cell) of_cell = recovery->of_all(cell, motions, heat);
    known_cell = cell;
    const auto here =
        of_cell.middleRows<shell_stress_rows>(shell_stress_rows * (point % points_per_cell() / 2));
    rows.middleRows<6>(6 * i) = stresses_at_side(here, point % 2 == 0 ? 1 : -1);
  }
  give_back(std::move(recovery));
}

}  // namespace blocklift::structure
