#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipeline/comparison/compared_blocks.h"
#include "pipeline/comparison/comparison.h"
#include "pipeline/formats/results/results_layout.h"
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
  if (comparison.moved.empty())
    return fmt::format("<p>No figure moved beyond its tolerance; figures that have one: {}.</p>\n",
                       comparison.held);
  std::string html = "<h2>Beyond tolerance</h2>\n<ul>\n";
  for (const MovedFigure& moved : comparison.moved)
    html += fmt::format("<li>{}</li>\n", escape_html(shown_move(comparison, moved)));
  return html + "</ul>\n";
}

std::string megapascals(double stress) {
  return std::isfinite(stress) ? fmt::format("{:.2f}", stress / 1e6) : "&ndash;";
}

/// Stresses of one state, each but the first with what it is more than the first.
void add_stresses(const std::vector<double>& stresses, std::vector<std::string>& row) {
  for (std::size_t i = 0; i < stresses.size(); ++i) {
    row.push_back(megapascals(stresses[i]));
    if (i == 0) continue;
    double more = (stresses[i] - stresses.front()) / 1e6;
    if (std::abs(more) < 0.005) more = 0;  // no "-0.00"
    row.push_back(std::isfinite(more) ? fmt::format("{:+.2f}", more) : "&ndash;");
  }
}

std::string stress_table(const ResultComparison& comparison, const ComparedBlocks& compared) {
  const StressByPart stresses = stress_by_part(comparison.results, compared);
  std::vector<HtmlColumn> columns{{stresses.is_checked ? "plate" : "part", true}};
  for (const char* when : {"at rest", "in motion"})
    for (std::size_t i = 0; i < compared.blocks.size(); ++i) {
      columns.push_back({comparison.results[compared.blocks[i].result].name + " " + when});
      if (i > 0) columns.push_back({"difference"});
    }
  HtmlRows rows;
  for (const PartStress& part : stresses.parts) {
    std::vector<std::string>& row = rows.rows.emplace_back();
    row.push_back(escape_html(part.part));
    add_stresses(part.at_rest, row);
    add_stresses(part.in_motion, row);
  }
  return html_table(stresses.is_checked
                        ? "Largest checked stress of each plate over the whole lift, MPa"
                        : "Largest raw stress of each part, MPa",
                    columns, {rows});
}

/// What the page says of the blocks without its script; the script adds the drawings.
std::string block_html(const ResultComparison& comparison, const ComparedBlocks& compared) {
  std::string html;
  for (const std::string& remark : remarks_on_blocks(comparison.results, compared))
    html += fmt::format("<p>{}</p>\n", escape_html(remark));
  if (!compared.blocks.empty()) html += stress_table(comparison, compared);
  return fmt::format("<h2>Stress of the block</h2>\n<div id=\"block\">{}</div>\n", html);
}

/// What the page draws: the blocks, and the tensions of every result.
Json page_data(const ResultComparison& comparison, const ComparedBlocks& compared) {
  Json results = Json::array();
  for (const ComparedResult& result : comparison.results) {
    const ResultsReader file(result.folder / layout::results_file);
    results.push_back({{"name", result.name},
                       {"static", tension_series(file, layout::static_history)},
                       {"dynamic", tension_series(file, layout::dynamic_history)}});
  }
  return {{"results", std::move(results)}, {"block", blocks_json(comparison.results, compared)}};
}

}  // namespace

std::string comparison_page(const ResultComparison& comparison) {
  const ComparedBlocks compared = compare_blocks(comparison.results);
  const std::string content = results_table(comparison) + tolerance_list(comparison) +
                              input_table(comparison) + figures_table(comparison) +
                              block_html(comparison, compared);
  // Only a page with drawings needs the library that draws them.
  return fill_page(compared.blocks.empty() ? curves_page_template() : comparison_page_template(),
                   {{"%TITLE%", escape_html(title_of(comparison)) + " – lifts compared"},
                    {"%HEADING%", "Lifts compared"},
                    {"%CONTENT%", content},
                    {"%DATA%", script_safe(page_data(comparison, compared))}});
}

}  // namespace blocklift::pipeline
