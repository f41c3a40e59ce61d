#include "pipeline/study/pages/study_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/study/design/study_design.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

/// What moves the leading figures most, by their swings.
std::string swings_text(const StudyResults& results) {
  constexpr std::size_t most_inputs = 3;
  TextTable table({{"figure"}, {""}, {"input"}, {"from"}, {"to"}, {"swing", 1}});
  for (const std::size_t i : results.leading) {
    const Spread& spread = results.spreads[i];
    const ShownFigure figure = results.shown(spread.path);
    std::vector<std::size_t> order = spread.swings.by_size();
    order.resize(std::min(order.size(), most_inputs));
    bool is_first = true;
    for (const std::size_t v : order) {
      const StudyVariable& variable = results.study.variables[v];
      const Swing& swing = spread.swings.of[v];
      if (!std::isfinite(swing.value) || !spread.varies) break;
      const double shown = figure.scale * swing.value;
      table.add_row({is_first ? figure.name : "", is_first ? figure.unit : "", variable.name.value,
                     shown_value(variable, swing.from, 4), shown_value(variable, swing.to, 4),
                     (shown > 0 ? "+" : "") + format_figure(shown, 3)});
      is_first = false;
    }
  }
  if (table.empty()) return "";
  return "\n" + table.text() +
         wrapped_sentence(
             "swing: how far the figure goes while this input alone goes through the middle 90 % "
             "of its values, by straight lines; study.html has all inputs");
}

}  // namespace

std::string study_text(const StudyResults& results) {
  if (results.limits) {
    std::string text = limiting_text(*results.limits);
    for (const std::string& sentence : limiting_sentences(results))
      text += wrapped_sentence(sentence);
    return text;
  }
  const bool is_sample = results.is_sample();
  std::vector<TableColumn> columns{{"figure"}, {"", 0}, {"mean", 1}, {"deviation", 1}};
  if (is_sample) columns.push_back({"95 %", 1});
  columns.insert(columns.end(), {{"worst", 1}, {"member", 6}});
  TextTable table(std::move(columns));
  bool is_too_small = false;
  for (const std::size_t i : results.leading) {
    const Spread& spread = results.spreads[i];
    const ShownFigure figure = results.shown(spread.path);
    const auto shown = [&](double value, int digits) {
      return format_figure(figure.scale * value, digits);
    };
    std::vector<TextTable::Cell> row{figure.name, figure.unit, shown(spread.mean, 4),
                                     shown(spread.deviation, 3)};
    const Quantile& quantile = spread.quantile_of_better(0.95);
    if (is_sample) row.emplace_back(shown(quantile.value, 4));
    row.emplace_back(shown(spread.worst(), 4));
    row.emplace_back(std::to_string(spread.member_of_worst()));
    table.add_row(std::move(row));
    is_too_small |=
        is_sample && !std::isfinite(spread.worse_when_smaller ? quantile.low : quantile.high);
  }
  std::string text = table.text();
  if (is_too_small)
    text += wrapped_sentence(
        fmt::format("so few lifts say little of their 95 % values: that of all such lifts may be "
                    "worse than the worst here; {} lifts or more give it an interval",
                    fewest_for_interval(0.95)));
  return text + swings_text(results);
}

}  // namespace blocklift::pipeline
