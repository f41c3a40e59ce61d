#include "pipeline/files/rigging/spreader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "structure/mesh/beams/sections.h"

namespace blocklift::pipeline {
namespace {

structure::BeamSection section_of(const BarSection& section) {
  if (section.pipe) {
    const double outer = (*section.pipe)[0] / 2;
    return structure::pipe(outer, outer - (*section.pipe)[1]).section;
  }
  return structure::box((*section.box)[0], (*section.box)[1], (*section.box)[2]).section;
}

void check_section(const BarSection& section, Reading& reading, const Mark& mark) {
  const int shapes = int{section.pipe.has_value()} + int{section.box.has_value()};
  if (shapes != 1) {
    reading.error(
        mark,
        fmt::format("the section of {} has {} shapes, and one is due", reading.owner(), shapes),
        {"pipe or box: open profiles, which also buckle sideways, are not taken"});
    return;
  }
  const double wall = section.pipe ? (*section.pipe)[1] : (*section.box)[2];
  const double least = std::min(section.height(), section.width());
  if (2 * wall < least) return;
  reading.error(mark, fmt::format("a wall of {:g} mm is thicker than half of the section's {:g} mm",
                                  1e3 * wall, 1e3 * least));
}

Format<BarSection> bar_section_format() {
  const auto length = quantity(Dimension::length, Range::positive());
  Table<BarSection> table("bar section", "Closed cross-section of a bar, by one of these shapes.");
  table.optional("pipe", &BarSection::pipe, array_of<double, 2>(length), "[outer diameter, wall]")
      .optional("box", &BarSection::box, array_of<double, 3>(length),
                "[height, width, wall], over all")
      .rule(check_section);
  return table.format();
}

/// The elastic formulae hold for walls that do not buckle before they yield.
void check_walls(const Located<BarSection>& located_section, double yield_stress,
                 Reading& reading) {
  const BarSection& section = located_section.value;
  if (!section.is_whole() || !(yield_stress > 0)) return;
  const double epsilon = std::sqrt(235e6 / yield_stress);
  const double slenderness =
      section.pipe ? (*section.pipe)[0] / (*section.pipe)[1]
                   : std::max((*section.box)[0], (*section.box)[1]) / (*section.box)[2] - 3;
  const double most = section.pipe ? 90 * epsilon * epsilon : 42 * epsilon;
  if (slenderness <= most) return;
  reading.error(located_section.mark,
                fmt::format("the wall of {} is too thin: {} over thickness is {:.1f}",
                            reading.owner(), section.pipe ? "diameter" : "flat width", slenderness),
                {fmt::format("up to {:.1f} a wall of this steel yields before it buckles "
                             "(EN 1993-1-1, table 5.2, class 3)",
                             most)});
}

/// Nothing but a bar's own steel and what is fastened to it has weight. Along the bar it rises or
/// falls evenly, and is nowhere less than nothing while its centre lies within the middle third.
void check_centre(const given::Spreader& spreader, Reading& reading) {
  if (!spreader.centre_of_mass || !spreader.section.value.is_whole()) return;
  const Vector3& centre = spreader.centre_of_mass->value;
  const double x = spreader.length.value / 6;
  const double y = spreader.width.value_or(spreader.section.value.width()) / 2;
  if (std::abs(centre.x()) <= x && std::abs(centre.y()) <= y) return;
  reading.error(spreader.centre_of_mass->mark,
                fmt::format("the centre of mass of {} lies too far out, at x {:g} m, y {:g} m",
                            reading.owner(), centre.x(), centre.y()),
                {fmt::format("it is counted from its middle: up to {:g} m along x, a sixth of the "
                             "length, and {:g} m along y either way",
                             x, y)});
}

void check_bars(const given::Spreader& spreader, Reading& reading) {
  check_walls(spreader.section, spreader.yield_stress, reading);
  check_centre(spreader, reading);
  if (!spreader.cross_section) return;
  if (spreader.is_frame())
    check_walls(*spreader.cross_section, spreader.yield_stress, reading);
  else
    reading.error(spreader.cross_section->mark,
                  fmt::format("{} has a cross_section and no width", reading.owner()),
                  {"a frame has a width; a bar has one section"});
}

/// Largest shear stress of a torsion moment is that over this: J over the outer radius of a pipe,
/// Bredt's 2 A t of a box, A within the middle of its walls.
double torsion_modulus_of(const BarSection& section, double torsion_constant) {
  if (section.pipe) return torsion_constant / ((*section.pipe)[0] / 2);
  const auto& [height, width, wall] = *section.box;
  return 2 * (height - wall) * (width - wall) * wall;
}

structure::FrameMember member_of(const BarSection& section, double length, double yield_stress,
                                 structure::BucklingCurve curve) {
  const structure::BeamSection bar = section_of(section);
  structure::FrameMember member;
  structure::Column& column = member.column;
  column.area = bar.area;
  column.elastic_modulus = bar_modulus;
  column.yield_stress = yield_stress;
  column.length = length;
  // The section's axis 2 stands upright: I_3 is that of bending about the level axis.
  column.second_moments = {bar.second_moment_3, bar.second_moment_2};
  column.section_moduli = {bar.second_moment_3 / (section.height() / 2),
                           bar.second_moment_2 / (section.width() / 2)};
  column.curve = curve;
  member.torsion_constant = bar.torsion;
  member.torsion_modulus = torsion_modulus_of(section, bar.torsion);
  return member;
}

const std::vector<std::pair<std::string, structure::BucklingCurve>>& buckling_curves() {
  using structure::BucklingCurve;
  static const std::vector<std::pair<std::string, BucklingCurve>> all{{"a0", BucklingCurve::a0},
                                                                      {"a", BucklingCurve::a},
                                                                      {"b", BucklingCurve::b},
                                                                      {"c", BucklingCurve::c},
                                                                      {"d", BucklingCurve::d}};
  return all;
}

}  // namespace

std::string buckling_curve_name(structure::BucklingCurve curve) {
  for (const auto& [name, one] : buckling_curves())
    if (one == curve) return name;
  return {};
}

structure::Column given::Spreader::column() const { return member().column; }

structure::FrameMember given::Spreader::member() const {
  return member_of(section.value, length.value, yield_stress, curve);
}

structure::FrameMember given::Spreader::cross_member() const {
  const BarSection& across = cross_section ? cross_section->value : section.value;
  return member_of(across, *width, yield_stress, curve);
}

double given::Spreader::mass() const {
  if (given_mass) return *given_mass;
  const double along = column().area * length.value;
  if (!is_frame()) return bar_density * along;
  return bar_density * 2 * (along + cross_member().column.area * *width);
}

Vector3 given::Spreader::centre() const {
  return centre_of_mass ? centre_of_mass->value : Vector3::Zero();
}

Eigen::Matrix3d given::Spreader::inertia() const {
  // Of a bar along its first axis, over its mass.
  const auto of_bar = [](const structure::Column& bar) {
    const double along = bar.length * bar.length / 12;
    const double y = bar.second_moments[0] / bar.area, z = bar.second_moments[1] / bar.area;
    return Vector3(y + z, along + y, along + z);
  };
  const structure::Column bar = column();
  if (!is_frame()) return (mass() * of_bar(bar)).asDiagonal();
  const structure::Column across = cross_member().column;
  const double share =
      bar.area * bar.length / (bar.area * bar.length + across.area * across.length);
  const double y = across.length * across.length / 4, x = bar.length * bar.length / 4;
  const Vector3 own = of_bar(across);
  const Vector3 I = share * (of_bar(bar) + Vector3(y, 0, y)) +
                    (1 - share) * (Vector3(own.y(), own.x(), own.z()) + Vector3(0, x, x));
  return (mass() * I).asDiagonal();
}

std::vector<std::string> given::Spreader::eye_names() const {
  if (!is_frame()) return {"upper_a", "upper_b", "lower_a", "lower_b"};
  return {"upper_1", "upper_2", "upper_3", "upper_4", "lower_1", "lower_2", "lower_3", "lower_4"};
}

std::optional<Vector3> given::Spreader::eye(const std::string& eye_name) const {
  const std::vector<std::string> names = eye_names();
  const auto found = std::ranges::find(names, eye_name);
  if (found == names.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(found - names.begin()), half = names.size() / 2;
  const Vector3 height(0, 0, i < half ? upper_eye : -lower_eye);
  if (is_frame())
    return structure::RectangularFrame::corners(length.value, *width)[i % half] + height;
  return Vector3((i % half == 0 ? -0.5 : 0.5) * length.value, 0, 0) + height;
}

std::string given::Spreader::size_text() const {
  const std::string text = format_quantity(length.value, Dimension::length);
  return is_frame() ? text + " x " + format_quantity(*width, Dimension::length) : text;
}

Format<given::Spreader> spreader_format() {
  using structure::BucklingCurve;
  Table<given::Spreader> table(
      "spreader",
      "A spreader bar of steel, or with a width a rectangular frame of four bars that are rigidly "
      "joined at their corners, between slings from above and slings to the load. Ropes end and "
      "begin at its eyes. Those of a bar are over and under its ends a and b: B1.upper_a, "
      "B1.lower_b; those of a frame over and under its corners 1 to 4, anticlockwise seen from "
      "above from the one at -x and -y: F1.upper_1, F1.lower_4.");
  table
      .required("length", &given::Spreader::length,
                located(quantity(Dimension::length, Range::positive())),
                "from end a to end b; of a frame along x, from corner 1 to corner 2")
      .optional("width", &given::Spreader::width, quantity(Dimension::length, Range::positive()),
                "of a frame along y, from corner 2 to corner 3; a bar if left out")
      .required("section", &given::Spreader::section, located(bar_section_format()),
                "cross-section, height upright; of a frame that of its sides along x, and along y "
                "unless those have their own")
      .optional("cross_section", &given::Spreader::cross_section, located(bar_section_format()),
                "of a frame's sides along y")
      .required("yield_stress", &given::Spreader::yield_stress,
                quantity(Dimension::stress, Range::positive()), "of its steel")
      .by_default("buckling_curve", &given::Spreader::curve,
                  choice<BucklingCurve>(buckling_curves()), "c",
                  "of EN 1993-1-1, table 6.2: a for hollow sections finished hot, b for welded "
                  "boxes, c for sections formed cold")
      .optional(
          "mass", &given::Spreader::given_mass, quantity(Dimension::mass, Range::positive()),
          "with all that is fastened to it, spread evenly over its bars; that of these if left "
          "out")
      .optional("centre_of_mass", &given::Spreader::centre_of_mass, located(position_format()),
                "from its middle in its axes, with all that is fastened to it; its weight then "
                "falls or rises evenly along it; the middle if left out")
      .by_default("upper_eye", &given::Spreader::upper_eye,
                  quantity(Dimension::length, Range::not_negative()), "0 m",
                  "height of the upper eyes over the bars' axes")
      .by_default("lower_eye", &given::Spreader::lower_eye,
                  quantity(Dimension::length, Range::not_negative()), "0 m",
                  "depth of the lower eyes below the bars' axes")
      .optional("position", &given::Spreader::position, position_format(),
                "of its middle at the start, a first guess; as its slings lead it if left out")
      .optional("orientation", &given::Spreader::attitude, attitude_format(),
                "at the start: roll, pitch, yaw; a first guess; along the lugs below if left out")
      .rule([](const given::Spreader& bar, Reading& reading, const Mark&) {
        check_bars(bar, reading);
      });
  return table.format();
}

}  // namespace blocklift::pipeline
