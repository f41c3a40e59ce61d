#include "pipeline/results/summaries/padeye_summary.h"

#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/formats/json_values.h"
#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json formula_json(const PadeyeFormulaAtWorst& at_worst) {
  const structure::PadeyeFormula& formula = at_worst.formula;
  Json json{{"name", formula.name},
            {"demand", json_number(formula.demand)},
            {"limit", json_number(formula.limit)},
            {"unit", formula.unit},
            {"utilisation", json_number(formula.utilisation)},
            {"pass", formula.utilisation <= 1},
            {"source", formula.source}};
  if (at_worst.time) json["time_s"] = *at_worst.time;
  return json;
}

namespace {

Json state_json(const PadeyeState& state) {
  const structure::PadeyeResult& result = state.result;
  const structure::Extreme& peak =
      result.cheeks.peak_von_mises.value > result.main_plate.peak_von_mises.value
          ? result.cheeks.peak_von_mises
          : result.main_plate.peak_von_mises;
  Json json{{"name", state.name},
            {"force_N", json_point(state.force_P)},
            {"main_plate_checked_von_mises_Pa", result.main_plate.checked_von_mises.value},
            {"cheeks_checked_von_mises_Pa", result.cheeks.checked_von_mises.value},
            {"peak_von_mises_Pa", peak.value},
            {"peak_point_m", json_point(peak.point_B)},
            {"force_residual", result.force_residual},
            {"moment_residual", result.moment_residual}};
  if (state.time) json["time_s"] = *state.time;
  return json;
}

Json padeye_json(const PadeyeAssessment& padeye) {
  Json json{{"lug", padeye.lug},
            {"rope", padeye.rope},
            {"padeye", padeye.padeye},
            {"consequence_factor", padeye.consequence_factor},
            {"unknowns", 3 * padeye.model->part().mesh.nodes.cols()},
            {"governing_state", padeye.governing},
            {"file", padeye_file(padeye)},
            {"formulas", Json::array()},
            {"states", Json::array()}};
  for (const PadeyeFormulaAtWorst& formula : padeye.formulas)
    json["formulas"].push_back(formula_json(formula));
  for (const PadeyeState& state : padeye.states) json["states"].push_back(state_json(state));
  return json;
}

}  // namespace

std::string padeye_file(const PadeyeAssessment& padeye) { return "lug-" + padeye.lug + ".vtu"; }

Json padeyes_json(const PadeyesAssessment& padeyes) {
  Json rows = Json::array();
  for (const PadeyeAssessment& padeye : padeyes.padeyes) rows.push_back(padeye_json(padeye));
  return rows;
}

void write_padeyes(ResultsWriter& file, const PadeyesAssessment& padeyes) {
  for (const PadeyeAssessment& padeye : padeyes.padeyes) {
    const auto& columns = padeye.model->columns();
    RowMajorMatrix corners(static_cast<Eigen::Index>(columns.size()), 8);
    std::vector<std::int32_t> plates;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      for (std::size_t i = 0; i < 4; ++i)
        corners.row(c).segment<2>(2 * static_cast<Eigen::Index>(i)) =
            columns[c].corners[i].transpose();
      plates.push_back(static_cast<std::int32_t>(columns[c].plate));
    }
    const PadeyeState& state = padeye.governing_state();
    const std::string group = layout::join(layout::padeyes_group, padeye.lug);
    file.write_matrix(layout::join(group, "corners"), corners,
                      {"m",
                       "x, y of four corners a row, counter-clockwise; the padeye's frame, "
                       "origin in the middle of the hole, y away from the block"});
    file.write(layout::join(group, "plate"), plates,
               {"1", "0 main plate, 1 cheek plate in front, 2 cheek plate behind"});
    file.write(
        layout::join(group, "von_mises"),
        std::span<const double>(state.result.column_von_mises.data(),
                                static_cast<std::size_t>(state.result.column_von_mises.size())),
        {"Pa", "of the mean stress over the plate's thickness, without consequence factor"});
    file.write(layout::join(group, "force"), std::span<const double>(state.force_P.data(), 3),
               {"N", "of the pin on the padeye, in its frame"});
    file.write_attribute(group, "state", state.name);
    file.write_attribute(group, "rope", padeye.rope);
    if (state.time) file.write_attribute(group, "time", *state.time);
  }
}

}  // namespace blocklift::pipeline
