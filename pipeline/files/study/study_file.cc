#include "pipeline/files/study/study_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "algebra/factors.h"
#include "pipeline/declaration/document.h"
#include "pipeline/declaration/format_once.h"
#include "pipeline/declaration/reading.h"
#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using LawKind = SpreadLaw::Kind;

constexpr int most_members = 1'000'000;

/// What could not be read has been complained of, and no rule has anything to say of it.
bool is_read(const Located<Measure>& value) { return !std::isnan(value.value.value); }
bool is_read(const std::optional<Located<Measure>>& key) { return key && is_read(*key); }

/// What a law needs beside what it may have.
struct Needs {
  bool moments, bounds, mode;
};

Needs needs_of(LawKind kind) {
  if (kind == LawKind::uniform) return {false, true, false};
  if (kind == LawKind::triangular) return {false, true, true};
  return {true, false, false};
}

void check_law(const SpreadLaw& law, Reading& reading, const Mark& mark) {
  if (law.kind == LawKind::unknown) return;
  const Needs needs = needs_of(law.kind);
  const auto require = [&](bool is_due, const auto& key, const char* name) {
    if (is_due && !key) reading.error(mark, fmt::format("the law lacks its {}", name));
    return is_due && !key;
  };
  require(needs.moments, law.mean, "mean");
  require(needs.moments, law.deviation, "deviation");
  require(needs.bounds, law.lowest, "lowest");
  require(needs.bounds, law.highest, "highest");
  require(needs.mode, law.mode, "mode");
  const auto refuse = [&](bool is_due, const auto& key, const char* name) {
    if (!is_due && key)
      reading.error(key->mark, fmt::format("{} is no parameter of this law", name));
  };
  refuse(needs.moments, law.mean, "mean");
  refuse(needs.moments, law.deviation, "deviation");
  refuse(needs.mode, law.mode, "mode");
  const Measure* first = nullptr;
  for (const auto* key : {&law.mean, &law.deviation, &law.lowest, &law.highest, &law.mode}) {
    if (!is_read(*key)) continue;
    if (!first) first = &(*key)->value;
    if (!((*key)->value.exponents == first->exponents))
      reading.error((*key)->mark, "the values of a law are not all of one dimension");
  }
  if (is_read(law.deviation) && !(law.deviation->value.value > 0))
    reading.error(law.deviation->mark, "the deviation is not above zero");
  const bool has_bounds = is_read(law.lowest) && is_read(law.highest);
  if (has_bounds && !(law.lowest->value.value < law.highest->value.value))
    reading.error(law.highest->mark, "highest is not above lowest");
  const auto is_between = [&](const std::optional<Located<Measure>>& key, const char* name) {
    if (!is_read(key) || !has_bounds) return;
    if (key->value.value < law.lowest->value.value || key->value.value > law.highest->value.value)
      reading.error(key->mark, fmt::format("{} is not between lowest and highest", name));
  };
  is_between(law.mode, "mode");
  is_between(law.mean, "mean");
  if (law.kind == LawKind::lognormal && is_read(law.mean) && !(law.mean->value.value > 0))
    reading.error(law.mean->mark, "the mean of a lognormal value is not above zero");
}

Format<SpreadLaw> law_format() {
  Table<SpreadLaw> table("spread", "How a value is spread.");
  table.required("law", &SpreadLaw::kind, choice<LawKind>(SpreadLaw::kinds()), "its kind")
      .optional("mean", &SpreadLaw::mean, located(measure()),
                "of normal, lognormal, gumbel and weibull values, before they are cut off")
      .optional("deviation", &SpreadLaw::deviation, located(measure()),
                "standard deviation of these values before they are cut off")
      .optional("lowest", &SpreadLaw::lowest, located(measure()),
                "of uniform and triangular values; others are cut off there")
      .optional("highest", &SpreadLaw::highest, located(measure()),
                "of uniform and triangular values; others are cut off there")
      .optional("mode", &SpreadLaw::mode, located(measure()), "of triangular values")
      .rule(check_law)
      .place(&SpreadLaw::place);
  return table.format();
}

