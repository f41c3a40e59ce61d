#include "structure/mesh/files/abaqus/layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace blocklift::structure {

namespace {

/// The angle that a layer's line gives, rad; none if its fourth field is no number.
std::optional<double> given_angle(const std::vector<std::string_view>& fields) {
  try {
    return abaqus_real(fields, 3, "angle", 0.0) * std::numbers::pi / 180;
  } catch (const CardError&) {
    return std::nullopt;
  }
}

/// The part of a direction along a plate. @throws CardError if it stands on the plate.
Vector3 part_along(const Vector3& direction, const Vector3& normal, const std::string& whose) {
  const Vector3 along = direction - direction.dot(normal) * normal;
  if (along.norm() < 1e-3 * direction.norm())
    throw CardError{fmt::format("axis 1 of {} stands on a plate, along which it is due", whose)};
  return along.normalized();
}

}  // namespace

AbaqusLayers::AbaqusLayers(const AbaqusModel& model, const AbaqusScope& scope,
                           const AbaqusBlock& block) {
  if (block.data.empty()) throw CardError{"there are no layers"};
  for (const AbaqusLine& line : block.data) {
    const std::vector<std::string_view> fields = line.fields();
    if (fields.size() < 3)
      throw CardError{
          "a layer is thickness, points, material, and an angle or the name of an orientation"};
    materials_.push_back(upper(fields[2]));
    const auto found = model.materials.find(materials_.back());
    if (found == model.materials.end())
      throw CardError{fmt::format("material {} does not exist", fields[2])};
    refuse_solids_alone(found->second);
    Ply ply;
    ply.material = found->second.ply;
    if (obstacle_.empty()) obstacle_ = found->second.obstacle;
    ply.thickness = abaqus_real(fields, 0, "thickness") * model.units.length;
    if (!(ply.thickness > 0)) throw CardError{"the thickness of a layer must be positive"};
    const std::optional<double> angle = given_angle(fields);
    ply.angle = angle.value_or(0);
    std::optional<AbaqusAxes> own;
    if (!angle) own.emplace(scope, upper(fields[3]));
    axes_.push_back(std::move(own));
    plies_.push_back(ply);
  }
}

double AbaqusLayers::thickness() const {
  double sum = 0;
  for (const Ply& ply : plies_) sum += ply.thickness;
  return sum;
}

std::optional<std::string> AbaqusLayers::only_material() const {
  for (const std::string& material : materials_)
    if (material != materials_.front()) return std::nullopt;
  return materials_.front();
}

bool AbaqusLayers::have_axes() const {
  return std::any_of(axes_.begin(), axes_.end(), [](const auto& axes) { return axes.has_value(); });
}

std::vector<Ply> AbaqusLayers::at(const Vector3& centre, const Vector3& normal,
                                  const Vector3& axis_1) const {
  constexpr double step = 1e-4;
  const Vector3 from = part_along(axis_1, normal, "the section");
  std::vector<Ply> turned = plies_;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (!axes_[i]) continue;
    const Vector3 own = part_along(axes_[i]->along_plate(centre), normal,
                                   fmt::format("the orientation of layer {}", i + 1));
    turned[i].angle =
        step * std::round(std::atan2(normal.dot(from.cross(own)), from.dot(own)) / step);
  }
  return turned;
}

}  // namespace blocklift::structure
