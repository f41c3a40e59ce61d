#include <fmt/format.h>

#include "pipeline/comparison/comparison.h"
#include "pipeline/formats/results_layout.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/report/html.h"
#include "pipeline/report/page_data.h"
#include "pipeline/report/page_template.h"
#include "pipeline/report/report_page.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

std::string title_of(const ResultComparison& comparison) {
  std::string title;
  for (const ComparedResult& result : comparison.results)
    title += (title.empty() ? "" : ", ") + result.name;
  return title;
}

std::string results_table(const ResultComparison& comparison) {
  HtmlRows rows;
  for (const ComparedResult& result : comparison.results)
    rows.rows.push_back({escape_html(result.name), escape_html(result.summary.value("title", "")),
                         escape_html(result.summary.value("created", "")),
                         escape_html(result.summary.value("program_version", ""))});
  return html_table("Results",
                    {{"result", true}, {"case", true}, {"made", true}, {"version", true}}, {rows});
}

std::string input_table(const ResultComparison& comparison) {
  if (comparison.input.empty()) return "<p>No key of the input differs.</p>\n";
  std::vector<HtmlColumn> columns{{"key", true}};
  for (const ComparedResult& result : comparison.results) columns.push_back({result.name, true});
  std::vector<HtmlRows> groups;
  for (const InputDifference& difference : comparison.input) {
    const std::string file = difference.file.empty() ? "case file" : difference.file;
    if (groups.empty() || groups.back().name != file) groups.push_back({file, {}});
    std::vector<std::string> row{difference.key.empty() ? std::string("the file")
                                                        : escape_html(difference.key)};
    for (const auto& value : difference.values)
      row.push_back(value ? escape_html(*value) : std::string("&ndash;"));
    groups.back().rows.push_back(std::move(row));
  }
  return html_table("Input that differs", columns, groups);
}

std::string figures_table(const ResultComparison& comparison) {
  std::vector<HtmlColumn> columns{{"figure", true}, {"unit", true}};
  for (std::size_t i = 0; i < comparison.results.size(); ++i) {
    columns.push_back({comparison.results[i].name});
    if (i > 0) columns.push_back({"change"});
  }
  std::vector<HtmlRows> groups;
  for (const ComparedFigure& figure : comparison.figures) {
    if (groups.empty() || groups.back().name != figure.figure.group)
      groups.push_back({figure.figure.group, {}});
    std::vector<std::string> row{escape_html(figure.figure.label), escape_html(figure.figure.unit)};
    for (std::size_t i = 0; i < comparison.results.size(); ++i) {
      row.push_back(escape_html(shown_value(figure, figure.values[i])));
      if (i > 0) row.push_back(escape_html(shown_change(figure, i)));
    }
    groups.back().rows.push_back(std::move(row));
  }
  return html_table("Figures; changes count from the first result", columns, groups);
}

std::string tolerance_list(const ResultComparison& comparison) {
  if (comparison.tolerances.empty()) return {};
  if (comparison.moved.empty()) return "<p>No figure moved beyond its tolerance.</p>\n";
  std::string html = "<h2>Beyond tolerance</h2>\n<ul>\n";
  for (const MovedFigure& moved : comparison.moved)
    html += fmt::format("<li>{}</li>\n", escape_html(shown_move(comparison, moved)));
  return html + "</ul>\n";
}

/// What the page draws: the tensions of every result.
Json page_data(const ResultComparison& comparison) {
  Json results = Json::array();
  for (const ComparedResult& result : comparison.results) {
    const ResultsReader file(result.folder / layout::results_file);
    results.push_back({{"name", result.name},
                       {"static", tension_series(file, layout::static_history)},
                       {"dynamic", tension_series(file, layout::dynamic_history)}});
  }
  return {{"results", std::move(results)}};
}

}  // namespace

std::string comparison_page(const ResultComparison& comparison) {
  const std::string content = results_table(comparison) + tolerance_list(comparison) +
                              input_table(comparison) + figures_table(comparison);
  return fill_page(comparison_page_template(),
                   {{"%TITLE%", escape_html(title_of(comparison)) + " – lifts compared"},
                    {"%HEADING%", "Lifts compared"},
                    {"%CONTENT%", content},
                    {"%DATA%", script_safe(page_data(comparison))}});
}

}  // namespace blocklift::pipeline