void check_variable(const StudyVariable& variable, Reading& reading, const Mark& mark) {
  const int told = (variable.values.empty() ? 0 : 1) + (variable.law ? 1 : 0) +
                   (variable.between.empty() ? 0 : 1);
  if (told != 1) reading.error(mark, "one of values, spread and between is due");
  // The first one's unit serves all: "3 m" behind "8 t" would be 3 kg.
  for (const Located<Measure>& value : variable.values)
    if (is_read(value) && is_read(variable.values.front()) &&
        !(value.value.exponents == variable.values.front().value.exponents))
      reading.error(value.mark, "the values of a variable are not all of one dimension");
  if (variable.between.size() != 2) return;
  const Located<Measure>&low = variable.between[0], &high = variable.between[1];
  if (!is_read(low) || !is_read(high)) return;
  if (!(low.value.exponents == high.value.exponents))
    reading.error(high.mark, "the two bounds are not of one dimension");
  else if (!(low.value.value < high.value.value))
    reading.error(high.mark, "the second bound is not above the first");
}

Format<StudyVariable> variable_format() {
  Table<StudyVariable> table("variable", "What varies in a study.");
  table
      .required("keys", &StudyVariable::keys, list_of(located(text()), 1),
                "keys of the case (ropes.R1.length) or of a model that it names "
                "(blocks/hull-860t:mass); all have the one value")
      .optional("values", &StudyVariable::values, list_of(located(measure()), 1),
                "which are taken in turn")
      .optional("spread", &StudyVariable::law, law_format(), "a law by which the value is spread")
      .optional("between", &StudyVariable::between, list_of(located(measure()), 2, 2),
                "of a search, the lowest and the highest value")
      .rule(check_variable)
      .place(&StudyVariable::place);
  return table.format();
}

Format<QuantityLimit> quantity_limit_format() {
  Table<QuantityLimit> table("limited figure", "A figure that a sea may bring to a value.");
  table
      .required("figure", &QuantityLimit::figure, located(text()),
                "of summary.json, ropes.H1.max_dynamic_tension_N or, with run: assess, the "
                "utilisation of a check")
      .required("at", &QuantityLimit::at, located(measure()),
                "its limit: the largest that is allowed, or the smallest of a clearance or margin");
  return table.format();
}

void check_bound(const FigureBound& bound, Reading& reading, const Mark& mark) {
  if (bound.at_most.has_value() == bound.at_least.has_value())
    reading.error(mark, "either at_most or at_least is due");
}

Format<FigureBound> figure_bound_format() {
  Table<FigureBound> table("bound of a figure", "A value that a figure may not pass in a search.");
  table
      .required("figure", &FigureBound::figure, located(text()),
                "of summary.json, ropes.H1.max_dynamic_tension_N or, with run: assess, the "
                "utilisation of a check")
      .optional("at_most", &FigureBound::at_most, located(measure()), "its largest value")
      .optional("at_least", &FigureBound::at_least, located(measure()), "its smallest value")
      .rule(check_bound);
  return table.format();
}

void check_alpha(const SeaLimits& limits, Reading& reading, const Mark& mark) {
  if (limits.alpha && limits.alpha_table)
    reading.error(limits.alpha->mark, "either alpha or alpha_table is due");
  if (limits.alpha_table && !limits.planned_period)
    reading.error(mark, "alpha_table needs the planned_period of the operation");
  if (limits.planned_period && !limits.alpha_table)
    reading.error(limits.planned_period->mark, "planned_period goes with alpha_table");
  if (limits.contingency && !(limits.planned_period && limits.forecast))
    reading.error(limits.contingency->mark,
                  "contingency goes with planned_period and a forecast, whose windows last both");
  if (limits.alpha_table && !limits.scatter && !limits.forecast)
    reading.error(limits.alpha_table->mark,
                  "alpha factors are of a scatter table or a forecast, and there is neither");
}

