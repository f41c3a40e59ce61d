#include "pipeline/comparison/expected_figures.h"

#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "pipeline/comparison/lasting_modes.h"
#include "pipeline/comparison/summary_figures.h"
#include "pipeline/declaration/document.h"
#include "pipeline/declaration/table.h"
#include "pipeline/declaration/text_file.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

void check_figure(const ExpectedFigure& figure, Reading& reading, const Mark& mark) {
  const int requirements = int{figure.value.has_value()} + int{figure.equals.has_value()} +
                           int{figure.at_least.has_value()} + int{figure.at_most.has_value()} +
                           int{figure.magnitude_at_most.has_value()};
  if (requirements != 1)
    reading.error(mark,
                  fmt::format("figure {} has {} requirements", figure.path,
                              requirements == 0 ? "no" : "several"),
                  {"one of value, equals, at_least, at_most and magnitude_at_most is due"});
  const int tolerances =
      int{figure.tolerance.has_value()} + int{figure.absolute_tolerance.has_value()};
  if (figure.value && tolerances != 1)
    reading.error(mark,
                  fmt::format("the value of {} has {}", figure.path,
                              tolerances == 0 ? "no tolerance" : "two tolerances"),
                  {"tolerance (a share of the value) or absolute_tolerance (in its unit) is due"});
  if (!figure.value && tolerances > 0)
    reading.error(mark, fmt::format("figure {} has a tolerance and no value", figure.path));
}

Format<ExpectedFigure> expected_figure_format() {
  return Table<ExpectedFigure>("expected figure",
                               "A figure of summary.json that a lift is held to.")
      .required("figure", &ExpectedFigure::path, text(),
                "its place in summary.json, with dots between keys and names of rows")
      .optional("value", &ExpectedFigure::value, number(), "what it is to be")
      .optional("tolerance", &ExpectedFigure::tolerance, number(Range::not_negative()),
                "how far from the value it may be, as a share of the value")
      .optional("absolute_tolerance", &ExpectedFigure::absolute_tolerance,
                number(Range::not_negative()), "the same in the figure's unit")
      .optional("equals", &ExpectedFigure::equals, text(), "what it is to be, exactly")
      .optional("at_least", &ExpectedFigure::at_least, number(), "its smallest value")
      .optional("at_most", &ExpectedFigure::at_most, number(), "its largest value")
      .optional("magnitude_at_most", &ExpectedFigure::magnitude_at_most,
                number(Range::not_negative()), "its largest size, either sign")
      .required("reason", &ExpectedFigure::reason, text(), "why it is held, and to this tolerance")
      .rule(check_figure)
      .format();
}

std::string text_of_value(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

double allowed_difference(const ExpectedFigure& figure) {
  return figure.tolerance ? *figure.tolerance * std::abs(*figure.value)
                          : *figure.absolute_tolerance;
}

/// Of a mode whose name has gone: those that the instant has, for who asks for another by it.
std::string names_of_modes(std::string_view path, const Json& summary) {
  constexpr std::string_view modes = ".modes.";
  const std::size_t at = path.find(modes);
  if (at == std::string_view::npos) return "";
  const Json* list = find_figure(summary, path.substr(0, at + modes.size() - 1));
  if (!list) return "";
  std::string names;
  for (const LastingMode& mode : lasting_modes(*list))
    if (mode.is_leading) names += (names.empty() ? "" : "; ") + mode.name;
  return names.empty() ? "" : ", whose modes then are: " + names;
}

/// What is wrong with a figure, in words; nothing if it is held.
std::optional<std::string> complaint_about(const ExpectedFigure& figure, const Json* found) {
  if (!found) return "is not in the summary";
  const auto is_instead = [](const std::string& is, const std::string& wanted) {
    return fmt::format("is {} instead of {}", is, wanted);
  };
  if (figure.equals) {
    if (text_of_value(*found) == *figure.equals) return std::nullopt;
    return is_instead(
        found->is_number() ? fmt::format("{:.10g}", found->get<double>()) : found->dump(),
        *figure.equals);
  }
  if (!found->is_number()) return is_instead(found->dump(), "a number");
  const auto number = found->get<double>();
  // Six digits read well; what is off by less is written to the ten that the tightest tolerance in
  // use asks for.
  const auto differs = [&](double from, const std::string& wanted) {
    const bool is_close = std::abs(number - from) < 1e-4 * std::abs(from);
    return is_instead(fmt::format("{:.{}g}", number, is_close ? 10 : 6), wanted);
  };
  if (figure.at_least && !(number >= *figure.at_least))
    return differs(*figure.at_least, fmt::format("at least {}", *figure.at_least));
  if (figure.at_most && !(number <= *figure.at_most))
    return differs(*figure.at_most, fmt::format("at most {}", *figure.at_most));
  if (figure.magnitude_at_most && !(std::abs(number) <= *figure.magnitude_at_most))
    return differs(std::copysign(*figure.magnitude_at_most, number),
                   fmt::format("at most {} either way", *figure.magnitude_at_most));
  if (figure.value && !(std::abs(number - *figure.value) <= allowed_difference(figure)))
    return differs(*figure.value,
                   fmt::format("{} within {:.4g}", *figure.value, allowed_difference(figure)));
  return std::nullopt;
}

/// To six digits: more would feign a precision that nobody needs. All of them where six would use
/// up a tenth of what the figure may differ by: it would not hold the very lift that it is taken
/// from.
/// @param figure whose tolerance counts.
double rounded_for(const ExpectedFigure& figure, double value) {
  const double rounded = std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
  ExpectedFigure held = figure;
  held.value = value;
  return std::abs(rounded - value) <= allowed_difference(held) / 10 ? rounded : value;
}

/// A scalar as it stands in a file: a number, true, false, or else a text.
Json scalar_json(const std::string& written) {
  Json value = Json::parse(written, nullptr, false);
  return value.is_number() || value.is_boolean() ? value : Json(written);
}

Json expected_figure_json(const ExpectedFigure& figure) {
  Json row{{"figure", figure.path}};
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (value) row[key] = *value;
  };
  add("value", figure.value);
  if (figure.equals) row["equals"] = scalar_json(*figure.equals);
  add("at_least", figure.at_least);
  add("at_most", figure.at_most);
  add("magnitude_at_most", figure.magnitude_at_most);
  add("tolerance", figure.tolerance);
  add("absolute_tolerance", figure.absolute_tolerance);
  row["reason"] = figure.reason;
  return row;
}

