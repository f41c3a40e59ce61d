#include "pipeline/files/structure/profile_format.h"

#include <array>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "structure/error.h"

namespace blocklift::pipeline {
namespace {

/// A section of which its figures alone are known, as the file writes it: along the height, then
/// across.
struct WrittenFigures {
  std::array<double, 2> size = {}, second_moments = {};
  double area = 0, torsion = 0;
  std::optional<std::array<double, 2>> shear_areas;

  structure::SectionFigures in_order() const {
    structure::SectionFigures figures;
    figures.height = size[0];
    figures.width = size[1];
    figures.area = area;
    figures.second_moment_3 = second_moments[0];
    figures.second_moment_2 = second_moments[1];
    figures.torsion = torsion;
    if (shear_areas) {
      figures.shear_area_2 = (*shear_areas)[0];
      figures.shear_area_3 = (*shear_areas)[1];
    }
    return figures;
  }
};

Format<WrittenFigures> figures_format() {
  const auto area = quantity(Dimension::area, Range::positive());
  const auto moment = quantity(Dimension::second_moment_of_area, Range::positive());
  Table<WrittenFigures> table("section by figures",
                              "A section of which only figures are known, doubly symmetric, within "
                              "a rectangle in whose corners its stress is looked at.");
  table
      .required("size", &WrittenFigures::size,
                array_of<double, 2>(quantity(Dimension::length, Range::positive())),
                "[height, width] of that rectangle")
      .required("area", &WrittenFigures::area, area, "of the section")
      .required("second_moments", &WrittenFigures::second_moments, array_of<double, 2>(moment),
                "[along the height, across it]: the first resists bending along the height")
      .required("torsion", &WrittenFigures::torsion, moment, "its torsion constant J")
      .optional("shear_areas", &WrittenFigures::shear_areas, array_of<double, 2>(area),
                "[along the height, across it]; without, shear does not deform the bar");
  return table.format();
}

/// A profile as the file writes it: one of the shapes.
struct WrittenProfile {
  std::optional<std::array<double, 2>> flat_bar, bulb_flat, pipe;
  std::optional<std::array<double, 3>> box;
  std::optional<std::array<double, 4>> angle_bar, tee_bar, i_beam, channel;
  std::optional<double> round_bar;
  std::optional<WrittenFigures> figures;

  int shapes() const {
    return int{flat_bar.has_value()} + int{bulb_flat.has_value()} + int{pipe.has_value()} +
           int{box.has_value()} + int{angle_bar.has_value()} + int{tee_bar.has_value()} +
           int{i_beam.has_value()} + int{channel.has_value()} + int{round_bar.has_value()} +
           int{figures.has_value()};
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
    if (figures) return structure::profile_of_figures(figures->in_order());
    return std::nullopt;
  }
};

void check_profile(const WrittenProfile& written, Reading& reading, const Mark& mark) {
  if (written.shapes() != 1) {
    reading.error(mark,
                  fmt::format("the profile of {} has {} shapes, and one is due", reading.owner(),
                              written.shapes()),
                  {"flat_bar, bulb_flat, angle_bar, tee_bar, i_beam, channel, box, pipe, "
                   "round_bar or figures"});
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
                "[height, web, width, flange]: height over the flange, thicknesses of web and "
                "flange")
      .optional("i_beam", &WrittenProfile::i_beam, array_of<double, 4>(length),
                "[height, web, width, flange], both flanges alike")
      .optional("channel", &WrittenProfile::channel, array_of<double, 4>(length),
                "[height, web, width, flange]")
      .optional("box", &WrittenProfile::box, array_of<double, 3>(length), "[height, width, wall]")
      .optional("pipe", &WrittenProfile::pipe, array_of<double, 2>(length),
                "[outer diameter, wall]")
      .optional("round_bar", &WrittenProfile::round_bar, length, "its diameter")
      .optional("figures", &WrittenProfile::figures, figures_format(),
                "of a section of another shape")
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