Format<SeaLimits> sea_limits_format() {
  Table<SeaLimits> table("sea limits",
                         "The significant height at which figures reach their limits, over peak "
                         "period and heading. Other variables of the study, seeds say, are "
                         "repetitions, of which the worst counts.");
  table
      .required("height", &SeaLimits::height, located(text()),
                "name of the variable that is the significant height")
      .required("period", &SeaLimits::period, located(text()),
                "name of the variable that is the peak period")
      .optional("heading", &SeaLimits::heading, located(text()),
                "name of the variable that is the heading")
      .required("of", &SeaLimits::quantities, list_of(quantity_limit_format(), 1),
                "figures that are limited; the least height counts")
      .optional("alpha", &SeaLimits::alpha, located(number(Range::between(0.01, 1))),
                "share of the limiting height that may be forecast (the alpha factor of "
                "DNV-ST-N001): 1 if left out without a table")
      .optional("alpha_table", &SeaLimits::alpha_table, located(text()),
                "in place of alpha, beside this file: CSV with the columns operation_period_h, "
                "significant_height_m (the limiting one) and alpha, each period with each height; "
                "linear between heights, of periods the next longer one")
      .optional("planned_period", &SeaLimits::planned_period,
                located(quantity(Dimension::time, Range::positive())),
                "of the operation, by which the table is entered")
      .optional("contingency", &SeaLimits::contingency,
                located(quantity(Dimension::time, Range::positive())),
                "time for what goes wrong: planned_period and this are the reference period "
                "(DNV-ST-N001), which a window of the forecast has to last")
      .optional("scatter", &SeaLimits::scatter, located(text()),
                "beside this file: CSV with the columns significant_height_m, peak_period_s, share "
                "and, if headings vary, heading_deg")
      .optional(
          "forecast", &SeaLimits::forecast, located(text()),
          "beside this file: CSV with the columns significant_height_m, peak_period_s, time_h "
          "and, if headings vary, heading_deg")
      .rule(check_alpha)
      .place(&SeaLimits::place);
  return table.format();
}

/// A key that two variables gave a value would have that of the last, and the other would do
/// nothing.
void check_keys(const StudyFile& study, Reading& reading) {
  std::map<std::string_view, std::string_view> varied_with;
  for (const StudyVariable& variable : study.variables)
    for (const Located<std::string>& key : variable.keys) {
      const auto [known, is_new] = varied_with.try_emplace(key.value, variable.name.value);
      if (!is_new)
        reading.error(key.mark,
                      fmt::format("{} varies already, with {}", key.value, known->second));
    }
}

/// A figure that is named twice is a slip: another one, or another value, may have been meant.
void check_figures_are_named_once(const std::vector<const Located<std::string>*>& figures,
                                  const char* where, Reading& reading) {
  std::map<std::string_view, int> lines;
  for (const Located<std::string>* figure : figures) {
    const auto [first, is_new] = lines.try_emplace(figure->value, figure->mark.line);
    if (!is_new)
      reading.error(figure->mark, fmt::format("{} is {} already, in line {}", figure->value, where,
                                              first->second));
  }
}

void check_figures(const StudyFile& study, Reading& reading) {
  std::vector<const Located<std::string>*> figures, limited, at_most, at_least;
  for (const Located<std::string>& figure : study.figures) figures.push_back(&figure);
  check_figures_are_named_once(figures, "among figures", reading);
  if (study.limits)
    for (const QuantityLimit& quantity : study.limits->quantities)
      limited.push_back(&quantity.figure);
  check_figures_are_named_once(limited, "limited", reading);
  // A figure may well have a bound on either side.
  for (const FigureBound& bound : study.subject_to)
    (bound.at_most ? at_most : at_least).push_back(&bound.figure);
  check_figures_are_named_once(at_most, "bounded by at_most", reading);
  check_figures_are_named_once(at_least, "bounded by at_least", reading);
}

