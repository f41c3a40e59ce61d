#include "pipeline/build/stiffener_plates.h"

#include <set>

#include <fmt/format.h>

#include "structure/mesh/plates/stiffener_sheets.h"

namespace blocklift::pipeline {
namespace {

std::string sentence_on(const PlateModel& plate, const std::string& name) {
  const structure::Profile& profile = plate.stiffeners->profile.value();
  const structure::StiffenerPlates& sheets = profile.plates.value();
  const auto shells = structure::figures_as_plates(sheets, plate.thickness);
  const auto beam = structure::figures_as_beam(profile, plate.thickness);
  const double flange = sheets.flange_reach[1] - sheets.flange_reach[0];
  std::string text =
      fmt::format("Stiffeners of {} are plates: a web of {:.0f} x {:.1f} mm{} in the middle planes",
                  name, 1e3 * (sheets.web_height + plate.thickness / 2), 1e3 * sheets.web_thickness,
                  flange > 0 ? fmt::format(" and a flange of {:.0f} x {:.1f} mm", 1e3 * flange,
                                           1e3 * sheets.flange_thickness)
                             : "");
  return text + fmt::format(
                    "; mass {:+.1f} %, second moment about the plate {:+.1f} % against the "
                    "{}'s.",
                    100 * (shells.area / beam.area - 1),
                    100 * (shells.second_moment / beam.second_moment - 1), profile.section.name);
}

}  // namespace

std::vector<std::string> describe_stiffener_plates(const BlockModel& block) {
  std::vector<std::string> sentences;
  std::set<std::string> named;
  for (const PlateModel& plate : block.plates) {
    if (!plate.stiffeners || !plate.stiffeners->are_plates || !plate.stiffeners->profile ||
        !plate.stiffeners->profile->plates)
      continue;
    const std::string& name = plate.origin.empty() ? plate.name.value : plate.origin;
    if (named.insert(name).second) sentences.push_back(sentence_on(plate, name));
  }
  if (!sentences.empty())
    sentences.emplace_back(
        "Webs and flanges of such stiffeners are checked as panels that buckle, with their free "
        "edges; as columns with their plate, or against tripping as a whole by a formula, they are "
        "not. Where they cross other plates both go on: cut-outs are not in the model unless an "
        "opening says so.");
  return sentences;
}

}  // namespace blocklift::pipeline
