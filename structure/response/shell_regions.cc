#include "structure/response/shell_regions.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

struct Box {
  Vector3 low, high;
};

std::vector<Box> boxes_of(const HexMesh& mesh) {
  std::vector<Box> boxes(mesh.cells.size());
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    Box& box = boxes[cell];
    box.low.setConstant(std::numeric_limits<double>::infinity());
    box.high = -box.low;
    for (const int vertex : mesh.cells[cell]) {
      const Vector3& place = mesh.vertices[static_cast<std::size_t>(vertex)];
      box.low = box.low.cwiseMin(place);
      box.high = box.high.cwiseMax(place);
    }
  }
  return boxes;
}

// Does anything stand before a box, seen along an axis from its side?
bool is_covered(const std::vector<Box>& boxes, const Box& box, int axis, int side) {
  const Vector3 middle = 0.5 * (box.low + box.high);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  for (const Box& other : boxes) {
    if (middle[i] < other.low[i] || middle[i] > other.high[i] || middle[j] < other.low[j] ||
        middle[j] > other.high[j])
      continue;
    if (side > 0 ? other.low[axis] > middle[axis] : other.high[axis] < middle[axis]) return true;
  }
  return false;
}

}  // namespace

ShellRegions::ShellRegions(const ElasticModel& model, double size) : model_(model) {
  if (!(size > 0)) throw ModelError("regions of a shell have a positive size");
  divide(size);
  if (regions_.empty()) throw ModelError("no plate of the block looks outwards");
  const HexMesh& mesh = model_.mesh();
  for (ShellRegion& region : regions_) {
    const NodalMoments moments =
        nodal_moments(mesh, model_.space(), region.cells, [](int, const Vector3&) { return 1.0; });
    const Eigen::RowVector4d sum = moments.colwise().sum();
    region.centre_B = sum.tail<3>().transpose() / sum[0];
  }
}

void ShellRegions::divide(double size) {
  const BlockMesh& mesh = model_.mesh();
  const std::vector<Box> boxes = boxes_of(mesh);
  std::vector<char> is_lug(mesh.groups.size(), 0);
  for (const LugRegion& lug : mesh.lugs) is_lug[static_cast<std::size_t>(lug.group)] = 1;
  std::map<std::array<int, 4>, int> found;  // sheet, side, place along two edges
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    const int axis = mesh.cell_normal[cell];
    if (axis < 0 || is_lug[static_cast<std::size_t>(mesh.cell_group[cell])] != 0) continue;
    const Box& box = boxes[cell];
    for (const int side : {-1, 1}) {
      if (is_covered(boxes, box, axis, side)) continue;
      const auto band = [&](int along) {
        return static_cast<int>(std::floor(0.5 * (box.low[along] + box.high[along]) / size));
      };
      const auto [place, is_new] = found.try_emplace(
          {mesh.cell_sheet[cell], side, band((axis + 1) % 3), band((axis + 2) % 3)},
          static_cast<int>(regions_.size()));
      if (is_new) regions_.emplace_back().outward_B = side * Vector3::Unit(axis);
      regions_[static_cast<std::size_t>(place->second)].cells.push_back(static_cast<int>(cell));
      faces_.push_back({box.low, box.high, place->second});
    }
  }
}

int ShellRegions::nearest(const Vector3& place_B, const Vector3& outward_B) const {
  constexpr double least_cosine = 0.342;  // 70 degrees
  int best = 0;
  bool is_facing = false;
  double least = std::numeric_limits<double>::infinity();
  for (const Face& face : faces_) {
    const bool faces =
        regions_[static_cast<std::size_t>(face.region)].outward_B.dot(outward_B) > least_cosine;
    if (is_facing && !faces) continue;
    const double distance =
        (place_B - place_B.cwiseMax(face.low).cwiseMin(face.high)).squaredNorm();
    if (faces == is_facing && !(distance < least)) continue;
    is_facing = faces;
    least = distance;
    best = face.region;
  }
  return best;
}

Eigen::MatrixXd ShellRegions::loads(const Eigen::MatrixXd& wrenches) const {
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(model_.unknowns(), wrenches.cols());
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const auto rows = wrenches.middleRows<6>(static_cast<Eigen::Index>(6 * r));
    if (rows.isZero(0)) continue;
    const NodalMoments moments = nodal_moments(model_.mesh(), model_.space(), regions_[r].cells,
                                               [](int, const Vector3&) { return 1.0; });
    add_spread_wrenches(moments, model_.space().nodes, regions_[r].centre_B, rows, loads);
  }
  return loads;
}

}  // namespace blocklift::structure