/// The variable that a limit names, if it can be that.
void check_named_variable(const StudyFile& study, const std::optional<Located<std::string>>& name,
                          const Exponents& exponents, Reading& reading) {
  if (!name) return;
  for (const StudyVariable& variable : study.variables) {
    if (variable.name.value != name->value) continue;
    // All its values have one dimension: see check_variable.
    if (!variable.values.empty() && is_read(variable.values.front()) &&
        !(variable.values.front().value.exponents == exponents))
      reading.error(variable.values.front().mark, fmt::format("{} is due, for {} of the limits",
                                                              text_of(exponents), name->value));
    return;
  }
  reading.error(name->mark, fmt::format("no variable is called {}", name->value));
}

void check_limits(const StudyFile& study, Reading& reading) {
  if (!study.limits) return;
  const SeaLimits& limits = *study.limits;
  if (study.design != StudyDesign::grid && study.design != StudyDesign::unknown)
    reading.error(limits.place, "limits need design: grid");
  check_named_variable(study, limits.height, {1, 0, 0, 0}, reading);
  check_named_variable(study, limits.period, {0, 0, 1, 0}, reading);
  check_named_variable(study, limits.heading, {0, 0, 0, 1}, reading);
  for (const QuantityLimit& quantity : limits.quantities) {
    const auto is_it = [&](const auto& path) { return path.value == quantity.figure.value; };
    if (!study.figures.empty() && std::none_of(study.figures.begin(), study.figures.end(), is_it))
      reading.error(quantity.figure.mark, "the figure is limited, but not among figures");
  }
}

void check_search(const StudyFile& study, Reading& reading, const Mark& mark) {
  if (study.design == StudyDesign::unknown) return;
  const bool is_search = study.design == StudyDesign::search;
  const bool has_goal = study.minimise || study.maximise;
  if (is_search && study.minimise.has_value() == study.maximise.has_value())
    reading.error(mark, "a search needs minimise or maximise, and not both");
  if (!is_search && (has_goal || !study.subject_to.empty()))
    reading.error(mark, "minimise, maximise and subject_to go with design: search");
  for (const StudyVariable& variable : study.variables) {
    if (is_search && variable.between.empty())
      reading.error(variable.place, "a search takes between and no values or spread");
    if (!is_search && !variable.between.empty())
      reading.error(variable.place, "between goes with design: search");
  }
  const std::size_t least = 4 * (study.variables.size() + 1);
  if (is_search && study.members && *study.members > 0 &&
      static_cast<std::size_t>(*study.members) < least)
    reading.error(mark, fmt::format("a search over {} values needs {} members at least",
                                    study.variables.size(), least));
}

void check_correlation(const StudyCorrelation& correlation, Reading& reading, const Mark& mark) {
  if (correlation.of.size() == 2 && correlation.of[0].value == correlation.of[1].value)
    reading.error(mark, "a value is not correlated with itself");
  const CopulaKind kind = correlation.copula;
  if (kind == CopulaKind::unknown) return;
  const bool is_elliptical = kind == CopulaKind::normal || kind == CopulaKind::student;
  if (is_elliptical && correlation.is.has_value() == correlation.kendall.has_value())
    reading.error(mark, "either is or kendall is due");
  if (!is_elliptical && (correlation.is || !correlation.kendall))
    reading.error(mark, "this copula takes kendall, and no is");
  if ((kind == CopulaKind::student) != correlation.degrees.has_value())
    reading.error(mark, kind == CopulaKind::student ? "Student's copula lacks its degrees"
                                                    : "degrees go with copula: student");
  const double kendall = correlation.kendall.value_or(0.5);
  // One that cannot be read is not a number, and has been complained of.
  if ((kind == CopulaKind::clayton || kind == CopulaKind::gumbel) && kendall <= 0)
    reading.error(mark,
                  "Clayton's and Gumbel's copulas join values that are large together: kendall is "
                  "above zero",
                  {"frank, student and normal take values below zero, too"});
  if (kind == CopulaKind::frank && kendall == 0)
    reading.error(mark, "values that have nothing to do with each other need no correlation");
}

