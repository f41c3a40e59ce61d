#include "pipeline/files/rigging/spreader.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "structure/mesh/sections.h"

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

bool is_whole(const BarSection& section) {
  return section.pipe.has_value() != section.box.has_value();
}

/// The elastic formulae hold for walls that do not buckle before they yield.
void check_walls(const SpreaderInCase& bar, Reading& reading) {
  const BarSection& section = bar.section.value;
  if (!is_whole(section) || !(bar.yield_stress > 0)) return;
  const double epsilon = std::sqrt(235e6 / bar.yield_stress);
  const double slenderness =
      section.pipe ? (*section.pipe)[0] / (*section.pipe)[1]
                   : std::max((*section.box)[0], (*section.box)[1]) / (*section.box)[2] - 3;
  const double most = section.pipe ? 90 * epsilon * epsilon : 42 * epsilon;
  if (slenderness <= most) return;
  reading.error(bar.section.mark,
                fmt::format("the wall of {} is too thin: {} over thickness is {:.1f}",
                            reading.owner(), section.pipe ? "diameter" : "flat width", slenderness),
                {fmt::format("up to {:.1f} a wall of this steel yields before it buckles "
                             "(EN 1993-1-1, table 5.2, class 3)",
                             most)});
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

const std::array<std::string, 4> spreader_eyes = {"upper_a", "upper_b", "lower_a", "lower_b"};

structure::Column SpreaderInCase::column() const {
  const structure::BeamSection bar = section_of(section.value);
  structure::Column column;
  column.area = bar.area;
  column.elastic_modulus = bar_modulus;
  column.yield_stress = yield_stress;
  column.length = length.value;
  // The section's axis 2 stands upright: I_3 is that of bending about the level axis.
  column.second_moments = {bar.second_moment_3, bar.second_moment_2};
  column.section_moduli = {bar.second_moment_3 / (section.value.height() / 2),
                           bar.second_moment_2 / (section.value.width() / 2)};
  column.curve = curve;
  return column;
}

double SpreaderInCase::mass() const {
  return given_mass.value_or(bar_density * section_of(section.value).area * length.value);
}

Eigen::Matrix3d SpreaderInCase::inertia() const {
  const structure::BeamSection bar = section_of(section.value);
  const double along = length.value * length.value / 12;
  const double y = bar.second_moment_3 / bar.area, z = bar.second_moment_2 / bar.area;
  return (mass() * Vector3(y + z, along + y, along + z)).asDiagonal();
}

std::optional<Vector3> SpreaderInCase::eye(const std::string& eye_name) const {
  for (std::size_t i = 0; i < spreader_eyes.size(); ++i)
    if (spreader_eyes[i] == eye_name)
      return Vector3((i % 2 == 0 ? -0.5 : 0.5) * length.value, 0, i < 2 ? upper_eye : -lower_eye);
  return std::nullopt;
}

Format<SpreaderInCase> spreader_format() {
  using structure::BucklingCurve;
  Table<SpreaderInCase> table(
      "spreader",
      "A spreader bar of steel between slings from above and slings to the load. Ropes end and "
      "begin at its eyes, which are over and under its ends a and b: B1.upper_a, B1.lower_b.");
  table
      .required("length", &SpreaderInCase::length,
                located(quantity(Dimension::length, Range::positive())), "from end a to end b")
      .required("section", &SpreaderInCase::section, located(bar_section_format()),
                "cross-section, height upright")
      .required("yield_stress", &SpreaderInCase::yield_stress,
                quantity(Dimension::stress, Range::positive()), "of its steel")
      .by_default("buckling_curve", &SpreaderInCase::curve,
                  choice<BucklingCurve>(buckling_curves()), "c",
                  "of EN 1993-1-1, table 6.2: a for hollow sections finished hot, b for welded "
                  "boxes, c for sections formed cold")
      .optional("mass", &SpreaderInCase::given_mass, quantity(Dimension::mass, Range::positive()),
                "with all that is fastened to it, spread evenly over its length; that of the "
                "section if left out")
      .by_default("upper_eye", &SpreaderInCase::upper_eye,
                  quantity(Dimension::length, Range::not_negative()), "0 m",
                  "height of the upper eyes over the bar's axis")
      .by_default("lower_eye", &SpreaderInCase::lower_eye,
                  quantity(Dimension::length, Range::not_negative()), "0 m",
                  "depth of the lower eyes below the bar's axis")
      .optional(
          "position", &SpreaderInCase::position, position_format(),
          "of the bar's middle at the start, a first guess; as its slings lead it if left out")
      .optional("orientation", &SpreaderInCase::attitude, attitude_format(),
                "at the start: roll, pitch, yaw; a first guess; along the lugs below if left out")
      .rule([](const SpreaderInCase& bar, Reading& reading, const Mark&) {
        check_walls(bar, reading);
      });
  return table.format();
}

}  // namespace blocklift::pipeline
