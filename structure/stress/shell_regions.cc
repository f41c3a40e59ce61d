#include "structure/stress/shell_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "parallel/threads.h"
#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/fields/shell_tree.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

namespace {

const Eigen::Vector2d middle(0.5, 0.5);

/// Normal of a cell in its middle, times its area as a parallelogram there.
Vector3 area_vector(const Space& space, int cell) {
  const Vector3 g_1 = space.place(cell, {0.75, 0.5}) - space.place(cell, {0.25, 0.5}),
                g_2 = space.place(cell, {0.5, 0.75}) - space.place(cell, {0.5, 0.25});
  return 4 * g_1.cross(g_2);
}

/// The axis that a normal is nearest to; of two alike the first.
int main_axis(const Vector3& normal) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(normal[axis]) > normal.cwiseAbs().maxCoeff() - 1e-6) return axis;
  return 2;
}

bool is_lug(const Mesh& mesh, int shell) { return mesh.regions[mesh.shells[shell].region].is_lug; }

std::vector<int> shells_without_lugs(const Mesh& mesh) {
  std::vector<int> shells;
  for (int shell = 0; shell < static_cast<int>(mesh.shells.size()); ++shell)
    if (!is_lug(mesh, shell)) shells.push_back(shell);
  return shells;
}

/// For each cell whether it looks outwards against its normal, and along it.
std::vector<std::array<bool, 2>> outward_sides(const Space& space) {
  const Mesh& mesh = space.mesh();
  const ShellTree tree(mesh, shells_without_lugs(mesh));
  const int cells = static_cast<int>(space.shells().size());
  std::vector<std::array<bool, 2>> sides(at(cells), {false, false});
  parallel::in_batches(cells, 64, 0, [&](int first, int count) {
    for (int cell = first; cell < first + count; ++cell) {
      if (is_lug(mesh, space.shells()[cell].shell)) continue;
      const Vector3 area = area_vector(space, cell), place = space.place(cell, middle);
      // The tree's triangles of a curved shell lie a little off the place that a ray starts from.
      const double own_shell = 5e-3 * std::sqrt(area.norm()) / space.shells()[cell].size;
      for (const int side : {-1, 1})
        sides[at(cell)][side < 0 ? 0 : 1] =
            !tree.is_hit(place, side * area.normalized(), own_shell);
    }
  });
  return sides;
}

}  // namespace

ShellRegions::ShellRegions(const ElasticModel& model, double size) : model_(model) {
  if (!(size > 0)) throw ModelError("regions of a shell have a positive size");
  divide(size);
  if (regions_.empty()) throw ModelError("no plate of the block looks outwards");
  find_centres();
}

void ShellRegions::divide(double size) {
  const Mesh& mesh = model_.mesh();
  const Space& space = model_.space();
  const std::vector<std::array<bool, 2>> looks_out = outward_sides(space);
  std::map<std::array<int, 5>, int> found;  // plate, side, axis, place along two others
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
    const int shell = space.shells()[cell].shell;
    const Vector3 area = area_vector(space, cell), place = space.place(cell, middle);
    for (const int side : {-1, 1}) {
      if (!looks_out[at(cell)][side < 0 ? 0 : 1]) continue;
      const Vector3 outward = side * area.normalized();
      const int axis = main_axis(outward);
      const auto band = [&](int along) {
        return static_cast<int>(std::floor(place[along] / size));
      };
      const auto [entry, is_new] =
          found.try_emplace({mesh.shells[shell].region, outward[axis] < 0 ? -1 : 1, axis,
                             band((axis + 1) % 3), band((axis + 2) % 3)},
                            static_cast<int>(regions_.size()));
      if (is_new) regions_.emplace_back();
      ShellRegion& region = regions_[entry->second];
      region.cells.push_back(cell);
      region.outward_B += side * area;
      Face face;
      face.outward_B = outward;
      face.region = entry->second;
      const Vector3 a = space.place(cell, {0, 0}), b = space.place(cell, {1, 0}),
                    c = space.place(cell, {0, 1}), d = space.place(cell, {1, 1});
      face.corners = {a, b - a, c - a, d, c - d, b - d};
      for (const Vector3& corner : {a, b, c, d}) face.box.extend(corner);
      faces_.push_back(std::move(face));
    }
  }
  for (ShellRegion& region : regions_) region.outward_B.normalize();
}

void ShellRegions::find_centres() {
  for (ShellRegion& region : regions_) {
    double volume = 0;
    for_each_shell_point(model_.space(), region.cells, [&](const MatterPoint& point) {
      region.centre_B += point.volume * point.place;
      volume += point.volume;
    });
    region.centre_B /= volume;
  }
}

int ShellRegions::nearest(const Vector3& place_B, const Vector3& outward_B) const {
  constexpr double least_cosine = 0.342;  // 70 degrees
  int best = 0;
  bool is_facing = false;
  double least = std::numeric_limits<double>::infinity();
  for (const Face& face : faces_) {
    const bool faces = face.outward_B.dot(outward_B) > least_cosine;
    if (is_facing && !faces) continue;
    if (faces == is_facing && face.box.squaredExteriorDistance(place_B) >= least) continue;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < face.corners.size(); i += 3)
      distance = std::min(distance, squared_distance(place_B, face.corners[i], face.corners[i + 1],
                                                     face.corners[i + 2]));
    if (faces == is_facing && !(distance < least)) continue;
    is_facing = faces;
    least = distance;
    best = face.region;
  }
  return best;
}

Eigen::MatrixXd ShellRegions::loads(const Eigen::MatrixXd& wrenches) const {
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(model_.freedoms(), wrenches.cols());
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const auto rows = wrenches.middleRows<6>(6 * r);
    if (rows.isZero(0)) continue;
    add_spread_wrenches(model_.space(), regions_[r].cells, regions_[r].centre_B, rows, loads);
  }
  return loads;
}

}  // namespace blocklift::structure
