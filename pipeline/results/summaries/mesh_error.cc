#include "pipeline/results/summaries/mesh_error.h"

#include <algorithm>

#include <fmt/format.h>

namespace blocklift::pipeline {

std::string why_indicative(const Assessment& assessment) {
  if (!assessment.block.model) return {};
  const structure::CheckedAccuracy& accuracy = assessment.block.accuracy;
  if (accuracy.steps.size() < 2) {
    const double error = assessment.block.error.relative;
    if (!(error > largest_mesh_error)) return {};
    return fmt::format(
        "there is one mesh only, and the estimated error of its stress field is {:.0f} % in the "
        "energy norm",
        100 * error);
  }
  if (accuracy.stress_change() > largest_mesh_error)
    return fmt::format("the last refinement of the mesh moved the checked stress by {:.0f} %",
                       100 * accuracy.stress_change());
  if (accuracy.is_reached) return {};
  return fmt::format(
      "the last refinement of the mesh moved the checked stress by {:.1f} %, and the case asks for "
      "{:.1f} %",
      100 * accuracy.stress_change(), 100 * assessment.lift_case.structure.accuracy);
}

double checked_stress_band(const BlockRun& block) {
  return block.accuracy.steps.size() < 2 ? block.error.relative : block.accuracy.stress_change();
}

void note_band(double band, Check& check) {
  check.band = band;
  if (!check.note.empty()) check.note += "; ";
  const bool is_stress = check.unit == "Pa";
  const double scale = is_stress ? 1e-6 : 1;
  // As many digits as the check itself is shown with.
  const auto shown = [&](double share) {
    const double value = scale * check.demand * share;
    return value < 999.5 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
  };
  check.note += fmt::format("{} to {}{} by the error of the mesh", shown(std::max(0.0, 1 - band)),
                            shown(1 + band), is_stress ? " MPa" : "");
}

}  // namespace blocklift::pipeline
