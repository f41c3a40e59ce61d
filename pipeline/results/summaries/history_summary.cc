#include "pipeline/results/summaries/history_summary.h"

#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "pipeline/formats/json_values.h"

namespace blocklift::pipeline {

namespace {

using Json = nlohmann::ordered_json;

Json extreme_json(const HistoryExtreme& extreme) {
  Json json{{"value", json_number(extreme.at.value)},
            {"time_s", extreme.time},
            {"point_m", json_point(extreme.at.point_B)}};
  if (!extreme.at.part.empty()) json["part"] = extreme.at.part;
  if (!extreme.rope.empty()) {
    json["rope"] = extreme.rope;
    json["rope_share"] = extreme.share;
  }
  return json;
}

/// With the names that every state of the structure has, so that readers take it as one of them.
Json state_json(const HistoryState& state) {
  const HistoryExtreme& checked = state.checked_von_mises;
  Json json{{"checked_von_mises_Pa", json_number(checked.at.value)},
            {"field_von_mises_Pa", json_number(state.field_von_mises.at.value)},
            {"field_point_m", json_point(state.field_von_mises.at.point_B)},
            {"peak_von_mises_Pa", json_number(state.peak_von_mises.at.value)},
            {"max_displacement_m", json_number(state.displacement.at.value)},
            {"largest_principal_Pa", json_number(state.largest_principal.at.value)},
            {"smallest_principal_Pa", json_number(state.smallest_principal.at.value)},
            {"force_residual", state.largest_force_residual},
            {"moment_residual", state.largest_moment_residual},
            {"instants", state.time.size()},
            {"rope", checked.rope},
            {"rope_share", checked.share},
            {"time_s", checked.time},
            {"checked_group", checked.at.part},
            {"checked_point_m", json_point(checked.at.point_B)},
            {"peak_group", state.peak_von_mises.at.part},
            {"peak_point_m", json_point(state.peak_von_mises.at.point_B)},
            {"max_displacement_point_m", json_point(state.displacement.at.point_B)},
            {"max_displacement_time_s", state.displacement.time},
            {"peak", extreme_json(state.peak_von_mises)},
            {"largest_principal", extreme_json(state.largest_principal)},
            {"smallest_principal", extreme_json(state.smallest_principal)}};
  Json lugs = Json::array();
  for (const HistoryGroup& lug : state.lugs) {
    Json row{{"name", lug.name}};
    row.update(extreme_json(lug.checked_von_mises));
    lugs.push_back(row);
  }
  json["lugs"] = lugs;
  return json;
}

Json practice_json(const PracticeComparison& practice) {
  // What rounding leaves, which differs from one number of threads to another, is no shortfall.
  constexpr double rounding_percent = 1e-6;
  return {{"safe", practice.largest_percent >= -rounding_percent},
          {"largest_difference_percent", json_number(practice.largest_percent)},
          {"worst_difference_percent", json_number(practice.worst_percent)},
          {"worst_part", practice.worst.part},
          {"worst_point_m", json_point(practice.worst.point_B)},
          {"worst_envelope_Pa", practice.worst.value},
          {"share_of_patches_short", practice.squares_short}};
}

Json points_json(const std::vector<StressHistory>& points, double lifts) {
  Json rows = Json::array();
  for (const StressHistory& one : points) {
    double largest = 0, count = 0;
    for (const structure::Cycles& cycles : one.cycles) {
      largest = std::max(largest, cycles.range);
      count += cycles.count;
    }
    rows.push_back({{"name", one.name},
                    {"part", one.part},
                    {"point_m", json_point(one.point_B)},
                    {"max_static_von_mises_Pa", one.static_von_mises.maxCoeff()},
                    {"max_dynamic_von_mises_Pa", one.dynamic_von_mises.maxCoeff()},
                    {"cycles_per_lift", count},
                    {"largest_range_Pa", largest},
                    {"damage_per_lift", one.damage_per_lift},
                    {"damage", one.damage_per_lift * lifts}});
  }
  return rows;
}

Json hot_spots_json(const HistoryAssessment& history) {
  Json rows = points_json(history.hot_spots, history.lifts);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i]["largest_normal_Pa"] = history.hot_spots[i].dynamic_normal.maxCoeff();
    rows[i]["smallest_normal_Pa"] = history.hot_spots[i].dynamic_normal.minCoeff();
  }
  return rows;
}

}  // namespace

Json stage_stresses_json(const std::vector<StageStress>& stages) {
  Json rows = Json::array();
  for (const StageStress& stage : stages) {
    const std::optional<double>& increase = stage.increase_percent;
    rows.push_back({{"name", stage.stage},
                    {"start_s", stage.start},
                    {"end_s", stage.end},
                    {"static_checked_von_mises", extreme_json(stage.at_rest)},
                    {"dynamic_checked_von_mises", extreme_json(stage.in_motion)},
                    {"stress_increase_percent", increase ? Json(*increase) : Json()}});
  }
  return rows;
}

Json history_json(const HistoryAssessment& history) {
  return {{"static", state_json(history.static_state)},
          {"dynamic", state_json(history.dynamic_state)},
          {"stress_increase_percent", history.stress_increase_percent()},
          {"deformation_increase_percent", history.deformation_increase_percent()},
          {"places", history.dynamic_state.places},
          {"practice",
           {{"per_rope_maxima", practice_json(history.per_rope_maxima)},
            {"rope_instants", practice_json(history.rope_instants)}}},
          {"fatigue",
           {{"curve", history.curve.name},
            {"source", history.curve.source},
            {"stress_concentration", history.stress_concentration},
            {"lifts", history.lifts}}},
          {"points", points_json(history.points, history.lifts)},
          {"hot_spot_curve", history.hot_spot_curve.name},
          {"hot_spots", hot_spots_json(history)}};
}

}  // namespace blocklift::pipeline
