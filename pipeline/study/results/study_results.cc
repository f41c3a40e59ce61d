#include "pipeline/study/results/study_results.h"

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

#include "pipeline/comparison/summary_figures.h"

namespace blocklift::pipeline {
namespace {

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
  spread.member_of_smallest = numbers[smallest - all.begin()];
  spread.member_of_largest = numbers[largest - all.begin()];
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

}  // namespace blocklift::pipeline
