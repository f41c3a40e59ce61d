#include <variant>

#include <fmt/format.h>

#include "pipeline/measurement/measured_lift.h"
#include "pipeline/measurement/measured_tables.h"
#include "pipeline/report/html.h"
#include "pipeline/report/page_data.h"
#include "pipeline/report/page_template.h"
#include "pipeline/report/report_page.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

std::string cell_html(const TableColumn& column, const TextTable::Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return escape_html(*text);
  return escape_html(format_figure(std::get<double>(cell), column.digits));
}

std::string table_html(const MeasuredTable& table) {
  std::vector<HtmlColumn> columns;
  for (const TableColumn& column : table.columns)
    columns.push_back({column.heading, column.digits == 0});
  HtmlRows rows;
  for (const auto& row : table.rows) {
    std::vector<std::string>& cells = rows.rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      cells.push_back(cell_html(table.columns[i], row[i]));
  }
  return html_table(table.caption, columns, {rows});
}

std::string doubts_html(const MeasuredLift& lift) {
  std::string html;
  for (const std::string& doubt : lift.doubts)
    html += fmt::format("<p><strong>Warning:</strong> {}.</p>\n", escape_html(doubt));
  return html;
}

/// The same form as the data of a comparison of results: two of them, measured and computed.
Json curves(const MeasuredLift& lift) {
  Json measured = Json::array();
  Json computed = Json::array();
  for (const HeldChannel& channel : lift.channels) {
    measured.push_back(page_series(channel.name, "values", {channel.unit, ""},
                                   channel.measured.time, channel.measured.values));
    const TimeSeries& theirs = channel.computed.in_motion;
    computed.push_back(
        page_series(channel.name, "values", {channel.unit, ""}, theirs.time, theirs.values));
  }
  const auto result = [](const char* name, Json series) -> Json {
    return {{"name", name}, {"static", Json::array()}, {"dynamic", std::move(series)}};
  };
  Json data{{"heading", "Measured and computed"}, {"results", Json::array()}};
  data["results"].push_back(result("computed", std::move(computed)));
  data["results"].push_back(result("measured", std::move(measured)));
  return data;
}

}  // namespace

std::string measured_page(const MeasuredLift& lift) {
  std::string content = doubts_html(lift);
  for (const MeasuredTable& table : measured_tables(lift)) content += table_html(table);
  if (const std::string remark = weighing_remark(lift); !remark.empty())
    content += fmt::format("<p>{}.</p>\n", escape_html(remark));
  return fill_page(curves_page_template(),
                   {{"%TITLE%", escape_html(lift.result.name) + " – measured and computed"},
                    {"%HEADING%", "Measured and computed"},
                    {"%CONTENT%", content},
                    {"%DATA%", script_safe(curves(lift))}});
}

}  // namespace blocklift::pipeline
