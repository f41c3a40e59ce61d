#include "pipeline/study/pages/study_json.h"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "pipeline/study/design/study_design.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json spread_json(const StudyFile& study, const Spread& spread) {
  Json quantiles = Json::array(), extremes = Json::array(), correlations = Json::object();
  for (const Quantile& quantile : spread.quantiles)
    quantiles.push_back({{"share", quantile.share},
                         {"value", quantile.value},
                         {"low", number_or_null(quantile.low)},
                         {"high", number_or_null(quantile.high)}});
  for (const ExtremeFit& fit : spread.extremes)
    extremes.push_back({{"law", fit.law},
                        {"share", fit.share},
                        {"value", number_or_null(fit.value)},
                        {"low", number_or_null(fit.low)},
                        {"high", number_or_null(fit.high)},
                        {"p_value", fit.p_value}});
  for (std::size_t v = 0; v < study.variables.size(); ++v)
    correlations[study.variables[v].name.value] = spread.rank_correlation[v];
  Json swings = Json::object();
  for (const std::size_t v : spread.swings.by_size()) {
    const Swing& swing = spread.swings.of[v];
    swings[study.variables[v].name.value] = {{"from", swing.from},
                                             {"to", swing.to},
                                             {"swing", number_or_null(swing.value)},
                                             {"low", number_or_null(swing.low)},
                                             {"high", number_or_null(swing.high)}};
  }
  return {{"name", spread.path},
          {"worse_when", spread.worse_when_smaller ? "smaller" : "larger"},
          {"mean", spread.mean},
          {"deviation", number_or_null(spread.deviation)},
          {"smallest", spread.smallest},
          {"member_of_smallest", spread.member_of_smallest},
          {"largest", spread.largest},
          {"member_of_largest", spread.member_of_largest},
          {"worst", spread.worst()},
          {"member_of_worst", spread.member_of_worst()},
          {"quantiles", std::move(quantiles)},
          {"extremes", std::move(extremes)},
          {"rank_correlation", std::move(correlations)},
          {"swings", std::move(swings)},
          {"linear_share", number_or_null(spread.swings.linear_share)}};
}

Json sensitivity_json(const StudyFile& study, const Sensitivity& sensitivity) {
  Json json = Json::object();
  for (std::size_t v = 0; v < study.variables.size(); ++v) {
    const auto i = static_cast<Eigen::Index>(v);
    json[study.variables[v].name.value] = {
        {"first", number_or_null(sensitivity.first[i])},
        {"first_low", number_or_null(sensitivity.first_low[i])},
        {"first_high", number_or_null(sensitivity.first_high[i])},
        {"total", number_or_null(sensitivity.total[i])},
        {"total_low", number_or_null(sensitivity.total_low[i])},
        {"total_high", number_or_null(sensitivity.total_high[i])}};
  }
  return json;
}

Json operability_json(const Operability& operability, const AlphaFactor& alpha) {
  Json windows = Json::array(), holes = Json::array();
  for (const Operability::Window& window : operability.windows) {
    windows.push_back({{"begin_h", window.begin}, {"end_h", window.end}});
    if (alpha.is_of_table()) windows.back()["holds_plan"] = window.holds(alpha.reference_period());
  }
  for (const Operability::Window& hole : operability.holes)
    holes.push_back({{"begin_h", hole.begin}, {"end_h", hole.end}});
  return {{"share", operability.share},
          {"share_beyond_periods", operability.beyond_periods},
          {"share_beyond_headings", operability.beyond_headings},
          {"windows", std::move(windows)},
          {"holes", std::move(holes)}};
}

