#include "pipeline/study/study_results.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/comparison/summary_figures.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_leading = 8;

/// Figures of every member that ran, in the order of the first.
std::vector<std::string> common_paths(const std::vector<Member>& members) {
  std::vector<std::string> paths;
  bool first = true;
  for (const Member& member : members) {
    if (!member.failure.empty()) continue;
    std::vector<std::string> own;
    for (const auto& [path, value] : member.figures) own.push_back(path);
    if (first) {
      paths = std::move(own);
    } else {
      std::sort(own.begin(), own.end());
      std::erase_if(paths, [&](const std::string& path) {
        return !std::binary_search(own.begin(), own.end(), path);
      });
    }
    first = false;
  }
  return paths;
}

/// The figures asked for that some of the members that ran do not have.
std::vector<std::pair<std::string, int>> find_left_out(const StudyFile& study,
                                                       const std::vector<Member>& members) {
  std::vector<std::pair<std::string, int>> left_out;
  for (const Located<std::string>& path : study.figures) {
    const auto lacking = std::ranges::count_if(members, [&](const Member& member) {
      return member.failure.empty() && std::isnan(member.figure(path.value));
    });
    if (lacking > 0) left_out.emplace_back(path.value, static_cast<int>(lacking));
  }
  return left_out;
}

/// Those that were asked for, or those that spread most for their size.
std::vector<std::size_t> choose_leading(const StudyFile& study,
                                        const std::vector<Spread>& spreads) {
  std::vector<std::size_t> chosen(spreads.size());
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  if (study.figures.empty()) {
    const auto relative = [&](std::size_t i) {
      const double size = std::max(std::abs(spreads[i].smallest), std::abs(spreads[i].largest));
      return size > 0 && spreads[i].varies ? spreads[i].deviation / size : 0;
    };
    std::stable_sort(chosen.begin(), chosen.end(),
                     [&](std::size_t a, std::size_t b) { return relative(a) > relative(b); });
  }
  chosen.resize(std::min(chosen.size(), most_leading));
  return chosen;
}

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

/// Limiting seas and what they allow of the study's tables.
void find_limits(StudyResults& results) {
  if (!results.study.limits) return;
  const SeaLimits& limits = *results.study.limits;
  results.limits = find_limiting_seas(results.study, results.design, results.members);
  results.alpha = read_alpha_factor(results.study);
  const auto operability = [&](const auto& name, bool is_forecast) -> std::optional<Operability> {
    if (!name) return std::nullopt;
    return find_operability(*results.limits,
                            read_sea_states(results.study.beside(name->value), is_forecast,
                                            results.limits->headings.size() > 1),
                            results.alpha, is_forecast);
  };
  results.in_scatter = operability(limits.scatter, false);
  results.in_forecast = operability(limits.forecast, true);
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

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string inside;
  for (const char c : text) inside += c == '"' ? "\"\"" : std::string(1, c);
  return '"' + inside + '"';
}

/// A failure of several lines as one, for a row is a line.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c == ' ' && line.ends_with("; ")) continue;
    line += c == '\n' ? std::string("; ") : std::string(1, c);
  }
  while (line.ends_with("; ")) line.resize(line.size() - 2);
  return line;
}

std::string csv_text(const StudyResults& results) {
  std::string text = "member";
  for (const StudyVariable& variable : results.study.variables) {
    const std::string unit = unit_text(variable);
    text += "," + quoted(unit.empty() ? variable.name.value
                                      : fmt::format("{} ({})", variable.name.value, unit));
  }
  const std::vector<std::string> columns = results.columns();
  for (const std::string& path : columns) text += "," + quoted(path);
  text += ",failure\n";
  for (const Member& member : results.members) {
    text += fmt::format("{}", member.number);
    for (const double value : results.design.row(member.number)) text += fmt::format(",{}", value);
    for (const std::string& path : columns) {
      const auto found = std::find_if(member.figures.begin(), member.figures.end(),
                                      [&](const auto& one) { return one.first == path; });
      text += found == member.figures.end() ? std::string(",") : fmt::format(",{}", found->second);
    }
    text += "," + quoted(on_one_line(member.failure)) + "\n";
  }
  return text;
}

