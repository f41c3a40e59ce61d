#include "pipeline/mechanism/joint_values.h"

#include <cmath>

#include <fmt/format.h>

#include "dynamics/spatial/pose.h"
#include "pipeline/declaration/geometry_format.h"
#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::pipeline {
namespace {

using dynamics::JointKind;

std::vector<Dimension> dimensions_of(const std::vector<bool>& turns, Dimension linear,
                                     Dimension angular) {
  std::vector<Dimension> dimensions;
  for (const bool turn : turns) dimensions.push_back(turn ? angular : linear);
  return dimensions;
}

/// Do the values from `first` on have these dimensions? Values that could not be read have any.
bool fit(const std::vector<Quantity>& values, std::size_t first,
         const std::vector<Dimension>& dimensions) {
  if (values.size() < first + dimensions.size()) return false;
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    const Quantity& value = values[first + i];
    if (std::isfinite(value.value) && value.dimension != dimensions[i]) return false;
  }
  return true;
}

Eigen::VectorXd numbers_of(const std::vector<Quantity>& values) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    numbers[i] = values[i].value;
  }
  return numbers;
}

/// Quaternion of the values from `first` on: three angles, or the quaternion itself. False and a
/// complaint if they are neither.
bool set_quaternion(const std::vector<Quantity>& values, std::size_t first, JointVector& result) {
  const Eigen::VectorXd numbers = numbers_of(values);
  const auto from = static_cast<Eigen::Index>(first);
  if (values.size() == first + 3 && fit(values, first, std::vector(3, Dimension::angle))) {
    result.values.segment<4>(from) =
        dynamics::quaternion_from_rotation(rotation_of(numbers.segment<3>(from)));
    return true;
  }
  if (values.size() == first + 4 && fit(values, first, std::vector(4, Dimension::ratio))) {
    const Eigen::Vector4d quaternion = numbers.segment<4>(from);
    if (quaternion.norm() == 0) {
      result.complaint = "has a quaternion of zeros";
      return false;
    }
    result.values.segment<4>(from) = quaternion.normalized();
    return true;
  }
  return false;
}

JointVector wrong(std::string due) { return {{}, "takes " + std::move(due)}; }

std::string list_due(JointKind kind, const std::vector<Dimension>& dimensions) {
  if (dimensions.empty()) return "no value: it is " + std::string(dynamics::joint_kind_name(kind));
  std::string due = dimensions.size() == 1 ? "" : fmt::format("{} values: ", dimensions.size());
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    due += (i > 0 ? ", " : "") + text_of(dimensions[i]).noun;
  }
  return due + fmt::format(" (it is {})", dynamics::joint_kind_name(kind));
}

JointVector plain(JointKind kind, const std::vector<Quantity>& values,
                  const std::vector<Dimension>& dimensions) {
  if (values.size() != dimensions.size() || !fit(values, 0, dimensions)) {
    return wrong(list_due(kind, dimensions));
  }
  return {numbers_of(values), ""};
}

}  // namespace

JointVector joint_position(JointKind kind, const std::vector<Quantity>& values) {
  JointVector result{dynamics::zero_coordinates(kind), ""};
  if (kind == JointKind::spherical) {
    if (set_quaternion(values, 0, result) || !result.complaint.empty()) return result;
    return wrong("three angles (roll, pitch, yaw) or four plain numbers (a quaternion w, x, y, z)");
  }
  if (kind == JointKind::free) {
    if (fit(values, 0, std::vector(3, Dimension::length))) {
      result.values.head<3>() = numbers_of(values).head<3>();
      if (set_quaternion(values, 3, result) || !result.complaint.empty()) return result;
    }
    return wrong(
        "three lengths, then three angles (roll, pitch, yaw) or four plain numbers (a quaternion "
        "w, "
        "x, y, z)");
  }
  return plain(kind, values, dimensions_of(joint_turns(kind), Dimension::length, Dimension::angle));
}

JointVector joint_velocity(JointKind kind, const std::vector<Quantity>& values) {
  if (kind == JointKind::free) {
    std::vector<Dimension> due(3, Dimension::speed);
    due.insert(due.end(), 3, Dimension::angular_speed);
    JointVector result = plain(kind, values, due);
    if (result.complaint.empty()) {
      const Eigen::VectorXd given = result.values;
      result.values << given.tail<3>(), given.head<3>();
    }
    return result;
  }
  return plain(kind, values,
               dimensions_of(joint_turns(kind), Dimension::speed, Dimension::angular_speed));
}

}  // namespace blocklift::pipeline
