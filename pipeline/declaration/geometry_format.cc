#include "pipeline/declaration/geometry_format.h"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

Format<Vector3> vector_of(Format<double> element) {
  return converted<std::array<double, 3>, Vector3>(
      array_of<double, 3>(std::move(element)),
      [](std::array<double, 3> v) { return Vector3(v[0], v[1], v[2]); });
}

}  // namespace

Format<Vector3> position_format() { return vector_of(quantity(Dimension::length)); }

Format<Vector3> size_format() { return vector_of(quantity(Dimension::length, Range::positive())); }

Format<Vector3> attitude_format() { return vector_of(quantity(Dimension::angle)); }

Format<Vector3> direction_format() {
  const Format<Vector3> numbers = vector_of(number());
  return {numbers.description, [numbers](const YAML::Node& node, Reading& reading, Vector3& value) {
            if (!numbers.read(node, reading, value)) return false;
            const double length = value.stableNorm();
            if (length == 0 || !std::isfinite(length)) {
              reading.error(node, fmt::format("{} has no direction; at least one of its three "
                                              "numbers must not be 0",
                                              reading.key()));
              return false;
            }
            value /= length;
            return true;
          }};
}

Eigen::Matrix3d rotation_of(const Vector3& roll_pitch_yaw) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(roll_pitch_yaw.z(), Vector3::UnitZ()) *
          AngleAxisd(roll_pitch_yaw.y(), Vector3::UnitY()) *
          AngleAxisd(roll_pitch_yaw.x(), Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 roll_pitch_yaw_of(const Eigen::Matrix3d& R_AB) {
  // R = Rz(yaw) Ry(pitch) Rx(roll), so that Rz(-yaw) R = Ry(pitch) Rx(roll): whatever yaw is found
  // of the first column, which vanishes at a right angle, the others follow for that very yaw.
  const double yaw = std::atan2(R_AB(1, 0), R_AB(0, 0));
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {std::atan2(s * R_AB(0, 2) - c * R_AB(1, 2), c * R_AB(1, 1) - s * R_AB(0, 1)),
          std::atan2(-R_AB(2, 0), c * R_AB(0, 0) + s * R_AB(1, 0)), yaw};
}

}  // namespace blocklift::pipeline
