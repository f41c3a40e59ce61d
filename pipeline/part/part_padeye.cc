#include "pipeline/part/part_padeye.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "pipeline/part/part_assessment.h"
#include "structure/error.h"

namespace blocklift::pipeline {

structure::PadeyeMesh part_padeye_mesh(const PartFile& file) {
  constexpr int most = 256;
  const PadeyePart& padeye = file.mesh.padeye->value;
  const int divisions = padeye.divisions << file.mesh.refinements;
  if (divisions > most)
    throw structure::ModelError(
        fmt::format("the padeye would have {} elements around its hole ({} doubled {} times); {} "
                    "are the most",
                    divisions, padeye.divisions, file.mesh.refinements, most));
  return structure::make_padeye_mesh(padeye.geometry(), divisions);
}

PartPadeye assess_part_padeye(const PartAssessment& assessment) {
  const PadeyePart& padeye = assessment.file.mesh.padeye->value;
  const structure::PartModel& model = assessment.model;
  const structure::PadeyeMesh mesh = part_padeye_mesh(assessment.file);
  const auto solids = structure::solids_of_columns(model.mesh, mesh.columns);
  PartPadeye result;
  result.input.geometry = padeye.geometry();
  // The main plate's columns come first.
  result.input.material = model.materials[model.material_of_solid[solids.front().front()]];
  result.input.cheek_weld = padeye.cheek_weld;
  result.input.base_weld = padeye.base_weld;
  result.input.doubler = padeye.doubler;
  result.input.jaw = padeye.jaw;
  result.input.tensile_strength = padeye.tensile_strength;
  result.input.design_factor = padeye.design_factor;
  result.input.side_load = padeye.side_load;
  for (const structure::SurfaceLoad& load : model.surface_loads)
    if (load.kind == structure::SurfaceLoad::Kind::bearing) result.force_P += load.vector;
  if (result.force_P.norm() > 0)
    for (const structure::PadeyeFormula& formula :
         structure::padeye_strength(result.input, result.force_P))
      result.formulas.push_back({formula, true, std::nullopt});
  for (const structure::PadeyeFormula& rule : structure::padeye_rules(result.input))
    result.formulas.push_back({rule, false, std::nullopt});
  result.stress = structure::find_padeye_stress(result.input.geometry, mesh.columns, solids, model,
                                                assessment.solution.displacement);
  return result;
}

}  // namespace blocklift::pipeline
