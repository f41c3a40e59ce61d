#include "pipeline/files/profile_format.h"

#include <array>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "structure/error.h"

namespace blocklift::pipeline {
namespace {

/// A stiffener's profile as the file writes it: one of the shapes.
struct WrittenProfile {
  std::optional<std::array<double, 2>> flat_bar, bulb_flat;
  std::optional<std::array<double, 4>> angle_bar, tee_bar;

  /// @throws structure::ModelError if there is none of these measures.
  std::optional<structure::Profile> build() const {
    if (flat_bar) return structure::flat_bar((*flat_bar)[0], (*flat_bar)[1]);
    if (bulb_flat) return structure::bulb_flat((*bulb_flat)[0], (*bulb_flat)[1]);
    const auto of_four = [](const auto& make, const std::array<double, 4>& measures) {
      return make(measures[0], measures[1], measures[2], measures[3]);
    };
    if (angle_bar) return of_four(structure::angle_bar, *angle_bar);
    if (tee_bar) return of_four(structure::tee_bar, *tee_bar);
    return std::nullopt;
  }
};

void check_profile(const WrittenProfile& written, Reading& reading, const Mark& mark) {
  const int shapes = int{written.flat_bar.has_value()} + int{written.bulb_flat.has_value()} +
                     int{written.angle_bar.has_value()} + int{written.tee_bar.has_value()};
  if (shapes != 1) {
    reading.error(
        mark,
        fmt::format("the profile of {} has {} shapes, and one is due", reading.owner(), shapes),
        {"flat_bar, bulb_flat, angle_bar or tee_bar"});
    return;
  }
  try {
    written.build();
  } catch (const structure::ModelError& error) {
    reading.error(mark, error.what());
  }
}

}  // namespace

Format<std::optional<structure::Profile>> profile_format() {
  const auto length = quantity(Dimension::length, Range::positive());
  Table<WrittenProfile> table("profile", "Of a stiffener, by its measures from the plate on.");
  table
      .optional("flat_bar", &WrittenProfile::flat_bar, array_of<double, 2>(length),
                "[height, thickness]")
      .optional("bulb_flat", &WrittenProfile::bulb_flat, array_of<double, 2>(length),
                "[height, thickness], nominal; the bulb is that of EN 10067")
      .optional("angle_bar", &WrittenProfile::angle_bar, array_of<double, 4>(length),
                "[height, web, width, flange]: height over the flange, thicknesses of web and "
                "flange")
      .optional("tee_bar", &WrittenProfile::tee_bar, array_of<double, 4>(length),
                "[height, web, width, flange], likewise")
      .rule(check_profile);
  return converted<WrittenProfile, std::optional<structure::Profile>>(
      table.format(), [](const WrittenProfile& written) -> std::optional<structure::Profile> {
        try {
          return written.build();
        } catch (const structure::ModelError&) {
          return std::nullopt;  // complained about by the rule
        }
      });
}

}  // namespace blocklift::pipeline
