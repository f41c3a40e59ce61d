#include "structure/response/line_loads.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

namespace {

constexpr int parts_of_stretch = 16;  // of a stretch

std::vector<int> all_shells(const Mesh& mesh) {
  std::vector<int> shells(mesh.shells.size());
  std::iota(shells.begin(), shells.end(), 0);
  return shells;
}

Eigen::Matrix<double, 3, 2> tangents_of(const Mesh& mesh, const Shell& shell,
                                        const Eigen::Vector2d& xi) {
  constexpr double step = 1e-4;
  Eigen::Matrix<double, 3, 2> tangents;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d along = step * Eigen::Vector2d::Unit(axis);
    tangents.col(axis) =
        (position(mesh, shell, xi + along) - position(mesh, shell, xi - along)) / (2 * step);
  }
  return tangents;
}

// The point of a shell nearest to a place: Gauss and Newton's method within the unit square, along
// those of its sides against which the place presses.
Eigen::Vector2d nearest_of(const Mesh& mesh, const Shell& shell, const Vector3& place) {
  constexpr int most_steps = 40;
  Eigen::Vector2d xi(0.4, 0.4);
  for (int k = 0; k < most_steps; ++k) {
    const Eigen::Matrix<double, 3, 2> tangents = tangents_of(mesh, shell, xi);
    const Eigen::Vector2d pull = tangents.transpose() * (place - position(mesh, shell, xi));
    Eigen::Matrix2d metric = tangents.transpose() * tangents;
    Eigen::Vector2d free_pull = pull;
    for (int axis = 0; axis < 2; ++axis) {
      const bool held = (xi[axis] <= 0 && pull[axis] <= 0) || (xi[axis] >= 1 && pull[axis] >= 0);
      if (!held) continue;
      metric.row(axis).setZero();
      metric.col(axis).setZero();
      metric(axis, axis) = 1;
      free_pull[axis] = 0;
    }
    const Eigen::Vector2d step = algebra::solve_symmetric(metric, free_pull);
    if (!step.allFinite()) break;
    const Eigen::Vector2d next = (xi + step).cwiseMax(0.0).cwiseMin(1.0);
    const double moved = (next - xi).cwiseAbs().maxCoeff();
    xi = next;
    if (moved < 1e-12) break;
  }
  return xi;
}

}  // namespace

LineLoads::LineLoads(const Space& space)
    : space_(space), tree_(space.mesh(), all_shells(space.mesh())), cells_(space) {}

std::optional<LineLoads::Nearest> LineLoads::find_nearest(const Vector3& place,
                                                          double farthest) const {
  const Mesh& mesh = space_.mesh();
  std::optional<Nearest> nearest;
  // What is found within a distance is the nearest; else the distance grows.
  constexpr double first = 0.02;  // m
  for (double distance = std::min(first, farthest);; distance = std::min(4 * distance, farthest)) {
    tree_.for_each_near(place, distance, [&](int number) {
      const Shell& shell = mesh.shells[number];
      const Eigen::Vector2d xi = nearest_of(mesh, shell, place);
      const double apart = (place - position(mesh, shell, xi)).norm();
      if (apart <= distance && (!nearest || apart < nearest->distance))
        nearest = {{number, xi}, apart};
    });
    if (nearest || distance >= farthest) return nearest;
  }
}

std::optional<double> LineLoads::find_distance(const Vector3& place, double farthest) const {
  const std::optional<Nearest> nearest = find_nearest(place, farthest);
  if (!nearest) return std::nullopt;
  return nearest->distance;
}

Eigen::MatrixXd LineLoads::unit_forces(const LineStretch& stretch) const {
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(space_.freedoms(), 3);
  // Middles of equal parts: their weights, even about the middle, add up to one.
  double sum = 0;
  for (int part = 0; part < parts_of_stretch; ++part)
    sum += 1 - std::abs((2 * part + 1.0) / parts_of_stretch - 1);
  for (int part = 0; part < parts_of_stretch; ++part) {
    const double share = (2 * part + 1.0) / parts_of_stretch - 1;
    const Vector3 on_line = stretch.middle_B + share * stretch.half_length * stretch.along_B;
    const Vector3 wanted = on_line + stretch.to_plates_B;
    const std::optional<Nearest> nearest = find_nearest(wanted, farthest_plate);
    const CellPlace place = nearest ? cells_.find(nearest->place) : CellPlace{};
    if (place.cell < 0)
      throw ModelError(
          fmt::format("no plate of the block lies within {:g} m of the edge at ({:.4g}, {:.4g}, "
                      "{:.4g}) m",
                      farthest_plate, wanted.x(), wanted.y(), wanted.z()));
    const Eigen::VectorXd values = space_.shell_values(place.xi);
    MatterPoint point;
    point.nodes = space_.shell_nodes(place.cell);
    point.values = values.data();
    point.node_count = space_.nodes_per_shell();
    point.arm = on_line;
    for (int i = 0; i < point.node_count; ++i)
      point.arm -= values[i] * space_.nodes().col(point.nodes[i]);
    add_forces(point, Eigen::Matrix3d((1 - std::abs(share)) / sum * Eigen::Matrix3d::Identity()),
               loads);
  }
  return loads;
}

}  // namespace blocklift::structure
