#include "pipeline/checks/buckling_assessment.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/results/results_layout.h"
#include "pipeline/lift/stopwatch.h"

namespace blocklift::pipeline {

namespace {

using structure::BlockPanels;

constexpr std::size_t panels_in_summary = 40;

BlockPanels make_panels(const LiftCase& lift_case, const structure::UnitResponses& responses) {
  return {responses.model(), responses.displacements(),
          stiffening_beside_mesh(*lift_case.load.model)};
}

/// States of the block: factors of the unit responses, a column a state, and times if there are
/// any.
struct States {
  const Eigen::MatrixXd& factors;
  const Eigen::VectorXd* time = nullptr;  ///< s
};

double buckling_factor(const LiftCase& lift_case) {
  return lift_case.checks.buckling_factor.value_or(lift_case.checks.yield_factor);
}

/// Sorts by what `figure` says of each, the largest first.
template <class T, class Figure>
void sort_by(std::vector<T>& items, const Figure& figure) {
  std::stable_sort(items.begin(), items.end(),
                   [&](const T& a, const T& b) { return figure(a) > figure(b); });
}

/// The worse of static and dynamic states, bar by bar.
void find_bars(const structure::UnitResponses& responses, const BlockPanels& panels,
               const States& static_states, const States& dynamic_states,
               BucklingAssessment& result) {
  const structure::BlockBars bars(responses.model(), responses.displacements(), panels);
  result.unknown_rods = bars.unknown_rods();
  const auto at_rest = bars.find_worst(static_states.factors, result.bar_factor);
  const auto in_motion = bars.find_worst(dynamic_states.factors, result.bar_factor);
  const auto time_of = [&](bool moving, int instant) -> std::optional<double> {
    const Eigen::VectorXd* time = (moving ? dynamic_states : static_states).time;
    return time ? std::optional((*time)[instant]) : std::nullopt;
  };
  for (std::size_t b = 0; b < bars.spans().size(); ++b) {
    const auto& [column_at_rest, tripping_at_rest] = at_rest[b];
    const auto& [column_in_motion, tripping_in_motion] = in_motion[b];
    const bool moving = column_in_motion.utilisation >= column_at_rest.utilisation;
    const bool trips_moving = tripping_in_motion.utilisation >= tripping_at_rest.utilisation;
    BuckledBar bar{bars.spans()[b], moving ? column_in_motion : column_at_rest, moving, {}};
    bar.time = time_of(moving, bar.worst.instant);
    bar.tripping = trips_moving ? tripping_in_motion : tripping_at_rest;
    bar.trips_in_motion = trips_moving;
    bar.tripping_time = time_of(trips_moving, bar.tripping.instant);
    result.bars.push_back(std::move(bar));
  }
  sort_by(result.bars, [](const BuckledBar& bar) { return bar.worst.utilisation; });
}

/// The worse of static and dynamic states, panel by panel and bar by bar.
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
  sort_by(result.panels,
          [](const BuckledPanel& panel) { return panel.worst.utilisation.critical; });
  result.bar_factor = buckling_factor(lift_case);
  find_bars(responses, panels, static_states, dynamic_states, result);
  result.evaluation_s = watch.lap();
  return result;
}

std::string field_text(const structure::Panel& panel) {
  return fmt::format("{} at ({:.2f}, {:.2f}, {:.2f}) m, field of {:.2f} x {:.2f} m, {:g} mm",
                     panel.plate, panel.centre_B.x(), panel.centre_B.y(), panel.centre_B.z(),
                     panel.size.a / panel.fields_a, panel.size.b / panel.fields_b,
                     1000 * panel.size.thickness);
}

std::string ends_text(const structure::BarSpan& span) {
  return fmt::format("{} from ({:.2f}, {:.2f}, {:.2f}) m to ({:.2f}, {:.2f}, {:.2f}) m", span.bar,
                     span.p_BFrom.x(), span.p_BFrom.y(), span.p_BFrom.z(), span.p_BTo.x(),
                     span.p_BTo.y(), span.p_BTo.z());
}

std::string span_text(const BuckledBar& bar) {
  const structure::BarSpan& span = bar.span;
  const std::string rule =
      span.plate_width > 0
          ? fmt::format("with {:.0f} mm of plate, EN 1993-1-5, 4.5.3", 1000 * span.plate_width)
          : "EN 1993-1-1, 6.3.1.1, curve c";
  return fmt::format("{}; {}, moments growing by EN 1993-1-1, 5.2.2(5)", ends_text(span), rule);
}

std::string tripping_text(const BuckledBar& bar) {
  const structure::BarSpan& span = bar.span;
  return fmt::format("{}; {}DNV-RP-C201, 7.5.2: elastic {:.0f} MPa, strength {:.0f} MPa",
                     ends_text(span),
                     span.has_tripping_brackets()
                         ? fmt::format("tripping brackets every {:.2f} m; ", span.tripping_length)
                         : "",
                     span.tripping_stress / 1e6, span.tripping_strength / 1e6);
}

/// A line for each name of stiffeners: the span that is nearest to tripping.
void check_tripping(const BucklingAssessment& buckling, std::vector<Check>& checks) {
  std::vector<BuckledBar> bars = buckling.bars;
  std::erase_if(bars, [](const BuckledBar& bar) { return !(bar.span.tripping_strength > 0); });
  sort_by(bars, [](const BuckledBar& bar) { return bar.tripping.utilisation; });
  std::set<std::string> seen;
  for (const BuckledBar& bar : bars) {
    if (!seen.insert(bar.span.group).second) continue;
    Check check = check_at_most(fmt::format("tripping of stiffeners in {}: compression, times {:g}",
                                            bar.span.group, buckling.bar_factor),
                                bar.tripping.utilisation, 1, "1");
    check.time = bar.tripping_time;
    check.note = tripping_text(bar);
    check.is_by_mesh = true;
    checks.push_back(std::move(check));
  }
}

}  // namespace

