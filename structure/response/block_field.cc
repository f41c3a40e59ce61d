#include "structure/response/block_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/response/shell_stress.h"

namespace blocklift::structure {

namespace {

constexpr double slack = 1e-6;               // of the unit coordinates
constexpr double slack_of_thickness = 1e-3;  // places are stated to tenths of a millimetre

std::vector<int> all_shells(const Mesh& mesh) {
  std::vector<int> shells(mesh.shells.size());
  std::iota(shells.begin(), shells.end(), 0);
  return shells;
}

/// The point of a shell's vertices' surface below a place, and the place's height above it.
struct Foot {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  Vector3 normal = Vector3::Zero();
  double height = 0;
};

std::optional<Foot> find_foot(const Mesh& mesh, const Shell& shell, const Vector3& place) {
  Foot foot;
  // Within a triangle's edge that is a point the tangent along it is none.
  foot.xi.setConstant(0.4);
  const double step = 1e-4;
  Vector3 miss = Vector3::Zero();
  Eigen::Matrix<double, 3, 2> tangents;
  constexpr int most = 30;
  for (int i = 0; i < most; ++i) {
    for (int a = 0; a < 2; ++a) {
      const Eigen::Vector2d along = step * Eigen::Vector2d::Unit(a);
      tangents.col(a) =
          (position(mesh, shell, foot.xi + along) - position(mesh, shell, foot.xi - along)) /
          (2 * step);
    }
    miss = place - position(mesh, shell, foot.xi);
    const Eigen::Vector2d change =
        (tangents.transpose() * tangents).ldlt().solve(tangents.transpose() * miss);
    if (!change.allFinite()) break;
    foot.xi = (foot.xi + change).cwiseMax(-1.0).cwiseMin(2.0);
    if (change.cwiseAbs().maxCoeff() < 1e-12) break;
  }
  if (foot.xi.minCoeff() < -slack || foot.xi.maxCoeff() > 1 + slack) return {};
  foot.xi = foot.xi.cwiseMax(0.0).cwiseMin(1.0);
  const Eigen::Vector2d inward = foot.xi + 1e-3 * (Eigen::Vector2d(0.5, 0.5) - foot.xi);
  for (int a = 0; a < 2; ++a) {
    const Eigen::Vector2d along = step * Eigen::Vector2d::Unit(a);
    tangents.col(a) = position(mesh, shell, inward + along) - position(mesh, shell, inward - along);
  }
  foot.normal = Vector3(tangents.col(0)).cross(Vector3(tangents.col(1))).normalized();
  miss = place - position(mesh, shell, foot.xi);
  foot.height = miss.dot(foot.normal);
  const double beside = (miss - foot.height * foot.normal).norm();
  if (beside > 1e-5 * longest_edge(mesh, shell)) return {};
  return foot;
}

}  // namespace

SteelFinder::SteelFinder(const Space& space)
    : space_(space), tree_(space.mesh(), all_shells(space.mesh())), cells_(space) {
  for (const ShellSection& section : space.mesh().shell_sections)
    reach_ = std::max(reach_, 0.51 * section.thickness + std::abs(section.offset));
}

SteelPlace SteelFinder::find(const Vector3& place, const Vector3& normal) const {
  const Mesh& mesh = space_.mesh();
  SteelPlace best;
  double least = std::numeric_limits<double>::infinity();
  tree_.for_each_near(place, 2 * reach_, [&](int number) {
    const Shell& shell = mesh.shells[at(number)];
    const ShellSection& section = mesh.section_of(shell);
    const auto foot = find_foot(mesh, shell, place);
    if (!foot) return;
    const double height = foot->height - section.offset,
                 share = std::abs(height) / (section.thickness / 2);
    if (share > 1 + 2 * slack_of_thickness) return;
    // The share breaks ties between shells of plates that look the same way.
    const double rank =
        normal.isZero(0) ? share : 1 - std::abs(normal.dot(foot->normal)) + 1e-6 * share;
    if (rank >= least) return;
    const CellPlace cell = cells_.find({number, foot->xi});
    if (cell.cell < 0) return;
    least = rank;
    static_cast<CellPlace&>(best) = cell;
    best.height = std::clamp(height, -section.thickness / 2, section.thickness / 2);
  });
  return best;
}

SteelPlace find_cell(const Space& space, const Vector3& place) {
  return SteelFinder(space).find(place);
}

Eigen::MatrixXd displacements_at(const ElasticModel& model,
                                 const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                 const Eigen::Matrix3Xd& places, const Vector3& normal) {
  const Space& space = model.space();
  const SteelFinder finder(space);
  Eigen::MatrixXd result(3 * places.cols(), motions.cols());
  for (Eigen::Index p = 0; p < places.cols(); ++p) {
    const SteelPlace place = finder.find(places.col(p), normal);
    if (place.cell < 0)
      throw ModelError(
          fmt::format("there is no material of the block at ({:.6g}, {:.6g}, {:.6g}) m",
                      places(0, p), places(1, p), places(2, p)));
    const Eigen::VectorXd values = space.shell_values(place.xi);
    const int* nodes = space.shell_nodes(place.cell);
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(6, motions.cols());
    for (int i = 0; i < space.nodes_per_shell(); ++i)
      moved += values[i] * motions.middleRows<6>(6 * static_cast<Eigen::Index>(nodes[i]));
    const Vector3 arm = places.col(p) - space.place(place.cell, place.xi);
    for (Eigen::Index k = 0; k < motions.cols(); ++k)
      result.block<3, 1>(3 * p, k) =
          moved.col(k).head<3>() + Vector3(moved.col(k).tail<3>()).cross(arm);
  }
  return result;
}

Eigen::MatrixXd stresses_at(const ElasticModel& model,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions,
                            const SteelPlace& place) {
  const Mesh& mesh = model.mesh();
  const Space& space = model.space();
  ShellStress stress(space, place.xi);
  const Eigen::MatrixXd rows = stress.of_all(place.cell, motions);
  const ShellPoint& point = stress.points().front();
  const double share =
      2 * place.height /
      mesh.section_of(mesh.shells[at(space.shells()[at(place.cell)].shell)]).thickness;
  Eigen::Matrix3d axes;
  axes << point.e_1, point.e_2, point.normal;
  Eigen::MatrixXd result(6, motions.cols());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const Eigen::Vector3d in_plane = rows.col(k).segment<3>(membrane_stress_11) +
                                     share * rows.col(k).segment<3>(bending_stress_11);
    const Eigen::Vector2d across =
        1.5 * (1 - share * share) * rows.col(k).segment<2>(shear_stress_13);
    Eigen::Matrix3d local;
    local << in_plane[0], in_plane[2], across[0],  //
        in_plane[2], in_plane[1], across[1],       //
        across[0], across[1], 0;
    const Eigen::Matrix3d s = axes * local * axes.transpose();
    result.col(k) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0);
  }
  return result;
}

}  // namespace blocklift::structure
