#include "pipeline/checks/buckling_assessment.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/results_layout.h"
#include "pipeline/lift/stopwatch.h"

namespace blocklift::pipeline {

namespace {

using structure::BlockPanels;

constexpr std::size_t panels_in_summary = 40;

BlockPanels make_panels(const LiftCase& lift_case, const structure::UnitResponses& responses) {
  std::vector<structure::PlateStiffening> stiffening;
  for (const PlateModel& plate : lift_case.load.model->plates) {
    if (!plate.stiffeners) continue;
    const auto along = static_cast<Eigen::Index>(plate.stiffeners->along);
    const Eigen::Matrix3d axes = plate.corners
                                     ? structure::frame_of_polygon(plate.corners->value).axes
                                     : Eigen::Matrix3d::Identity();
    stiffening.push_back({plate.name.value, axes.col(along), plate.stiffeners->spacing});
  }
  return {responses.model(), responses.displacements(), stiffening};
}

/// States of the block: factors of the unit responses, a column a state, and times if there are
/// any.
struct States {
  const Eigen::MatrixXd& factors;
  const Eigen::VectorXd* time = nullptr;  ///< s
};

/// The worse of static and dynamic states, panel by panel.
BucklingAssessment worse_of(const LiftCase& lift_case, const structure::UnitResponses& responses,
                            const States& static_states, const States& dynamic_states) {
  Stopwatch watch;
  const BlockPanels panels = make_panels(lift_case, responses);
  const auto at_rest = panels.find_worst(static_states.factors);
  const auto in_motion = panels.find_worst(dynamic_states.factors);
  BucklingAssessment result;
  for (std::size_t p = 0; p < panels.panels().size(); ++p) {
    const bool moving = in_motion[p].utilisation.critical >= at_rest[p].utilisation.critical;
    BuckledPanel panel{panels.panels()[p], moving ? in_motion[p] : at_rest[p], moving, {}};
    if (const Eigen::VectorXd* time = (moving ? dynamic_states : static_states).time)
      panel.time = (*time)[panel.worst.instant];
    result.panels.push_back(std::move(panel));
  }
  std::stable_sort(result.panels.begin(), result.panels.end(), [](const auto& a, const auto& b) {
    return a.worst.utilisation.critical > b.worst.utilisation.critical;
  });
  result.evaluation_s = watch.lap();
  return result;
}

std::string field_text(const structure::Panel& panel) {
  return fmt::format("{} at ({:.2f}, {:.2f}, {:.2f}) m, field of {:.2f} x {:.2f} m, {:g} mm",
                     panel.plate, panel.centre_B.x(), panel.centre_B.y(), panel.centre_B.z(),
                     panel.size.a / panel.fields_a, panel.size.b / panel.fields_b,
                     1000 * panel.size.thickness);
}

}  // namespace

BucklingAssessment assess_buckling(const LiftCase& lift_case,
                                   const structure::UnitResponses& responses,
                                   const HistoryAssessment& history) {
  return worse_of(lift_case, responses, {history.static_state.factors, &history.static_state.time},
                  {history.dynamic_state.factors, &history.dynamic_state.time});
}

BucklingAssessment assess_buckling(const LiftCase& lift_case,
                                   const structure::UnitResponses& responses,
                                   const BlockAssessment& block) {
  const Eigen::MatrixXd at_rest = responses.coefficients(block.simultaneous.static_state.load);
  const Eigen::MatrixXd in_motion = responses.coefficients(block.simultaneous.dynamic_state.load);
  return worse_of(lift_case, responses, {at_rest}, {in_motion});
}

std::vector<Check> check_buckling(const LiftCase& lift_case, const BucklingAssessment& buckling) {
  const double factor = lift_case.checks.buckling_factor.value_or(lift_case.checks.yield_factor);
  std::vector<Check> checks;
  std::set<std::string> seen;
  for (const BuckledPanel& panel : buckling.panels) {
    if (!seen.insert(panel.panel.group).second) continue;
    Check check =
        check_at_most(fmt::format("buckling of panels in {}: utilisation against 1 / {:g}",
                                  panel.panel.group, factor),
                      panel.worst.utilisation.critical, 1 / factor, "1");
    check.time = panel.time;
    check.note = field_text(panel.panel);
    check.is_by_mesh = true;
    checks.push_back(std::move(check));
  }
  return checks;
}

nlohmann::ordered_json buckling_json(const BucklingAssessment& buckling) {
  using Json = nlohmann::ordered_json;
  Json json{{"panels_looked_at", buckling.panels.size()}, {"panels", Json::array()}};
  for (const BuckledPanel& panel : buckling.panels) {
    if (json["panels"].size() == panels_in_summary) break;
    const structure::Panel& of = panel.panel;
    const structure::PanelStress& stress = panel.worst.stress;
    Json row{{"plate", of.plate},
             {"centre_m", {of.centre_B.x(), of.centre_B.y(), of.centre_B.z()}},
             {"sides_m", {of.size.a, of.size.b}},
             {"field_m", {of.size.a / of.fields_a, of.size.b / of.fields_b}},
             {"thickness_m", of.size.thickness},
             {"free_edges", of.free.along_a + of.free.along_b},
             {"s11_Pa", stress.s11},
             {"s22_Pa", stress.s22},
             {"s12_Pa", stress.s12},
             {"utilisation", panel.worst.utilisation.critical},
             {"elastic_utilisation", panel.worst.utilisation.elastic},
             {"state", panel.in_motion ? "dynamic" : "static"}};
    if (panel.time) row["time_s"] = *panel.time;
    json["panels"].push_back(std::move(row));
  }
  return json;
}

void write_buckling(ResultsWriter& file, const BucklingAssessment& buckling) {
  const auto rows = static_cast<Eigen::Index>(buckling.panels.size());
  if (rows == 0) return;
  RowMajorMatrix table(rows, 15);
  std::vector<std::string> plates;
  for (Eigen::Index p = 0; p < rows; ++p) {
    const BuckledPanel& panel = buckling.panels[static_cast<std::size_t>(p)];
    const structure::Panel& of = panel.panel;
    const structure::PanelStress& s = panel.worst.stress;
    plates.push_back(of.plate);
    table.row(p) << of.centre_B.x(), of.centre_B.y(), of.centre_B.z(), of.size.a, of.size.b,
        of.size.a / of.fields_a, of.size.b / of.fields_b, of.size.thickness, s.s11, s.s22, s.s12,
        panel.worst.utilisation.critical, panel.worst.utilisation.elastic,
        panel.in_motion ? 1.0 : 0.0, panel.time.value_or(0);
  }
  file.write_texts(layout::join(layout::panels_group, "plates"), plates,
                   "name of the single plate of each panel, the nearest to buckling first");
  file.write_matrix(
      layout::join(layout::panels_group, "table"), table,
      {"1",
       "SI units, a panel a row: centre x, y, z in the block frame; sides a and b; sides of a "
       "field between stiffeners; thickness; mean membrane stresses 11, 22, 12; utilisation "
       "by Johnson-Ostenfeld, elastic; 1 in motion, 0 at rest; time"});
}

}  // namespace blocklift::pipeline