void write_arrays(const StudyResults& results, const std::filesystem::path& path) {
  ResultsWriter file(path);
  std::vector<std::string> variables, units;
  const std::vector<std::string> paths = results.columns();
  for (const StudyVariable& variable : results.study.variables) {
    variables.push_back(variable.name.value);
    units.push_back(unit_text(variable));
  }
  RowMajorMatrix figures(static_cast<Eigen::Index>(results.members.size()),
                         static_cast<Eigen::Index>(paths.size()));
  figures.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t f = 0; f < paths.size(); ++f)
    for (std::size_t m = 0; m < results.members.size(); ++m)
      for (const auto& [name, value] : results.members[m].figures)
        if (name == paths[f])
          figures(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(f)) = value;
  file.write_text("/study/yaml", results.study.yaml, "the study's file");
  file.write_texts("/variables/names", variables, "what varies, a column each");
  file.write_texts("/variables/units", units, "of the columns, SI");
  file.write_matrix("/variables/values", results.design, {"1", "a member a row; SI units"});
  file.write_texts("/figures/names", paths, "places in summary.json, a column each");
  if (figures.size() > 0)
    file.write_matrix(
        "/figures/values", figures,
        {"1",
         "a member a row, units as the names say; nan: the member failed, or has no such figure"});
  file.finish();
}

}  // namespace

ShownFigure shown_figure(const std::string& path, const std::string& unit) {
  const std::string_view at_end = unit_of_path(path);
  ShownFigure figure{at_end.empty() ? path : path.substr(0, path.size() - at_end.size() - 1), unit,
                     1};
  static const std::map<std::string, std::pair<const char*, double>> shown_units{
      {"percent", {"%", 1}},  {"N", {"kN", 1e-3}},   {"N m", {"kN m", 1e-3}},
      {"Nm", {"kN m", 1e-3}}, {"Pa", {"MPa", 1e-6}}, {"rad", {"°", 180 / std::numbers::pi}}};
  if (const auto shown = shown_units.find(unit); shown != shown_units.end()) {
    figure.unit = shown->second.first;
    figure.scale = shown->second.second;
  }
  std::string name;
  for (const char c : figure.name) name += c == '.' ? ", " : std::string(1, c == '_' ? ' ' : c);
  if (const auto at = name.find("von mises"); at != std::string::npos) name[at + 4] = 'M';
  figure.name = std::move(name);
  return figure;
}

ShownFigure StudyResults::shown(const std::string& path) const {
  for (const Member& member : members)
    if (member.failure.empty()) return shown_figure(path, member.unit(path));
  return shown_figure(path, std::string(unit_of_path(path)));
}

std::vector<std::string> StudyResults::columns() const {
  std::vector<std::string> paths;
  for (const Spread& spread : spreads) paths.push_back(spread.path);
  for (const auto& [path, lacking] : left_out) paths.push_back(path);
  return paths;
}

bool StudyResults::is_sample() const {
  return study.design != StudyDesign::grid && study.design != StudyDesign::search;
}

int StudyResults::failed() const {
  return static_cast<int>(std::count_if(members.begin(), members.end(), [](const Member& member) {
    return !member.failure.empty();
  }));
}

bool StudyResults::is_worse_when_smaller(const std::string& path) const {
  return std::any_of(members.begin(), members.end(), [&](const Member& member) {
    return std::find(member.worse_when_smaller.begin(), member.worse_when_smaller.end(), path) !=
           member.worse_when_smaller.end();
  });
}

std::vector<double> StudyResults::values_of(const std::string& path) const {
  std::vector<double> values;
  for (const Member& member : members)
    for (const auto& [name, value] : member.figures)
      if (name == path) values.push_back(value);
  return values;
}

int StudyResults::independent() const {
  const auto all = static_cast<int>(members.size());
  return study.design == StudyDesign::sensitivity ? std::min(2 * study.members.value(), all) : all;
}

std::vector<double> StudyResults::sample_of(const std::string& path) const {
  std::vector<double> values;
  for (const Member& member : members)
    if (member.number < independent())
      for (const auto& [name, value] : member.figures)
        if (name == path) values.push_back(value);
  return values;
}

namespace {

/// Spread of a figure over the independent members. The smallest and the largest are of all: they
/// ran, and are looked at.
Spread spread_of(const StudyResults& results, const std::string& path) {
  std::vector<int> numbers, drawn;
  for (const Member& member : results.members) {
    if (!member.failure.empty()) continue;
    numbers.push_back(member.number);
    if (member.number < results.independent()) drawn.push_back(member.number);
  }
  const std::vector<double> all = results.values_of(path);
  if (drawn.empty()) drawn = numbers;
  const bool is_all = drawn.size() == numbers.size();
  Spread spread = find_spread(path, is_all ? all : results.sample_of(path), drawn, results.design,
                              results.is_worse_when_smaller(path));
  if (results.study.design != StudyDesign::search)
    spread.swings =
        find_swings(results.study, results.design, is_all ? all : results.sample_of(path), drawn);
  const auto smallest = std::min_element(all.begin(), all.end());
  const auto largest = std::max_element(all.begin(), all.end());
  spread.smallest = *smallest;
  spread.largest = *largest;
  spread.member_of_smallest = numbers[static_cast<std::size_t>(smallest - all.begin())];
  spread.member_of_largest = numbers[static_cast<std::size_t>(largest - all.begin())];
  return spread;
}

/// A figure of all members; not a number of those that failed.
Eigen::VectorXd figure_of_all(const StudyResults& results, const std::string& path) {
  Eigen::VectorXd figure(static_cast<Eigen::Index>(results.members.size()));
  for (const Member& member : results.members)
    figure[member.number] =
        member.failure.empty() ? member.figure(path) : std::numeric_limits<double>::quiet_NaN();
  return figure;
}

}  // namespace

