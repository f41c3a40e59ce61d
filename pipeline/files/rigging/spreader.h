#pragma once

#include <array>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "pipeline/declaration/geometry_format.h"
#include "structure/practice/column.h"

namespace blocklift::pipeline {

/// Closed cross-section of a bar: one of the shapes.
struct BarSection {
  std::optional<std::array<double, 2>> pipe;  ///< outer diameter, wall, m
  std::optional<std::array<double, 3>> box;   ///< height, width, wall, m

  double height() const { return pipe ? (*pipe)[0] : (*box)[0]; }
  double width() const { return pipe ? (*pipe)[0] : (*box)[1]; }
};

/// Spreader bar of the lift: a straight bar of steel, its frame in its middle with x along it from
/// end a to end b and z up. Slings from above end at its upper eyes, those to the load begin at its
/// lower ones, over and under its ends.
struct SpreaderInCase {
  Located<std::string> name;
  Located<double> length;  ///< between the eyes of its two ends, m
  Located<BarSection> section;
  double yield_stress = 0;  ///< Pa
  structure::BucklingCurve curve = structure::BucklingCurve::c;
  std::optional<double> given_mass;  ///< kg; none: that of the section over its length
  double upper_eye = 0;              ///< height of the upper eyes over the bar's axis, m
  double lower_eye = 0;              ///< depth of the lower ones below it, m
  /// Where it is at the start, a first guess; none: as its slings and the load lead it.
  std::optional<Vector3> position, attitude;

  /// The bar as it is checked, pinned at its ends.
  structure::Column column() const;
  double mass() const;              ///< kg
  Eigen::Matrix3d inertia() const;  ///< about its middle, evenly spread over the length, kg m^2
  /// Place of an eye, `upper_a` to `lower_b`, in the bar's frame; none of another name.
  std::optional<Vector3> eye(const std::string& name) const;
};

/// Names of the four eyes of a bar.
extern const std::array<std::string, 4> spreader_eyes;

/// Youngs's modulus and density of the steel that bars are of, Pa and kg/m^3.
inline constexpr double bar_modulus = 210e9, bar_density = 7850;

/// The name of a buckling curve in files.
std::string buckling_curve_name(structure::BucklingCurve curve);

Format<SpreaderInCase> spreader_format();

}  // namespace blocklift::pipeline
