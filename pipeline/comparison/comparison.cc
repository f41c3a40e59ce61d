#include "pipeline/comparison/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "pipeline/report/input_values.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

/// Names in the order in which several lists bring them up; what only a later list has comes behind
/// its neighbour there.
class MergedNames {
 public:
  void begin_list() { place_ = 0; }
  void add(const std::string& name) {
    const auto known = std::find(names_.begin(), names_.end(), name);
    if (known != names_.end()) {
      place_ = static_cast<std::size_t>(known - names_.begin()) + 1;
    } else {
      names_.insert(names_.begin() + static_cast<std::ptrdiff_t>(place_++), name);
    }
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::size_t place_ = 0;
};

const InputText* find_file(const ComparedResult& result, const std::string& name) {
  const auto found = std::find_if(result.input.begin(), result.input.end(),
                                  [&](const InputText& file) { return file.name == name; });
  return found == result.input.end() ? nullptr : &*found;
}

bool are_alike(const std::vector<std::optional<std::string>>& values) {
  return std::all_of(values.begin(), values.end(),
                     [&](const auto& value) { return value == values.front(); });
}

bool say_the_same(const std::vector<std::optional<std::string>>& values) {
  return std::ranges::all_of(values, [&](const auto& value) {
    return value.has_value() == values.front().has_value() &&
           (!value || is_same_value(*value, *values.front()));
  });
}

/// The keys of a file that all results have.
void compare_keys(const std::string& file, const std::vector<const InputText*>& texts,
                  std::vector<InputDifference>& differences) {
  MergedNames keys;
  std::vector<std::map<std::string, std::string>> values(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    keys.begin_list();
    for (InputValue& value : list_input_values(texts[i]->yaml)) {
      keys.add(value.key);
      values[i].emplace(value.key, std::move(value.value));
    }
  }
  for (const std::string& key : keys.names()) {
    InputDifference row{file, key, {}};
    for (const auto& one : values) {
      const auto found = one.find(key);
      row.values.push_back(found == one.end() ? std::nullopt
                                              : std::optional<std::string>(found->second));
    }
    if (!say_the_same(row.values)) differences.push_back(std::move(row));
  }
}

std::vector<InputDifference> compare_input(const std::vector<ComparedResult>& results) {
  MergedNames files;
  const bool all_have_models =
      std::all_of(results.begin(), results.end(),
                  [](const ComparedResult& result) { return result.has_models; });
  for (const ComparedResult& result : results) {
    files.begin_list();
    for (const InputText& file : result.input)
      if (file.name.empty() || all_have_models) files.add(file.name);
  }
  std::vector<InputDifference> differences;
  for (const std::string& name : files.names()) {
    std::vector<const InputText*> texts;
    std::vector<std::optional<std::string>> presence;
    for (const ComparedResult& result : results) {
      texts.push_back(find_file(result, name));
      presence.push_back(texts.back() ? std::optional<std::string>("used") : std::nullopt);
    }
    if (are_alike(presence))
      compare_keys(name, texts, differences);
    else
      differences.push_back({name, "", std::move(presence)});
  }
  return differences;
}

/// What counts as zero among figures of one kind (ComparedFigure::rounding).
void set_rounding(std::vector<ComparedFigure>& figures) {
  constexpr double share = 1e-9;
  const auto kind_of = [](const ComparedFigure& figure) {
    return std::pair(figure.figure.group, figure.figure.unit);
  };
  std::map<std::pair<std::string, std::string>, double> largest;
  for (const ComparedFigure& figure : figures) {
    double& of_kind = largest[kind_of(figure)];
    for (const Json& value : figure.values)
      if (value.is_number()) of_kind = std::max(of_kind, std::abs(value.get<double>()));
  }
  for (ComparedFigure& figure : figures) figure.rounding = share * largest[kind_of(figure)];
}

/// All figures that one of the results has; groups stay together.
std::vector<ComparedFigure> compare_figures(const std::vector<ComparedResult>& results) {
  MergedNames groups, paths;
  std::map<std::string, SummaryFigure> figures;
  for (const ComparedResult& result : results) {
    groups.begin_list();
    paths.begin_list();
    for (SummaryFigure& figure : list_figures(result.summary)) {
      groups.add(figure.group);
      paths.add(figure.path);
      figures.emplace(figure.path, std::move(figure));
    }
  }
  std::vector<ComparedFigure> compared;
  for (const std::string& group : groups.names()) {
    for (const std::string& path : paths.names()) {
      if (figures.at(path).group != group) continue;
      ComparedFigure row{figures.at(path), {}};
      for (const ComparedResult& result : results) {
        const Json* found = find_figure(result.summary, path);
        row.values.push_back(found ? *found : Json());
      }
      compared.push_back(std::move(row));
    }
  }
  set_rounding(compared);
  return compared;
}

Exponents exponents_of(const ComparedFigure& figure) {
  const std::string unit(unit_of_path(figure.figure.path));
  if (unit.empty() || unit == "percent") return {};
  const std::optional<Measure> known = find_unit(unit);
  return known ? known->exponents : Exponents{};
}

/// Whether a tolerance means a figure: by its name and, if it is a difference, by its unit.
bool concerns(const Tolerance& tolerance, const ComparedFigure& figure) {
  return matches_figure(tolerance.name, figure.figure.path) &&
         (tolerance.is_share || tolerance.limit.exponents == exponents_of(figure));
}

/// Last keys of the figures without their units.
std::vector<std::string> short_names(const std::vector<ComparedFigure>& figures) {
  std::set<std::string> names;
  for (const ComparedFigure& figure : figures) {
    std::string_view path = figure.figure.path;
    const std::string_view unit = unit_of_path(path);
    if (!unit.empty()) path.remove_suffix(unit.size() + 1);
    names.emplace(path.substr(path.rfind('.') + 1));
  }
  return {names.begin(), names.end()};
}

/// Complains about tolerances that fit no figure, by their name or their unit.
void check_tolerances(const std::vector<Tolerance>& tolerances,
                      const std::vector<ComparedFigure>& figures, Diagnostics& diagnostics) {
  for (const Tolerance& tolerance : tolerances) {
    if (std::any_of(figures.begin(), figures.end(),
                    [&](const ComparedFigure& figure) { return concerns(tolerance, figure); }))
      continue;
    const auto named =
        std::find_if(figures.begin(), figures.end(), [&](const ComparedFigure& figure) {
          return matches_figure(tolerance.name, figure.figure.path);
        });
    if (named == figures.end()) {
      diagnostics.error(tolerance.mark, fmt::format("no figure has the name {}", tolerance.name),
                        {names_hint("the figures end in", short_names(figures), tolerance.name)});
      continue;
    }
    const std::string_view unit = unit_of_path(named->figure.path);
    diagnostics.error(
        tolerance.mark, fmt::format("the tolerance of {} is {}", tolerance.name, tolerance.text),
        {fmt::format("{} is {}; a share such as 2% fits as well", named->figure.path,
                     unit.empty() ? std::string("a pure number") : fmt::format("in {}", unit))});
  }
}

/// A share of zero allows nothing but rounding, however large it is.
bool is_share_of_zero(const ComparedFigure& figure, const Tolerance& tolerance) {
  return tolerance.is_share && !figure.is_in_percent() && figure.is_from_zero();
}

bool is_beyond(const ComparedFigure& figure, std::size_t result, const Tolerance& tolerance) {
  const Json& before = figure.values.front();
  const Json& now = figure.values[result];
  if (!before.is_number() || !now.is_number()) return before != now;
  const double difference = std::abs(*figure.difference(result));
  double allowed = tolerance.limit.value;
  if (is_share_of_zero(figure, tolerance))
    allowed = figure.rounding;
  else if (tolerance.is_share)
    allowed *= figure.is_in_percent() ? 100 : std::abs(before.get<double>());
  return !(difference <= allowed);
}

/// The last tolerance that means a figure counts.
void find_moved(ResultComparison& comparison) {
  for (std::size_t f = 0; f < comparison.figures.size(); ++f) {
    const ComparedFigure& figure = comparison.figures[f];
    std::size_t t = comparison.tolerances.size();
    while (t > 0 && !concerns(comparison.tolerances[t - 1], figure)) --t;
    if (t == 0) continue;
    ++comparison.held;
    for (std::size_t result = 1; result < figure.values.size(); ++result)
      if (is_beyond(figure, result, comparison.tolerances[t - 1]))
        comparison.moved.push_back({f, result, t - 1});
  }
}

}  // namespace

