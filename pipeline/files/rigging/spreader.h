#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/declaration/geometry_format.h"
#include "structure/practice/column.h"
#include "structure/practice/rectangular_frame.h"

namespace blocklift::pipeline {

/// Closed cross-section of a bar: one of the shapes.
struct BarSection {
  std::optional<std::array<double, 2>> pipe;  ///< outer diameter, wall, m
  std::optional<std::array<double, 3>> box;   ///< height, width, wall, m

  /// One shape, whose walls leave a hollow?
  bool is_whole() const {
    if (pipe.has_value() == box.has_value()) return false;
    return pipe ? 2 * (*pipe)[1] < (*pipe)[0] : 2 * (*box)[2] < std::min((*box)[0], (*box)[1]);
  }
  double height() const { return pipe ? (*pipe)[0] : (*box)[0]; }
  double width() const { return pipe ? (*pipe)[0] : (*box)[1]; }
};

namespace given {

/// Spreader of the lift, of steel, its axes in its middle with z up: a straight bar, x along it
/// from end a to end b; or, with a width, a rectangular frame of four bars rigidly joined at
/// corners 1 to 4, anticlockwise from (-x, -y) seen from above. Slings from above end at its upper
/// eyes, those to the load begin at its lower ones, over and under its ends or corners.
struct Spreader {
  Located<std::string> name;
  Located<double> length;       ///< along x, between the eyes, m
  std::optional<double> width;  ///< of a frame, along y, between the eyes, m
  Located<BarSection> section;  ///< of a frame: of its sides along x, and of those along y
  std::optional<Located<BarSection>> cross_section;  ///< of the sides along y in place of that
  double yield_stress = 0;                           ///< Pa
  structure::BucklingCurve curve = structure::BucklingCurve::c;
  std::optional<double> given_mass;                ///< kg; none: that of its bars
  std::optional<Located<Vector3>> centre_of_mass;  ///< from its middle, m; none: there
  double upper_eye = 0;  ///< height of the upper eyes over the bar's axis, m
  double lower_eye = 0;  ///< depth of the lower ones below it, m
  /// Where it is at the start, a first guess; none: as its slings and the load lead it.
  std::optional<Vector3> position, attitude;

  bool is_frame() const { return width.has_value(); }
  /// The bar, or a frame's side along x, as it is checked, pinned at its ends.
  structure::Column column() const;
  /// The same with what it does in torsion.
  structure::FrameMember member() const;
  /// A frame's side along y. @pre is_frame()
  structure::FrameMember cross_member() const;
  double mass() const;              ///< kg
  Vector3 centre() const;           ///< of mass, from its middle, m
  Eigen::Matrix3d inertia() const;  ///< about that, as if evenly spread over its bars, kg m^2
  /// Names of its eyes: `upper_a` to `lower_b` of a bar, `upper_1` to `lower_4` of a frame.
  std::vector<std::string> eye_names() const;
  /// Place of an eye in its axes; none of another name.
  std::optional<Vector3> eye(const std::string& name) const;
  /// Its length as people say it, "6 m", or "6 m x 2.4 m".
  std::string size_text() const;
};

}  // namespace given

/// Young's modulus and density of the steel that bars are of, Pa and kg/m^3.
inline constexpr double bar_modulus = 210e9, bar_density = 7850;

/// The name of a buckling curve in files.
std::string buckling_curve_name(structure::BucklingCurve curve);

Format<given::Spreader> spreader_format();

}  // namespace blocklift::pipeline