StudyResults evaluate_study(StudyFile study, Eigen::MatrixXd design, std::vector<Member> members) {
  StudyResults results{
      std::move(study), std::move(design), std::move(members), {}, {}, {}, {}, {}, {}, {}};
  if (results.failed() == static_cast<int>(results.members.size()))
    throw std::runtime_error("no member of the study ran; the first says: " +
                             (results.members.empty() ? "" : results.members.front().failure));
  results.left_out = find_left_out(results.study, results.members);
  for (const std::string& path : common_paths(results.members))
    results.spreads.push_back(spread_of(results, path));
  find_limits(results);
  results.leading = choose_leading(results.study, results.spreads);
  if (results.study.design == StudyDesign::sensitivity)
    for (const std::size_t i : results.leading)
      results.sensitivities.push_back(
          find_sensitivity(results.design, figure_of_all(results, results.spreads[i].path),
                           results.study.members.value()));
  return results;
}

StudyResults evaluate_search(StudyFile study, SearchResults search) {
  StudyResults results = evaluate_study(std::move(study), search.design, search.members);
  results.search = std::move(search);
  return results;
}

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

std::string survivors_warning(const StudyResults& results) {
  const int failed = results.failed();
  if (failed == 0 || !results.is_sample()) return "";
  return fmt::format(
      "{} of {} members failed: all statistics are of those that ran, which may be the kinder ones",
      failed, results.members.size());
}

std::vector<std::string> left_out_warnings(const StudyResults& results) {
  std::vector<std::string> sentences;
  for (const auto& [path, lacking] : results.left_out)
    sentences.push_back(
        fmt::format("{} of {} members that ran have no figure {}: it has no statistics", lacking,
                    static_cast<int>(results.members.size()) - results.failed(), path));
  if (results.sensitivities.empty()) return sentences;
  const int complete = results.sensitivities.front().members;
  const int asked = results.study.members.value();
  if (complete < fewest_for_sobol_indices)
    sentences.push_back(
        fmt::format("there are no Sobol' indices: all lifts of {} of {} base members ran, and {} "
                    "are needed",
                    complete, asked, fewest_for_sobol_indices));
  else if (complete < asked)
    sentences.push_back(
        fmt::format("Sobol' indices are of {} of {} base members: of the others a lift failed",
                    complete, asked));
  return sentences;
}

std::vector<std::string> study_warnings(const StudyResults& results) {
  std::vector<std::string> warnings;
  for (const Member& member : results.members)
    if (!member.failure.empty())
      warnings.push_back(fmt::format("member {} failed: {}", member.number, member.failure));
  if (std::string warning = survivors_warning(results); !warning.empty())
    warnings.push_back(std::move(warning));
  std::ranges::move(left_out_warnings(results), std::back_inserter(warnings));
  return warnings;
}

std::string failure_of_run(const StudyResults& results) {
  constexpr double largest_share = 0.05;
  const int failed = results.failed();
  if (results.is_sample())
    return failed > largest_share * static_cast<double>(results.members.size())
               ? survivors_warning(results)
               : "";
  if (failed == 0 || results.limits || results.study.design == StudyDesign::search) return "";
  const auto first =
      std::ranges::find_if(results.members, [](const Member& one) { return !one.failure.empty(); });
  return fmt::format("{} of {} members of the grid failed; the first, member {}: {}", failed,
                     results.members.size(), first->number, first->failure);
}

std::vector<std::string> limiting_sentences(const StudyResults& results) {
  std::vector<std::string> sentences = sentences_of_failures(*results.limits);
  if (results.in_scatter)
    std::ranges::move(sentences_of_scatter(*results.in_scatter, results.alpha),
                      std::back_inserter(sentences));
  if (results.in_forecast)
    std::ranges::move(sentences_of_forecast(*results.in_forecast, results.alpha),
                      std::back_inserter(sentences));
  return sentences;
}

void write_study(const StudyResults& results, const std::filesystem::path& folder) {
  Preparation preparation(folder);
  const std::filesystem::path& aside = preparation.folder();
  write_file(aside / "study.csv", csv_text(results));
  write_arrays(results, aside / "study.h5");
  write_file(aside / "study.html", study_page(results));
  write_file(aside / "study.json", study_json(results).dump(2));
  preparation.move_into_place();
}

}  // namespace blocklift::pipeline
