#include "pipeline/files/profile_format.h"

#include <array>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "structure/error.h"

namespace blocklift::pipeline {
namespace {

/// A profile as the file writes it: one of the shapes.
struct WrittenProfile {
  std::optional<std::array<double, 2>> flat_bar, bulb_flat, pipe;
  std::optional<std::array<double, 3>> box;
  std::optional<std::array<double, 4>> angle_bar, tee_bar, i_beam, channel;
  std::optional<double> round_bar;

  int shapes() const {
    return int{flat_bar.has_value()} + int{bulb_flat.has_value()} + int{pipe.has_value()} +
           int{box.has_value()} + int{angle_bar.has_value()} + int{tee_bar.has_value()} +
           int{i_beam.has_value()} + int{channel.has_value()} + int{round_bar.has_value()};
  }

  /// @throws structure::ModelError if there is none of these measures.
  std::optional<structure::Profile> build() const {
    if (flat_bar) return structure::flat_bar((*flat_bar)[0], (*flat_bar)[1]);
    if (bulb_flat) return structure::bulb_flat((*bulb_flat)[0], (*bulb_flat)[1]);
    const auto of_four = [](const auto& make, const std::array<double, 4>& measures) {
      return make(measures[0], measures[1], measures[2], measures[3]);
    };
    if (angle_bar) return of_four(structure::angle_bar, *angle_bar);
    if (tee_bar) return of_four(structure::tee_bar, *tee_bar);
    if (channel) return of_four(structure::channel, *channel);
    if (i_beam) {
      const auto& [height, web, width, flange] = *i_beam;
      return structure::i_beam(height, web, width, flange, width, flange);
    }
    if (box) return structure::box((*box)[0], (*box)[1], (*box)[2]);
    if (pipe) return structure::pipe((*pipe)[0] / 2, (*pipe)[0] / 2 - (*pipe)[1]);
    if (round_bar) return structure::solid_circle(*round_bar / 2);
    return std::nullopt;
  }
};

void check_profile(const WrittenProfile& written, Reading& reading, const Mark& mark) {
  if (written.shapes() != 1) {
    reading.error(mark,
                  fmt::format("the profile of {} has {} shapes, and one is due", reading.owner(),
                              written.shapes()),
                  {"flat_bar, bulb_flat, angle_bar, tee_bar, i_beam, channel, box, pipe or "
                   "round_bar"});
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
  Table<WrittenProfile> table("profile",
                              "Of a stiffener or a bar: one shape by its measures over all, "
                              "heights away from the plate or along \"towards\".");
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
      .optional("i_beam", &WrittenProfile::i_beam, array_of<double, 4>(length),
                "[height, web, width, flange], both flanges alike")
      .optional("channel", &WrittenProfile::channel, array_of<double, 4>(length),
                "[height, web, width, flange]")
      .optional("box", &WrittenProfile::box, array_of<double, 3>(length), "[height, width, wall]")
      .optional("pipe", &WrittenProfile::pipe, array_of<double, 2>(length),
                "[outer diameter, wall]")
      .optional("round_bar", &WrittenProfile::round_bar, length, "its diameter")
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

void check_direction(const std::optional<structure::Profile>& profile,
                     const std::optional<Vector3>& towards, Reading& reading, const Mark& mark) {
  if (!profile || profile->is_round || towards) return;
  reading.error(mark, reading.owner() + " has a section, but not towards what it stands",
                {"such as towards: [0, 0, -1]; pipes and round bars alone need none"});
}

}  // namespace blocklift::pipeline