std::vector<structure::PlateStiffening> stiffening_beside_mesh(const BlockModel& block) {
  std::vector<structure::PlateStiffening> stiffening;
  for (const PlateModel& plate : block.plates) {
    if (!plate.stiffeners || plate.stiffeners->profile) continue;
    const auto along = static_cast<Eigen::Index>(plate.stiffeners->along);
    const Eigen::Matrix3d axes = plate.corners
                                     ? structure::frame_of_polygon(plate.corners->value).axes
                                     : Eigen::Matrix3d::Identity();
    stiffening.push_back({plate.name.value, axes.col(along), plate.stiffeners->spacing});
  }
  return stiffening;
}

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
  const double factor = buckling_factor(lift_case);
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
  seen.clear();
  for (const BuckledBar& bar : buckling.bars) {
    const std::string_view kind = bar.span.plate_width > 0 ? "stiffeners" : "bars";
    if (!seen.insert(fmt::format("{} in {}", kind, bar.span.group)).second) continue;
    Check check =
        check_at_most(fmt::format("buckling of {} in {}: compression with bending, times {:g}",
                                  kind, bar.span.group, buckling.bar_factor),
                      bar.worst.utilisation, 1, "1");
    check.time = bar.time;
    check.note = span_text(bar);
    check.is_by_mesh = true;
    checks.push_back(std::move(check));
  }
  check_tripping(buckling, checks);
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
             {"free_edges_along_sides", {of.free.along_a, of.free.along_b}},
             {"s11_Pa", stress.s11},
             {"s22_Pa", stress.s22},
             {"s12_Pa", stress.s12},
             {"s11_gradient_Pa", stress.s11_gradient},
             {"s22_gradient_Pa", stress.s22_gradient},
             {"utilisation", panel.worst.utilisation.critical},
             {"elastic_utilisation", panel.worst.utilisation.elastic},
             {"state", panel.in_motion ? "dynamic" : "static"}};
    if (panel.time) row["time_s"] = *panel.time;
    json["panels"].push_back(std::move(row));
  }
  if (buckling.bars.empty() && buckling.unknown_rods == 0) return json;
  json["bars_looked_at"] = buckling.bars.size();
  json["rods_without_second_moments"] = buckling.unknown_rods;
  json["bar_factor"] = buckling.bar_factor;
  json["bars"] = Json::array();
  for (const BuckledBar& bar : buckling.bars) {
    if (json["bars"].size() == panels_in_summary) break;
    const structure::BarSpan& span = bar.span;
    Json row{{"bar", span.bar},
             {"from_m", {span.p_BFrom.x(), span.p_BFrom.y(), span.p_BFrom.z()}},
             {"to_m", {span.p_BTo.x(), span.p_BTo.y(), span.p_BTo.z()}},
             {"plate_width_m", span.plate_width},
             {"buckling_length_m", span.column.length},
             {"compression_N", bar.worst.forces.compression},
             {"moments_Nm", bar.worst.forces.moments},
             {"buckling_resistance_N", structure::buckling_resistance(span.column)},
             {"utilisation", bar.worst.utilisation},
             {"state", bar.in_motion ? "dynamic" : "static"}};
    if (bar.time) row["time_s"] = *bar.time;
    if (span.tripping_strength > 0) {
      row["tripping_length_m"] = span.tripping_length;
      row["tripping_stress_Pa"] = span.tripping_stress;
      row["tripping_strength_Pa"] = span.tripping_strength;
      row["tripping_compression_Pa"] = bar.tripping.compression;
      row["tripping_utilisation"] = bar.tripping.utilisation;
    }
    json["bars"].push_back(std::move(row));
  }
  return json;
}