/// Scalars of JSON are scalars of YAML.
std::string yaml_text(const Json& row) {
  std::string text;
  for (const auto& [key, value] : row.items())
    text += fmt::format("{} {}: {}\n", text.empty() ? "-" : " ", key, value.dump());
  return text;
}

}  // namespace

std::vector<ExpectedFigure> read_expected_figures(const std::filesystem::path& file) {
  Diagnostics diagnostics;
  std::vector<ExpectedFigure> figures;
  if (const auto document = load_document(file, diagnostics)) {
    Reading reading(*document, diagnostics);
    list_of(expected_figure_format(), 1).read(document->root, reading, figures);
  }
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return figures;
}

std::vector<BrokenFigure> find_broken_figures(const std::vector<ExpectedFigure>& figures,
                                              const Json& summary) {
  std::vector<BrokenFigure> broken;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const Json* found = find_figure(summary, figures[i].path);
    if (const auto complaint = complaint_about(figures[i], found))
      broken.push_back(
          {i, found ? *complaint : *complaint + names_of_modes(figures[i].path, summary)});
  }
  return broken;
}

std::vector<ExpectedFigure> expect_figures(const Json& summary) {
  std::vector<ExpectedFigure> expected;
  for (const SummaryFigure& figure : list_figures(summary)) {
    const Json& found = *find_figure(summary, figure.path);
    ExpectedFigure one;
    one.path = figure.path;
    one.reason = figure.tolerance.reason;
    if (found.is_number()) {
      if (figure.tolerance.relative > 0)
        one.tolerance = figure.tolerance.relative;
      else
        one.absolute_tolerance = figure.tolerance.absolute;
      one.value = rounded_for(one, found.get<double>());
    } else {
      one.equals = text_of_value(found);
    }
    expected.push_back(std::move(one));
  }
  return expected;
}

std::vector<BrokenFigure> renew_figures(std::vector<ExpectedFigure>& figures, const Json& summary) {
  std::vector<BrokenFigure> renewed;
  for (BrokenFigure& broken : find_broken_figures(figures, summary)) {
    ExpectedFigure& figure = figures[broken.index];
    const Json* found = find_figure(summary, figure.path);
    if (!figure.value || !found || !found->is_number()) continue;
    figure.value = rounded_for(figure, found->get<double>());
    renewed.push_back(std::move(broken));
  }
  return renewed;
}

FigureSyntax syntax_of_figures(const std::filesystem::path& file) {
  Diagnostics diagnostics;
  const std::optional<TextFile> read = load_text(file, diagnostics);
  if (!read) throw InputError(diagnostics);
  return Json::accept(read->text) ? FigureSyntax::json : FigureSyntax::yaml;
}

std::string expected_figures_text(const std::vector<ExpectedFigure>& figures, FigureSyntax syntax) {
  std::string text;
  if (syntax == FigureSyntax::yaml) {
    for (const ExpectedFigure& figure : figures) text += yaml_text(expected_figure_json(figure));
    return text;
  }
  for (const ExpectedFigure& figure : figures)
    text += (text.empty() ? "" : ",\n") + ("  " + expected_figure_json(figure).dump());
  return "[\n" + text + (text.empty() ? "]\n" : "\n]\n");
}

}  // namespace blocklift::pipeline