Format<StudyCorrelation> correlation_format() {
  Table<StudyCorrelation> table(
      "correlation",
      "Two values that are not independent of each other. The spread of each stays what it is: a "
      "copula joins them.");
  table
      .required("of", &StudyCorrelation::of, list_of(located(text()), 2, 2),
                "names of two variables that have a spread")
      .by_default("copula", &StudyCorrelation::copula,
                  choice<CopulaKind>({{"normal", CopulaKind::normal},
                                      {"student", CopulaKind::student},
                                      {"clayton", CopulaKind::clayton},
                                      {"gumbel", CopulaKind::gumbel},
                                      {"frank", CopulaKind::frank}}),
                  "normal",
                  "what joins them: extremes that come alone; together, of both ends; the small "
                  "together; the large together; alone, more so than normal. All but normal ones "
                  "join two values that have no other correlation")
      .optional("is", &StudyCorrelation::is, number(Range::between(-0.999, 0.999)),
                "of normal and student: correlation of the standard values behind the two; of "
                "normal laws, which are not cut off, that of the values themselves")
      .optional("kendall", &StudyCorrelation::kendall, number(Range::between(-0.99, 0.99)),
                "instead of it, and of the others: Kendall's tau, the probability that of two "
                "members one has more of both values, less that it has more of one alone")
      .optional("degrees", &StudyCorrelation::degrees, number(Range::between(1, 1000)),
                "of freedom, of student: the fewer, the more extremes come together")
      .rule(check_correlation)
      .place(&StudyCorrelation::place);
  return table.format();
}

/// What a correlation names: variables with a law, each pair once.
void check_correlated_variables(const StudyFile& study, Reading& reading) {
  std::vector<std::string> names;
  for (const StudyVariable& variable : study.variables)
    if (variable.law) names.push_back(variable.name.value);
  for (std::size_t i = 0; i < study.correlations.size(); ++i) {
    const auto& pair = study.correlations[i].of;
    for (const Located<std::string>& name : pair)
      if (std::find(names.begin(), names.end(), name.value) == names.end())
        reading.error(name.mark, fmt::format("no variable with a spread is called {}", name.value),
                      {names_hint("variables with a spread are", names, name.value)});
    for (std::size_t k = 0; k < i; ++k) {
      const auto& other = study.correlations[k].of;
      if ((pair[0].value == other[0].value && pair[1].value == other[1].value) ||
          (pair[0].value == other[1].value && pair[1].value == other[0].value)) {
        reading.error(study.correlations[i].place, "these two have a correlation already");
        continue;
      }
      if (study.correlations[i].copula == CopulaKind::normal &&
          study.correlations[k].copula == CopulaKind::normal)
        continue;
      for (const Located<std::string>& name : pair)
        if (name.value == other[0].value || name.value == other[1].value)
          reading.error(name.mark,
                        fmt::format("{} has another correlation: only normal copulas join more "
                                    "than two values",
                                    name.value));
    }
  }
}

void check_correlations(const StudyFile& study, Reading& reading) {
  if (study.correlations.empty()) return;
  const Mark& mark = study.correlations.front().place;
  if (study.design == StudyDesign::grid || study.design == StudyDesign::sensitivity ||
      study.design == StudyDesign::search)
    reading.error(mark, "correlations go with design: random, latin hypercube or low discrepancy");
  for (const StudyCorrelation& correlation : study.correlations)
    if (correlation.of.size() != 2) return;
  check_correlated_variables(study, reading);
  // What lies beyond its range, or is no number, has been complained of.
  if (std::ranges::any_of(study.correlations, [](const StudyCorrelation& one) {
        return !(std::abs(one.is.value_or(0)) < 1 && std::abs(one.kendall.value_or(0)) < 1);
      }))
    return;
  if (!algebra::CholeskyFactors(study.correlation_matrix()).is_positive())
    reading.error(mark,
                  "these correlations contradict each other: their matrix is not positive "
                  "definite");
}

