#include "structure/mesh/fields/plate_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/Dense>

#include "algebra/decompositions.h"

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
struct PlateFoot {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  Vector3 normal = Vector3::Zero();
  double height = 0;
};

std::optional<PlateFoot> find_plate_foot(const Mesh& mesh, const Shell& shell,
                                         const Vector3& place) {
  PlateFoot foot;
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
        algebra::solve_symmetric<2>(tangents.transpose() * tangents, tangents.transpose() * miss);
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

PlateFinder::PlateFinder(const Mesh& mesh) : mesh_(mesh), tree_(mesh, all_shells(mesh)) {
  double farthest_offset = 0;
  for (const ShellSection& section : mesh.shell_sections) {
    reach_ = std::max(reach_, 0.51 * section.thickness + std::abs(section.offset));
    farthest_offset = std::max(farthest_offset, std::abs(section.offset));
  }
  for (const std::array<double, 4>& corners : mesh.shell_tapers)
    reach_ = std::max(reach_,
                      0.51 * *std::max_element(corners.begin(), corners.end()) + farthest_offset);
}

std::optional<PlatePlace> PlateFinder::find(const Vector3& place, const Vector3& normal) const {
  std::optional<PlatePlace> best;
  double least = std::numeric_limits<double>::infinity();
  tree_.for_each_near(place, 2 * reach_, [&](int number) {
    const Shell& shell = mesh_.shells[number];
    const ShellSection& section = mesh_.section_of(shell);
    const auto foot = find_plate_foot(mesh_, shell, place);
    if (!foot) return;
    const double height = foot->height - section.offset,
                 half = thickness_at(mesh_, shell, foot->xi) / 2, share = std::abs(height) / half;
    if (share > 1 + 2 * slack_of_thickness) return;
    // The share breaks ties between shells of plates that look the same way.
    const double rank =
        normal.isZero(0) ? share : 1 - std::abs(normal.dot(foot->normal)) + 1e-6 * share;
    if (rank >= least) return;
    least = rank;
    best.emplace();
    best->shell = number;
    best->xi = foot->xi;
    best->normal = foot->normal;
    best->height = std::clamp(height, -half, half);
  });
  return best;
}

}  // namespace blocklift::structure
