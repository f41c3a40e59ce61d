#include "pipeline/part/part_assessment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "pipeline/lift/stopwatch.h"
#include "pipeline/part/part_refinement.h"
#include "structure/error.h"
#include "structure/stress_tensor.h"

namespace blocklift::pipeline {

namespace {

using structure::PartModel;

std::vector<ProbeResult> find_probes(const PartFile& file, const PartModel& model,
                                     const structure::PartSolution& solution,
                                     Diagnostics& diagnostics) {
  std::vector<ProbeResult> results;
  for (const given::PartProbe& probe : file.probes) {
    ProbeResult result{probe.name.value, !probe.at, {}};
    const int count = probe.at ? 1 : probe.points;
    for (int i = 0; i < count; ++i) {
      const Vector3 place = probe.at ? *probe.at
                                     : Vector3(*probe.from + static_cast<double>(i) / (count - 1) *
                                                                 (*probe.to - *probe.from));
      result.points.push_back(structure::probe_part(model, solution, place));
    }
    const auto outside = std::count_if(result.points.begin(), result.points.end(),
                                       [](const auto& point) { return !point.inside; });
    if (outside == count)
      diagnostics.error(probe.name.mark,
                        fmt::format("probe {} lies outside the part", probe.name.value));
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<HotSpotResult> find_hot_spots(const PartFile& file, const PartModel& model,
                                          const structure::PartSolution& solution,
                                          Diagnostics& diagnostics) {
  std::vector<HotSpotResult> results;
  for (const given::HotSpot& asked : file.hot_spots) {
    HotSpotResult result{asked.name.value, {asked.toe, asked.direction, asked.thickness}, {}, {}};
    std::array<structure::Stress, 2> stress;
    bool inside = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector3 place = result.spot.places()[i];
      const structure::PartProbe probe = structure::probe_part(model, solution, place);
      stress[i] = probe.stress;
      if (inside && !probe.inside)
        diagnostics.error(asked.name.mark,
                          fmt::format("hot spot {} is read at ({:.6g}, {:.6g}, {:.6g}) m, which is "
                                      "outside the part",
                                      asked.name.value, place.x(), place.y(), place.z()),
                          {"the toe lies on the surface and the direction along it"});
      inside = inside && probe.inside;
    }
    result.structural = structure::hot_spot_stress(stress[0], stress[1]);
    result.stress = structure::evaluate_hot_spot(result.structural, asked.direction);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace

double figure_of(const PartAssessment& assessment, const PartReference& reference) {
  if (reference.mode) return assessment.modes->frequencies[*reference.mode - 1];
  const auto probe = std::find_if(
      assessment.probes.begin(), assessment.probes.end(),
      [&](const ProbeResult& result) { return result.name == reference.probe->value; });
  const structure::PartProbe& point = probe->points.at(0);
  const PartQuantity quantity = *reference.quantity;
  if (quantity == PartQuantity::von_mises) return structure::von_mises(point.stress);
  const int place = static_cast<int>(quantity);
  return quantity >= PartQuantity::u_x
             ? point.displacement[place - static_cast<int>(PartQuantity::u_x)]
             : point.stress[place];
}

std::string name_of(const PartReference& reference) {
  return reference.mode
             ? fmt::format("frequency of mode {}", *reference.mode)
             : fmt::format("{} at {}", name_of(*reference.quantity), reference.probe->value);
}

PartAssessment assess_part(PartFile file) {
  Diagnostics diagnostics;
  PartAssessment assessment;
  assessment.file = std::move(file);
  solve_to_accuracy(assessment, diagnostics);
  Stopwatch watch;
  try {
    if (assessment.file.modes)
      assessment.modes = structure::find_part_modes(assessment.model, *assessment.file.modes);
  } catch (const structure::ModelError& error) {
    diagnostics.error(assessment.file.mesh.mark(), error.what());
    throw InputError(diagnostics);
  }
  assessment.modes_s = watch.lap();
  assessment.mass = structure::find_part_mass(assessment.model);
  if (assessment.file.loads.empty()) return assessment;
  assessment.probes =
      find_probes(assessment.file, assessment.model, assessment.solution, diagnostics);
  if (assessment.file.mesh.padeye) assessment.padeye = assess_part_padeye(assessment);
  assessment.hot_spots =
      find_hot_spots(assessment.file, assessment.model, assessment.solution, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return assessment;
}

}  // namespace blocklift::pipeline