Json limits_json(const StudyResults& results) {
  const LimitingSeas& seas = *results.limits;
  Json states = Json::array();
  for (std::size_t p = 0; p < seas.periods.size(); ++p)
    for (std::size_t h = 0; h < seas.headings.size(); ++h) {
      const std::size_t cell = p * seas.headings.size() + h;
      const LimitingHeight& limit = seas.heights[cell];
      const bool is_known = limit.kind != LimitKind::unknown;
      Json state{{"peak_period_s", seas.periods[p]},
                 {"heading_rad", seas.headings[h]},
                 {"significant_height_m", is_known ? Json(limit.height) : Json(nullptr)},
                 {"known_as", name_of(limit.kind)},
                 {"governed_by", seas.governing[cell]},
                 {"alpha", is_known ? Json(results.alpha.at(limit.height)) : Json(nullptr)}};
      if (seas.failed[cell] >= 0) state["failed_member"] = seas.failed[cell];
      states.push_back(std::move(state));
    }
  Json json{{"sea_states", std::move(states)}};
  if (results.alpha.is_of_table()) {
    json["alpha_row_h"] = results.alpha.row_period();
    json["reference_period_h"] = results.alpha.reference_period();
  } else {
    json["alpha"] = results.alpha.at(0);
  }
  if (results.in_scatter) json["scatter"] = operability_json(*results.in_scatter, results.alpha);
  if (results.in_forecast) json["forecast"] = operability_json(*results.in_forecast, results.alpha);
  return json;
}

Json search_json(const StudyResults& results) {
  const SearchResults& search = *results.search;
  Json values = Json::object(), bounds = Json::array();
  for (std::size_t v = 0; v < results.study.variables.size(); ++v)
    values[results.study.variables[v].name.value] = {
        {"value", search.design(search.best, static_cast<Eigen::Index>(v))},
        {"unit", unit_text(results.study.variables[v])},
        {"at_edge", search.at_edge[v] < 0   ? "lowest"
                    : search.at_edge[v] > 0 ? "highest"
                                            : "no"}};
  for (const BoundOfSearch& bound : search.bounds)
    bounds.push_back({{"figure", bound.figure},
                      {bound.is_least ? "at_least" : "at_most", bound.limit},
                      {"value", number_or_null(bound.value)},
                      {"is_active", bound.is_active},
                      {"is_exceeded", bound.is_exceeded}});
  Json json{{"figure", search.figure},
            {"sought", search.is_largest ? "largest" : "smallest"},
            {"is_feasible", search.is_feasible},
            {"is_converged", search.is_converged},
            {"member", search.best},
            {"value", number_or_null(search.value)},
            {"variables", std::move(values)},
            {"bounds", std::move(bounds)},
            {"first_sample", search.first_sample}};
  json["elsewhere"] = search.elsewhere ? Json(*search.elsewhere) : Json(nullptr);
  return json;
}

}  // namespace

Json study_json(const StudyResults& results) {
  Json figures = Json::array(), sensitivities = Json::object(), failures = Json::array();
  for (const Spread& spread : results.spreads) {
    figures.push_back(spread_json(results.study, spread));
    if (results.is_sample()) continue;
    figures.back()["quantiles"] = Json::array();
    figures.back()["extremes"] = Json::array();
  }
  for (std::size_t i = 0; i < results.sensitivities.size(); ++i)
    sensitivities[results.spreads[results.leading[i]].path] =
        sensitivity_json(results.study, results.sensitivities[i]);
  for (const Member& member : results.members)
    if (!member.failure.empty())
      failures.push_back({{"member", member.number}, {"failure", member.failure}});
  Json json{{"study", results.study.name},           {"title", results.study.title},
            {"case", results.study.case_name.value}, {"members", results.members.size()},
            {"failures", std::move(failures)},       {"figures", std::move(figures)}};
  if (const std::string warning = survivors_warning(results); !warning.empty())
    json["warning"] = warning;
  if (const auto left_out = left_out_warnings(results); !left_out.empty())
    json["left_out"] = left_out;
  if (!results.sensitivities.empty()) json["sobol_indices"] = std::move(sensitivities);
  if (results.limits) json["limits"] = limits_json(results);
  if (results.search) json["search"] = search_json(results);
  return json;
}

}  // namespace blocklift::pipeline