std::optional<double> ComparedFigure::change(std::size_t result) const {
  const std::optional<double> moved = difference(result);
  if (!moved || is_in_percent()) return moved;
  if (is_from_zero()) return std::nullopt;
  return 100 * *moved / std::abs(values.front().get<double>());
}

std::optional<double> ComparedFigure::difference(std::size_t result) const {
  if (!values.front().is_number() || !values[result].is_number()) return std::nullopt;
  return values[result].get<double>() - values.front().get<double>();
}

bool ComparedFigure::is_from_zero() const {
  return values.front().is_number() && std::abs(values.front().get<double>()) <= rounding;
}

ResultComparison compare_results(std::vector<ComparedResult> results,
                                 std::vector<Tolerance> tolerances) {
  ResultComparison comparison;
  comparison.input = compare_input(results);
  comparison.figures = compare_figures(results);
  comparison.results = std::move(results);
  Diagnostics diagnostics;
  check_tolerances(tolerances, comparison.figures, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  comparison.tolerances = std::move(tolerances);
  find_moved(comparison);
  return comparison;
}

std::string shown_value(const ComparedFigure& figure, const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) return "-";
  double largest = 0;
  for (const Json& one : figure.values)
    if (one.is_number()) largest = std::max(largest, std::abs(one.get<double>()));
  largest *= figure.figure.scale;
  const int decimals = largest > 0 && std::isfinite(largest)
                           ? std::clamp(4 - static_cast<int>(std::floor(std::log10(largest))), 0, 6)
                           : 0;
  return fmt::format("{:.{}f}", value.get<double>() * figure.figure.scale, decimals);
}

