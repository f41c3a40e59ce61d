#include "pipeline/build/body_box.h"

#include <algorithm>
#include <limits>

namespace blocklift::pipeline {

BoxShape box_around(const BlockModel& block) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;
  const auto include = [&](const std::vector<Vector3>& points) {
    for (const Vector3& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  };
  if (block.mesh) include(block.mesh->deck->mesh.vertices);
  for (const PlateModel& plate : block.plates) {
    if (plate.corners) include(plate.corners->value);
    if (plate.edges)
      for (const EdgeModel& edge : plate.edges->value) include(edge.points);
    if (plate.is_free()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const auto widen = [&](double value) {
        low[i] = std::min(low[i], value);
        high[i] = std::max(high[i], value);
      };
      if (axis == plate.normal) {
        for (const double at : plate.at) widen(at);
      } else if (plate.extent[axis]) {
        for (const double end : plate.extent[axis]->value) widen(end);
      }
    }
  }
  return {high - low, 0.5 * (low + high), Vector3::Zero()};
}

BoxShape box_around(const Vessel& vessel) {
  const auto [low, high] = vessel.hull.bounds();
  return {high - low, 0.5 * (low + high), Vector3::Zero()};
}

BoxShape box_around(const given::Load& load) {
  return load.vessel ? box_around(*load.vessel) : box_around(*load.model);
}

}  // namespace blocklift::pipeline
