#pragma once

#include <cmath>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

/// A number for a summary; null where it is not finite, which JSON cannot write.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// A point or vector for a summary, [x, y, z].
inline nlohmann::ordered_json json_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace blocklift::pipeline