std::string shown_change(const ComparedFigure& figure, std::size_t result) {
  if (figure.values.front().is_string() && figure.values[result].is_string())
    return figure.values.front() == figure.values[result] ? "" : "differs";
  const std::optional<double> change = figure.change(result);
  if (!change) {
    const std::optional<double> moved = figure.difference(result);
    return moved && std::abs(*moved) > figure.rounding ? "from 0" : "";
  }
  // Less than half a unit of the last digit is no change, of either sign.
  const double shown = std::abs(*change) < 0.005 ? 0 : *change;
  // From a thousand on hundredths would say nothing and fill the column.
  const int decimals = std::abs(shown) < 999.995 ? 2 : 0;
  return fmt::format("{:+.{}f} {}", shown, decimals, figure.is_in_percent() ? "pt" : "%");
}

std::string shown_move(const ResultComparison& comparison, const MovedFigure& moved) {
  const ComparedFigure& figure = comparison.figures[moved.figure];
  const std::string change = shown_change(figure, moved.result);
  const auto in_words = [&](const Json& value) {
    return value.is_null() ? "nothing" : shown_value(figure, value);
  };
  const Tolerance& tolerance = comparison.tolerances[moved.tolerance];
  return fmt::format("{} of {}: {} instead of {}{}{}, beyond {}{}", figure.figure.path,
                     comparison.results[moved.result].name, in_words(figure.values[moved.result]),
                     in_words(figure.values.front()),
                     figure.figure.unit.empty() ? "" : " " + figure.figure.unit,
                     change.empty() ? "" : " (" + change + ")", tolerance.text,
                     is_share_of_zero(figure, tolerance) ? " of 0" : "");
}

}  // namespace blocklift::pipeline
