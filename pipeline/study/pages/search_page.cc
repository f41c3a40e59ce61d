#include "pipeline/study/pages/search_page.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipeline/hydrodynamics/line_chart.h"
#include "pipeline/report/html.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

std::string with_unit(const StudyResults& results, const std::string& path, double value) {
  const ShownFigure figure = results.shown(path);
  return format_figure(figure.scale * value) + (figure.unit.empty() ? "" : " " + figure.unit);
}

const char* edge_text(int at_edge) {
  return at_edge < 0 ? "at its lowest" : at_edge > 0 ? "at its highest" : "";
}

const char* state_text(const BoundOfSearch& bound) {
  if (bound.is_exceeded) return bound.is_least ? "missed" : "exceeded";
  return bound.is_active ? "reached" : "";
}

/// "smallest ropes, R1, max static tension: 39.2 kN in member 31".
std::string found_text(const StudyResults& results) {
  const SearchResults& search = *results.search;
  return fmt::format("{} {}: {} in member {}", search.is_largest ? "largest" : "smallest",
                     results.shown(search.figure).name,
                     with_unit(results, search.figure, search.value), search.best);
}

std::vector<std::string> remarks(const StudyResults& results) {
  const SearchResults& search = *results.search;
  std::vector<std::string> texts;
  if (!search.is_feasible)
    texts.emplace_back("no member keeps to all bounds; this one exceeds them least");
  texts.emplace_back(
      search.is_converged
          ? "the search ended with steps of a thousandth of each range"
          : "not converged: the members ran out while the search still went on; give more");
  if (search.elsewhere)
    texts.push_back(fmt::format("a second search that began elsewhere ended at {}",
                                with_unit(results, search.figure, *search.elsewhere)));
  else
    texts.emplace_back("no second search from elsewhere: it may be the best of its neighbourhood");
  return texts;
}

std::string row(const std::vector<std::string>& texts, const char* tag) {
  std::string cells = "<tr>";
  for (const std::string& text : texts)
    cells += fmt::format("<{0}>{1}</{0}>", tag, escape_html(text));
  return cells + "</tr>\n";
}

std::string history_chart(const StudyResults& results) {
  const SearchResults& search = *results.search;
  const ShownFigure figure = results.shown(search.figure);
  Curve tried{"tried", {}, {}}, best{"best so far", {}, {}};
  const std::vector<double> so_far = best_so_far(results.study, search);
  for (const Member& member : search.members) {
    tried.x.push_back(member.number);
    best.x.push_back(member.number);
    best.y.push_back(figure.scale * so_far[member.number]);
    tried.y.push_back(figure.scale * member.figure(search.figure));
  }
  return to_svg({figure.name,
                 "member",
                 figure.unit.empty() ? "value" : figure.unit,
                 {std::move(tried), std::move(best)}});
}

/// A variable over the members that were tried.
std::string variable_chart(const StudyResults& results, std::size_t v) {
  const SearchResults& search = *results.search;
  Curve curve{"", {}, {}};
  for (Eigen::Index m = 0; m < search.design.rows(); ++m) {
    curve.x.push_back(static_cast<double>(m));
    curve.y.push_back(search.design(m, static_cast<Eigen::Index>(v)));
  }
  const StudyVariable& variable = results.study.variables[v];
  const std::string unit = unit_text(variable);
  return to_svg({variable.name.value, "member", unit.empty() ? "value" : unit, {std::move(curve)}});
}

}  // namespace

std::string search_text(const StudyResults& results) {
  const SearchResults& search = *results.search;
  std::string text = found_text(results) + "\n\n";
  TextTable values({{"value"}, {"best", 1}, {"", 0}});
  for (std::size_t v = 0; v < results.study.variables.size(); ++v)
    values.add_row({results.study.variables[v].name.value,
                    shown_value(results.study.variables[v],
                                search.design(search.best, static_cast<Eigen::Index>(v)), 5),
                    edge_text(search.at_edge[v])});
  text += values.text();
  if (!search.bounds.empty()) {
    TextTable bounds({{"bound"}, {"limit", 1}, {"value", 1}, {"", 0}});
    for (const BoundOfSearch& bound : search.bounds)
      bounds.add_row(
          {results.shown(bound.figure).name,
           (bound.is_least ? ">= " : "<= ") + with_unit(results, bound.figure, bound.limit),
           with_unit(results, bound.figure, bound.value), state_text(bound)});
    text += "\n" + bounds.text();
  }
  text += "\n";
  for (const std::string& remark : remarks(results)) text += remark + "\n";
  return text;
}

std::string search_section(const StudyResults& results) {
  const SearchResults& search = *results.search;
  std::string text = fmt::format("<h2>What was found</h2>\n<p><strong>{}</strong></p>\n<ul>\n",
                                 escape_html(found_text(results)));
  for (const std::string& remark : remarks(results))
    text += fmt::format("<li>{}</li>\n", escape_html(remark));
  text += fmt::format(
      "</ul>\n<p>The report of the best member: <a href=\"best/report.html\">best</a>. The first "
      "{} "
      "members are a sample over all ranges.</p>\n",
      search.first_sample);
  text += "<div class=\"scroll\"><table>\n" + row({"value", "best", "from", "to", ""}, "th");
  for (std::size_t v = 0; v < results.study.variables.size(); ++v) {
    const StudyVariable& variable = results.study.variables[v];
    const auto shown = [&](double value) { return shown_value(variable, value, 5); };
    text +=
        row({variable.name.value, shown(search.design(search.best, static_cast<Eigen::Index>(v))),
             shown(variable.between[0].value.value), shown(variable.between[1].value.value),
             edge_text(search.at_edge[v])},
            "td");
  }
  text += "</table></div>\n";
  if (!search.bounds.empty()) {
    text += "<h2>Bounds</h2>\n<div class=\"scroll\"><table>\n" +
            row({"figure", "limit", "value of the best", ""}, "th");
    for (const BoundOfSearch& bound : search.bounds)
      text += row({results.shown(bound.figure).name,
                   (bound.is_least ? "≥ " : "≤ ") + with_unit(results, bound.figure, bound.limit),
                   with_unit(results, bound.figure, bound.value), state_text(bound)},
                  "td");
    text += "</table></div>\n";
  }
  text += "<h2>How it was found</h2>\n<div class=\"charts\">\n" + history_chart(results);
  for (std::size_t v = 0; v < results.study.variables.size(); ++v)
    text += variable_chart(results, v);
  return text + "</div>\n";
}

}  // namespace blocklift::pipeline