/// On a grid a value that is there twice would run its members twice; where values are drawn it is
/// drawn twice as often.
void check_repeated_values(const StudyVariable& variable, Reading& reading) {
  for (std::size_t i = 0; i < variable.values.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (variable.values[i].value.value == variable.values[k].value.value) {
        reading.error(variable.values[i].mark, "this value is on the grid already");
        break;
      }
}

/// What draws nothing at random would read a seed and do nothing with it.
void check_seed(const StudyFile& study, Reading& reading) {
  const StudyDesign design = study.design;
  if (study.seed && (design == StudyDesign::grid || design == StudyDesign::search ||
                     design == StudyDesign::low_discrepancy))
    reading.error(study.seed->mark,
                  "this design draws nothing at random: seed goes with design: random, latin "
                  "hypercube and sensitivity");
}

void check_sensitivity(const StudyFile& study, Reading& reading, const Mark& mark) {
  if (study.design != StudyDesign::sensitivity) return;
  for (const StudyVariable& variable : study.variables)
    if (!variable.law) reading.error(variable.place, "Sobol' indices need a spread and no values");
  if (study.members && *study.members > 0 && *study.members < fewest_for_sobol_indices)
    reading.error(mark,
                  fmt::format("Sobol' indices need {} members at least; some hundred make them "
                              "sharp",
                              fewest_for_sobol_indices));
}

void check_study(const StudyFile& study, Reading& reading, const Mark& mark) {
  const bool is_grid = study.design == StudyDesign::grid;
  if (is_grid && study.members)
    reading.error(mark, "a grid has as many members as its values give; members goes with samples");
  if (!is_grid && study.design != StudyDesign::unknown && !study.members)
    reading.error(mark, "the number of members is missing");
  if (study.variables.empty()) reading.error(mark, "nothing varies");
  check_keys(study, reading);
  check_figures(study, reading);
  check_limits(study, reading);
  check_search(study, reading, mark);
  check_correlations(study, reading);
  check_seed(study, reading);
  check_sensitivity(study, reading, mark);
  double size = 1;
  for (const StudyVariable& variable : study.variables) {
    if (is_grid) check_repeated_values(variable, reading);
    if (is_grid && variable.law) reading.error(variable.place, "a grid takes values and no spread");
    size *= static_cast<double>(variable.values.size());
  }
  if (is_grid && size > most_members)
    reading.error(mark,
                  fmt::format("the grid has {:.0f} members; {} are allowed", size, most_members));
}

}  // namespace

const std::vector<std::pair<std::string, SpreadLaw::Kind>>& SpreadLaw::kinds() {
  static const std::vector<std::pair<std::string, Kind>> kinds{
      {"normal", Kind::normal},         {"lognormal", Kind::lognormal}, {"uniform", Kind::uniform},
      {"triangular", Kind::triangular}, {"gumbel", Kind::gumbel},       {"weibull", Kind::weibull}};
  return kinds;
}

