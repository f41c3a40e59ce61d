#include "structure/mesh/files/abaqus/orientation.h"

#include <numbers>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

Vector3 vector_at(const Fields& fields, std::size_t first) {
  return {abaqus_real(fields, first, "coordinate"), abaqus_real(fields, first + 1, "coordinate"),
          abaqus_real(fields, first + 2, "coordinate")};
}

Eigen::Matrix3d axes_from(const Vector3& axis_1, const Vector3& axis_3, const std::string& name) {
  if (!(axis_1.norm() > 0 && axis_3.norm() > 1e-9))
    throw CardError{fmt::format("the points of orientation {} lie on a line", name)};
  Eigen::Matrix3d axes;
  axes.col(0) = axis_1.normalized();
  axes.col(2) = axis_3.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

const AbaqusBlock& orientation_of(const AbaqusScope& scope, const std::string& name) {
  for (const AbaqusBlock* block : scope.blocks)
    if (block->name == "ORIENTATION" && block->value("NAME") == name) return *block;
  throw CardError{fmt::format("orientation {} does not exist", name)};
}

}  // namespace

AbaqusAxes::AbaqusAxes(const AbaqusScope& scope, const std::string& name)
    : scope_(&scope), name_(name) {
  if (!name_.empty()) read(orientation_of(scope, name_));
}

Eigen::Matrix3d AbaqusAxes::at(const Vector3& place) const {
  if (!is_cylindrical_) return scope_->turn * straight_ * further_;
  const Vector3 in_part = scope_->turn.transpose() * (place - scope_->shift) - origin_;
  const Vector3 radius = in_part - in_part.dot(axis_) * axis_;
  const bool is_on_axis = radius.norm() < 1e-9 * (1 + in_part.norm());
  return scope_->turn * axes_from(is_on_axis ? axis_.unitOrthogonal() : radius, axis_, name_) *
         further_;
}

Vector3 AbaqusAxes::along_plate(const Vector3& place) const {
  if (axis_of_turn_ && *axis_of_turn_ != 3)
    throw CardError{fmt::format(
        "orientation {} turns about its axis {}; of plates an axis 3 that stands on them is known",
        name_, *axis_of_turn_)};
  return at(place).col(0);
}

// *ORIENTATION, NAME = , SYSTEM = / a, b, c / axis of a further turn, its angle in degrees
void AbaqusAxes::read(const AbaqusBlock& block) {
  const std::string system = block.value("SYSTEM"), definition = block.value("DEFINITION");
  is_cylindrical_ = system == "CYLINDRICAL";
  if (!system.empty() && system != "RECTANGULAR" && !is_cylindrical_)
    throw CardError{
        fmt::format("SYSTEM = {} of orientation {} is not known; RECTANGULAR and "
                    "CYLINDRICAL are",
                    system, name_)};
  if (!definition.empty() && definition != "COORDINATES")
    throw CardError{fmt::format("DEFINITION = {} of orientation {} is not known; COORDINATES is",
                                definition, name_)};
  if (block.data.empty()) throw CardError{fmt::format("orientation {} has no line of data", name_)};
  const Fields fields = block.data[0].fields();
  const Vector3 a = vector_at(fields, 0), b = vector_at(fields, 3);
  if (is_cylindrical_) {
    if (!((b - a).norm() > 0))
      throw CardError{fmt::format("the points of orientation {} are one", name_)};
    origin_ = a;
    axis_ = (b - a).normalized();
  } else {
    const Vector3 c = fields.size() > 6 ? vector_at(fields, 6) : Vector3(Vector3::Zero());
    straight_ = axes_from(a - c, (a - c).cross(b - c), name_);
  }
  if (block.data.size() > 1) turn_further(block.data[1]);
}

void AbaqusAxes::turn_further(const AbaqusLine& line) {
  const Fields fields = line.fields();
  const double number = abaqus_real(fields, 0, "axis", 1.0);
  const double angle = abaqus_real(fields, 1, "angle", 0.0) * std::numbers::pi / 180;
  if (number != 1 && number != 2 && number != 3)
    throw CardError{
        fmt::format("orientation {} turns about axis {}; 1, 2 and 3 are", name_, fields[0])};
  axis_of_turn_ = static_cast<int>(number);
  further_ = Eigen::AngleAxisd(angle, Vector3::Unit(*axis_of_turn_ - 1)).toRotationMatrix();
}

}  // namespace blocklift::structure
