#include "structure/part/padeye_stress.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Dense>

#include "structure/part/part_solution.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

constexpr double patch_side = 0.05;  // m, of the checked stress

Eigen::Vector2d centre_of(const PadeyeMesh::Column& column) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : column.corners) sum += corner;
  return sum / 4;
}

/// In-plane stress (xx, yy, xy) integrated over some material, and its volume.
struct Mean {
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();  ///< Pa m^3
  double volume = 0;                                   ///< m^3

  double von_mises() const {
    const Eigen::Vector3d s = integral / volume;
    return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]);
  }
};

Mean mean_of(const SolidSet& set, const std::vector<int>& solids,
             const Eigen::VectorXd& displacement) {
  Mean mean;
  for (const int solid : solids) {
    const ElementKind& kind = set.kind(solid);
    const StressColumns stress = stresses_of(set, solid, kind.gradients, displacement);
    const Eigen::Matrix3Xd places = set.places(solid);
    for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
      const double volume =
          kind.weights[q] *
          (places * kind.gradients.middleRows<3>(3 * q).transpose()).determinant();
      mean.volume += volume;
      mean.integral += volume * Eigen::Vector3d(stress(0, q), stress(1, q), stress(3, q));
    }
  }
  return mean;
}

void take(Extreme& extreme, double value, const Vector3& point, const char* part) {
  if (value <= extreme.value) return;
  extreme = {value, point, part};
}

}  // namespace

std::vector<std::vector<int>> solids_of_columns(const PartMesh& mesh,
                                                const std::vector<PadeyeMesh::Column>& columns) {
  std::map<std::size_t, int> solid_of_tag;
  for (std::size_t s = 0; s < mesh.solids.size(); ++s)
    solid_of_tag[mesh.elements[mesh.solids[s]].tag] = static_cast<int>(s);
  std::vector<std::vector<int>> solids;
  for (const PadeyeMesh::Column& column : columns) {
    solids.emplace_back();
    for (const std::size_t tag : column.elements) solids.back().push_back(solid_of_tag.at(tag));
  }
  return solids;
}

PadeyeStress find_padeye_stress(const PadeyeGeometry& padeye,
                                const std::vector<PadeyeMesh::Column>& columns,
                                const std::vector<std::vector<int>>& solids_of_column,
                                const PartModel& part, const Eigen::VectorXd& displacement) {
  const SolidSet set = solids_of(part);
  PadeyeStress result;
  const int count = static_cast<int>(columns.size());
  std::vector<Mean> means;
  result.column_von_mises.resize(count);
  for (int c = 0; c < count; ++c) {
    means.push_back(mean_of(set, solids_of_column[c], displacement));
    result.column_von_mises[c] = means.back().von_mises();
  }
  const double reach = std::min(patch_side / std::sqrt(std::numbers::pi), padeye.hole_diameter / 4);
  for (int c = 0; c < count; ++c) {
    if (centre_of(columns[c]).y() <= -padeye.height + padeye.thickness) continue;
    const bool is_main = columns[c].plate == PadeyePlate::main;
    PadeyePlateStress& plate = is_main ? result.main_plate : result.cheeks;
    const char* name = is_main ? "main plate" : "cheek plate";
    const Eigen::Vector2d centre = centre_of(columns[c]);
    Mean patch;
    for (int other = 0; other < count; ++other) {
      if (columns[other].plate != columns[c].plate ||
          (centre_of(columns[other]) - centre).norm() > reach)
        continue;
      patch.integral += means[other].integral;
      patch.volume += means[other].volume;
    }
    const auto side = static_cast<double>(columns[c].plate == PadeyePlate::cheek_front) -
                      static_cast<double>(columns[c].plate == PadeyePlate::cheek_back);
    const double level = side * (padeye.thickness + padeye.cheek_thickness) / 2;
    take(plate.checked_von_mises, patch.von_mises(), {centre.x(), centre.y(), level}, name);
    for (const int solid : solids_of_column[c]) {
      const StressColumns stress =
          stresses_of(set, solid, set.kind(solid).gradients_at_nodes, displacement);
      for (int i = 0; i < stress.cols(); ++i)
        take(plate.peak_von_mises, von_mises(stress.col(i)), set.nodes.col(set.node(solid, i)),
             name);
    }
  }
  return result;
}

}  // namespace blocklift::structure