Format<StudyFile> study_file_format() {
  Table<StudyFile> table("study", "Many lifts of one case, for `blocklift sweep`.");
  table.required("study", &StudyFile::name, name(), "its name")
      .optional("title", &StudyFile::title, text(), "for people")
      .required("case", &StudyFile::case_name, located(text()),
                "file or folder of the lift case, from this file's folder or the working folder")
      .by_default(
          "run", &StudyFile::run,
          choice<StudyRun>({{"simulate", StudyRun::simulate},
                            {"stress", StudyRun::stress},
                            {"assess", StudyRun::assess}}),
          "simulate",
          "motion alone; with the block's largest checked stress, on one mesh for all members; or "
          "all of an assessment, each on a mesh of its own")
      .by_default("design", &StudyFile::design,
                  choice<StudyDesign>({{"random", StudyDesign::random},
                                       {"latin hypercube", StudyDesign::latin_hypercube},
                                       {"low discrepancy", StudyDesign::low_discrepancy},
                                       {"grid", StudyDesign::grid},
                                       {"sensitivity", StudyDesign::sensitivity},
                                       {"search", StudyDesign::search}}),
                  "latin hypercube",
                  "how members are chosen: independently; each tenth, hundredth, ... of each "
                  "spread alike; by Sobol's sequence; every value with every other; for Sobol' "
                  "indices, members (n + 2) of n variables; towards the best of a figure")
      .optional("members", &StudyFile::members, integer(Range::between(1, most_members)),
                "how many lifts; of a sensitivity, the size of its samples; of a search, at most")
      .optional(
          "seed", &StudyFile::seed, located(integer(Range::between(0, 2'000'000'000))),
          "of the random numbers of a random design, a Latin hypercube or a sensitivity: 1 if "
          "left out")
      .required("vary", &StudyFile::variables, named_tables(variable_format()), "by name")
      .optional("correlations", &StudyFile::correlations, list_of(correlation_format(), 1),
                "of values with a spread; others are drawn independently")
      .optional("figures", &StudyFile::figures, list_of(located(text()), 1),
                "figures of summary.json that are looked at, ropes.R1.max_dynamic_tension_N; the "
                "usual ones of a comparison if left out")
      .optional("limits", &StudyFile::limits, sea_limits_format(),
                "which sea states the lift bears; of a grid")
      .optional("minimise", &StudyFile::minimise, located(text()),
                "of a search: the figure of summary.json that is to be small")
      .optional("maximise", &StudyFile::maximise, located(text()), "or that is to be large")
      .optional("subject_to", &StudyFile::subject_to, list_of(figure_bound_format(), 1),
                "of a search: what other figures keep to")
      .rule(check_study)
      .place(&StudyFile::place);
  return table.format();
}

double StudyCorrelation::coefficient() const {
  // Of any elliptical law (Lindskog, McNeil and Schmock 2003).
  return is ? *is : std::sin(std::numbers::pi / 2 * kendall.value_or(0));
}

Eigen::MatrixXd StudyFile::correlation_matrix() const {
  const auto size = static_cast<Eigen::Index>(variables.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
  const auto place_of = [&](const Located<std::string>& name) {
    return std::find_if(variables.begin(), variables.end(),
                        [&](const StudyVariable& one) { return one.name.value == name.value; }) -
           variables.begin();
  };
  for (const StudyCorrelation& correlation : correlations) {
    const Eigen::Index a = place_of(correlation.of[0]), b = place_of(correlation.of[1]);
    if (a >= size || b >= size || correlation.copula != CopulaKind::normal) continue;
    matrix(a, b) = matrix(b, a) = correlation.coefficient();
  }
  return matrix;
}

fs::path StudyFile::case_path() const {
  const fs::path beside = file.parent_path() / case_name.value;
  std::error_code ignored;
  return fs::exists(beside, ignored) ? beside : fs::path(case_name.value);
}

namespace {

/// A lift case is named as one, once, rather than held against the keys of a study, which has a
/// `case`, too.
bool is_lift_case(const Document& document) {
  const YAML::Node& root = document.root;
  return root.IsMap() && !root["study"] && !root["vary"] && root["case"] && root["load"];
}

}  // namespace

std::optional<StudyFile> read_study_file(const fs::path& path, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? path / "study.yaml" : path;
  const std::optional<Document> document = load_document(file, diagnostics);
  if (!document) return std::nullopt;
  if (is_lift_case(*document)) {
    diagnostics.error({document->file, 0, 0}, "this file describes a lift case, not a study",
                      {"blocklift assess runs it; blocklift new study writes a study of a case"});
    return std::nullopt;
  }
  StudyFile study;
  study.file = file;
  study.yaml = document->text;
  Reading reading(*document, diagnostics);
  format_once<study_file_format>().read(document->root, reading, study);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return study;
}

}  // namespace blocklift::pipeline