namespace {

void write_bars(ResultsWriter& file, const BucklingAssessment& buckling) {
  const auto rows = static_cast<Eigen::Index>(buckling.bars.size());
  if (rows == 0) return;
  RowMajorMatrix table(rows, 19);
  std::vector<std::string> names;
  for (Eigen::Index b = 0; b < rows; ++b) {
    const BuckledBar& bar = buckling.bars[b];
    const structure::BarSpan& span = bar.span;
    const structure::ColumnForces& forces = bar.worst.forces;
    names.push_back(span.bar);
    table.row(b) << span.p_BFrom.x(), span.p_BFrom.y(), span.p_BFrom.z(), span.p_BTo.x(),
        span.p_BTo.y(), span.p_BTo.z(), span.plate_width, span.column.length, forces.compression,
        forces.moments[0], forces.moments[1], structure::buckling_resistance(span.column),
        bar.worst.utilisation, bar.in_motion ? 1.0 : 0.0, bar.time.value_or(0),
        span.tripping_stress, span.tripping_strength, bar.tripping.compression,
        bar.tripping.utilisation;
  }
  file.write_texts(layout::join(layout::columns_group, "bars"), names,
                   "name of the bar or stiffener of each span, the nearest to buckling first");
  file.write_matrix(
      layout::join(layout::columns_group, "table"), table,
      {"1",
       "SI units, a span a row: its ends x, y, z in the block frame; width of the plate that "
       "buckles with it, 0 of a free bar; buckling length; compression "
       "(negative: pulled); moments about the section's principal axes; buckling resistance; "
       "utilisation under forces times the factor; 1 in motion, 0 at rest; time; of a stiffener "
       "its elastic stress of tripping, its strength, its compression times the factor and their "
       "ratio, 0 of a free bar"});
}

}  // namespace

void write_buckling(ResultsWriter& file, const BucklingAssessment& buckling) {
  write_bars(file, buckling);
  const auto rows = static_cast<Eigen::Index>(buckling.panels.size());
  if (rows == 0) return;
  RowMajorMatrix table(rows, 15);
  std::vector<std::string> plates;
  for (Eigen::Index p = 0; p < rows; ++p) {
    const BuckledPanel& panel = buckling.panels[p];
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
