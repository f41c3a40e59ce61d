#include "pipeline/report/front.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/report/check_groups.h"
#include "pipeline/report/figures.h"
#include "pipeline/report/html.h"
#include "pipeline/report/input_values.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;
namespace f = figures;

/// A value of a table; null where there is none.
const Json& at(const Json& table, const char* key) {
  static const Json none;
  if (!table.is_object()) return none;
  const auto found = table.find(key);
  return found == table.end() ? none : *found;
}

std::string text_at(const Json& table, const char* key) {
  const Json& value = at(table, key);
  return value.is_string() ? value.get<std::string>() : "";
}

std::string escaped_at(const Json& table, const char* key) {
  return escape_html(text_at(table, key));
}

bool is_met(const Json& check) {
  const Json& pass = at(check, "pass");
  return pass.is_boolean() && pass.get<bool>();
}

// ----------------------------------------------------------------------------- document

constexpr std::pair<const char*, const char*> document_rows[] = {
    {"project", "Project"},   {"client", "Client"},   {"revision", "Revision"},
    {"prepared", "Prepared"}, {"checked", "Checked"}, {"approved", "Approved"}};

std::string document_table(const Json& data) {
  const Json& document = at(data["summary"], "document");
  const Json& lift_case = data["case"];
  std::string html = "<dl class=\"document\">";
  const auto row = [&](const char* name, const std::string& value) {
    html +=
        fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, value.empty() ? f::missing : value);
  };
  for (const auto& [key, name] : document_rows) row(name, escaped_at(document, key));
  row("Case", escaped_at(lift_case, "name"));
  row("Made",
      escaped_at(lift_case, "created") + ", Blocklift " + escaped_at(lift_case, "program_version"));
  row("Hash of the input", "<code>" + escaped_at(lift_case, "hash") + "</code>");
  if (const std::string page = escaped_at(data["summary"], "mesh_page"); !page.empty())
    row("Mesh of the block",
        fmt::format("<a href=\"{}\">what was read and what was found in it</a>", page));
  return html + "</dl>\n";
}

// ------------------------------------------------------------------------------ verdict

std::string bar_html(const Json& check) {
  const Json& utilisation = at(check, "utilisation");
  if (!utilisation.is_number()) return f::missing;
  constexpr double full = 1.25;             // the bar ends at 125 %, so that an excess shows
  constexpr double beyond_any_limit = 999;  // stands for a rope that has gone slack
  const double value = utilisation.get<double>();
  return fmt::format(
      "<span class=\"utilisation\"><span class=\"bar\" aria-hidden=\"true\"><span class=\"{}\" "
      "style=\"width:{:.1f}%\"></span><span class=\"limit\" style=\"left:{:.0f}%\"></span></span>"
      "<span class=\"value\">{}</span></span>",
      is_met(check) ? "fill" : "fill failed", 100 * std::clamp(value / full, 0.0, 1.0), 100 / full,
      value < beyond_any_limit ? f::share(utilisation) : "beyond any limit");
}

/// "82 to 90 %" below the bar of a check that the block's mesh gave; one figure where both round
/// alike.
std::string band_html(const Json& check) {
  const Json& band = at(check, "utilisation_band");
  if (!band.is_array() || band.size() != 2) return "";
  const std::string lower = f::share(band[0]), upper = f::share(band[1]);
  return lower == upper
             ? fmt::format("<span class=\"note band\">{} by the mesh</span>", lower)
             : fmt::format("<span class=\"note band\">{} to {} by the mesh</span>", lower, upper);
}

std::string mark_html(const Json& check) {
  return is_met(check) ? "<span class=\"mark pass\">pass</span>"
                       : "<span class=\"mark fail\">fail</span>";
}

std::string demand_html(const Json& check) {
  const std::string unit = text_at(check, "unit");
  const f::Quantity demand = f::in_report_unit(at(check, "demand"), unit);
  const f::Quantity limit = f::in_report_unit(at(check, "limit"), unit);
  return fmt::format("<span class=\"demand\">{} of {} {}</span>", demand.text, limit.text,
                     escape_html(limit.unit));
}

std::string verdict_sentence(const Json& checks) {
  const auto failed =
      std::count_if(checks.begin(), checks.end(), [](const Json& check) { return !is_met(check); });
  if (checks.empty()) return "The case asks for no checks.";
  if (failed > 0)
    return fmt::format("{} of {} checks {} not met.", failed, checks.size(),
                       failed == 1 ? "is" : "are");
  return checks.size() == 1 ? "The one check is met."
                            : fmt::format("All {} checks are met.", checks.size());
}

std::string list_html(const Json& texts, const char* style_class) {
  if (!texts.is_array() || texts.empty()) return "";
  std::string html = fmt::format("<ul class=\"{}\">", style_class);
  for (const Json& text : texts)
    if (text.is_string()) html += "<li>" + escape_html(text.get<std::string>()) + "</li>";
  return html + "</ul>\n";
}

std::string verdict_html(const Json& summary) {
  if (!summary.contains("verdict")) return "";
  const bool pass = text_at(summary, "verdict") == "pass";
  const Json& checks = at(summary, "checks");
  const std::string indicative = escaped_at(summary, "indicative");
  std::string html = fmt::format(
      "<div class=\"verdict {}\"><div class=\"word\">{}{}</div><div class=\"why\">"
      "<p class=\"sentence\">{}</p>",
      pass ? "pass" : "fail", pass ? "Pass" : "Fail",
      indicative.empty() ? "" : "<span class=\"indicative\">indicative</span>",
      verdict_sentence(checks.is_array() ? checks : Json::array()));
  if (const Json* governing = governing_check(checks))
    html +=
        fmt::format("<div class=\"governing\"><span><b>Governing: </b>{}</span>{}{}</div>",
                    escaped_at(*governing, "name"), demand_html(*governing), bar_html(*governing));
  if (!indicative.empty()) html += "<p>Indicative only: " + indicative + ".</p>";
  if (const Json& reasons = at(summary, "verdict_reasons"); !pass && reasons.size() > 1)
    html += list_html(reasons, "reasons");
  return html + "</div></div>\n";
}

// -------------------------------------------------------------------------- key figures

std::string figure_html(const std::string& label, const std::string& value, const char* unit,
                        const std::string& detail) {
  return fmt::format(
      "<div class=\"figure\"><div class=\"label\">{}</div><div class=\"value\">{}<span "
      "class=\"unit\">{}</span></div><div class=\"detail\">{}</div></div>",
      label, value, unit, detail);
}

/// The load with the largest value; none if none has it.
const Json* largest(const Json& loads, const char* key) {
  const Json* best = nullptr;
  if (!loads.is_array()) return best;
  for (const Json& load : loads) {
    if (!at(load, key).is_number()) continue;
    if (!best || at(load, key).get<double>() > at(*best, key).get<double>()) best = &load;
  }
  return best;
}

/// Ropes from a hook or to a lug carry the load; warps, tag lines and the like do neither.
bool carries_load(const Json& rope) { return rope.contains("lug") || rope.contains("hoist"); }

/// Those that carry the load, or the others.
Json ropes_that(const Json& ropes, bool carry) {
  Json some = Json::array();
  if (!ropes.is_array()) return some;
  for (const Json& rope : ropes)
    if (carries_load(rope) == carry) some.push_back(rope);
  return some;
}

std::string rope_figures(const Json& ropes) {
  const Json carrying = ropes_that(ropes, true), others = ropes_that(ropes, false);
  const bool has_load = !carrying.empty();
  const Json& shown = has_load ? carrying : others;
  std::string html;
  /// "; other ropes up to 17.5 tonnes in W1" where they are not what the figure is about.
  const auto beside = [&](const char* key, const auto& text) -> std::string {
    const Json* rope = has_load ? largest(others, key) : nullptr;
    return rope ? fmt::format("<br>other ropes up to {} in {}", text(at(*rope, key)),
                              escaped_at(*rope, "name"))
                : "";
  };
  const auto load = [&](const char* label, const char* value, const char* time) {
    const Json* rope = largest(shown, value);
    if (!rope) return;
    const Json& when = at(*rope, time);
    html += figure_html(
        label, f::kilonewtons(at(*rope, value)), "kN",
        fmt::format(
            "{} tonnes in {}{}{}", f::tonnes(at(*rope, value)), escaped_at(*rope, "name"),
            when.is_number() ? " at " + f::fixed(when, 1) + " s" : "",
            beside(value, [](const Json& newtons) { return f::tonnes(newtons) + " tonnes"; })));
  };
  load("Largest rope load, static", "max_static_tension_N", "time_of_max_static_s");
  load("Largest rope load, dynamic", "max_dynamic_tension_N", "time_of_max_dynamic_s");
  constexpr const char* ratio = "dynamic_over_static";
  if (const Json* rope = largest(shown, ratio))
    html += figure_html("Dynamic over static, worst rope", f::fixed((*rope)[ratio], 3), "",
                        "rope " + escaped_at(*rope, "name") +
                            beside(ratio, [](const Json& value) { return f::fixed(value, 3); }));
  return html;
}

/// The last refinement's change of the checked stress: the band in which it stands.
std::string band_text(const Json& structure) {
  const Json& accuracy = at(structure, "accuracy");
  const std::size_t meshes = at(accuracy, "steps").size();
  if (meshes == 0) return "";
  if (meshes == 1) return "one mesh only: how far it moves with the mesh is not known";
  return fmt::format("the stress within {}\u00a0%, by which the last of {} meshes moved it",
                     f::fixed(at(accuracy, "stress_change"), 1, 100), meshes);
}

/// The same increase by the ways that know less than every instant, and as published.
std::string beside(const Json& summary, const char* increase) {
  const Json& structure = at(summary, "structure");
  std::string text;
  const auto add = [&](const char* name, const Json& value, int decimals) {
    if (value.is_number())
      text += (text.empty() ? "" : ", ") + fmt::format("{} {}", name, f::change(value, decimals));
  };
  if (structure.contains("history"))
    add("at the ropes' maxima", at(at(structure, "simultaneous"), increase), 1);
  if (structure.contains("simultaneous"))
    add("per-rope maxima", at(at(structure, "per_rope_maxima"), increase), 1);
  add("published", at(at(summary, "comparison"), increase), 2);
  return text;
}

std::string block_figures(const Json& summary) {
  const Json& structure = at(summary, "structure");
  const char* const names[] = {"history", "simultaneous", "per_rope_maxima"};
  const bool is_table = structure.contains("load_table");  // which has no instants
  const char* const of_names[] = {
      ", the whole lift", is_table ? ", loads of the table" : ", worst instant of a rope's maximum",
      ", per-rope maxima"};
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& way = at(structure, names[i]);
    if (!way.is_object()) continue;
    const Json& still = at(way, "static");
    const Json& moving = at(way, "dynamic");
    // An increase compares two instants, where it is one of instants.
    const auto instants = [&](const char* key) -> std::string {
      if (at(still, key).is_number() && at(moving, key).is_number())
        return fmt::format(", each at its worst instant: {} and {} s", f::fixed(at(still, key), 1),
                           f::fixed(at(moving, key), 1));
      return i == 1 && !is_table ? ", each at its worst instant" : "";
    };
    const auto lines = [](const std::string& first, const std::string& second) {
      return second.empty() ? first : fmt::format("{}<br>{}", first, second);
    };
    std::string html = figure_html(
        std::string("Block stress increase") + of_names[i],
        f::change(at(way, "stress_increase_percent")), "",
        lines(lines(fmt::format("{} to {} MPa", f::megapascals(at(still, "checked_von_mises_Pa")),
                                f::megapascals(at(moving, "checked_von_mises_Pa"))) +
                        instants("time_s"),
                    beside(summary, "stress_increase_percent")),
              band_text(structure)));
    html += figure_html(
        std::string("Block deformation increase") + of_names[i],
        f::change(at(way, "deformation_increase_percent")), "",
        lines(fmt::format("{} to {} mm", f::millimetres(at(still, "max_displacement_m")),
                          f::millimetres(at(moving, "max_displacement_m"))) +
                  instants("max_displacement_time_s"),
              beside(summary, "deformation_increase_percent")));
    return html;
  }
  return "";
}

// ------------------------------------------------------------------------------- checks

bool is_timed(const Json& checks) {
  return std::any_of(checks.begin(), checks.end(),
                     [](const Json& check) { return at(check, "time_s").is_number(); });
}

std::vector<HtmlColumn> check_columns(bool timed) {
  std::vector<HtmlColumn> columns{{"Check", true}, {"Demand"}, {"Limit"}, {"Unit", true}};
  if (timed) columns.push_back({"At, s"});
  columns.push_back({"Utilisation", true});
  columns.push_back({"Result", true});
  return columns;
}

std::vector<std::string> check_row(const Json& check, bool timed, const std::string& beside_name) {
  const std::string unit = text_at(check, "unit");
  const f::Quantity demand = f::in_report_unit(at(check, "demand"), unit);
  const f::Quantity limit = f::in_report_unit(at(check, "limit"), unit);
  std::string name = escaped_at(check, "name");
  if (const std::string note = escaped_at(check, "note"); !note.empty())
    name += "<span class=\"note\">" + note + "</span>";
  if (!beside_name.empty()) name += "<span class=\"note\">" + escape_html(beside_name) + "</span>";
  std::vector<std::string> row{name, demand.text, limit.text, escape_html(limit.unit)};
  if (timed) row.push_back(f::fixed(at(check, "time_s"), 1));
  row.push_back(bar_html(check) + band_html(check));
  row.push_back(mark_html(check));
  return row;
}

}  // namespace

std::string front_html(const Json& data) {
  const Json& summary = data["summary"];
  const std::string title = escaped_at(data["case"], "title");
  return fmt::format(
      "<header id=\"verdict\"><p class=\"kicker\">{}</p>\n<h1>{}</h1>\n{}{}"
      "<div class=\"figures\">{}{}</div>\n{}</header>\n",
      summary.contains("verdict") ? "Lift assessment" : "Simulation",
      title.empty() ? escaped_at(data["case"], "name") : title, document_table(data),
      verdict_html(summary), rope_figures(at(summary, "ropes")), block_figures(summary),
      list_html(at(summary, "warnings"), "warnings"));
}

std::string checks_html(const Json& data) {
  const Json& checks = at(data["summary"], "checks");
  if (!checks.is_array() || checks.empty()) return "";
  const bool timed = is_timed(checks);
  HtmlRows rows;
  for (const CheckGroup& group :
       group_checks(checks, text_at(at(data["summary"], "standard"), "name"))) {
    const std::size_t failed =
        static_cast<std::size_t>(std::count_if(group.checks.begin(), group.checks.end(),
                                               [](const Json* check) { return !is_met(*check); }));
    const std::size_t shown = std::max<std::size_t>(failed, 1);
    for (std::size_t i = 0; i < shown; ++i)
      rows.rows.push_back(check_row(
          *group.checks[i], timed,
          i + 1 < shown || group.checks.size() == shown
              ? ""
              : fmt::format("governing of {} checks: {}", group.checks.size(), group.name)));
  }
  return "<section id=\"checks\"><h2>Checks</h2>\n"
         "<p class=\"lead\">The most utilised check of each group, and all that are not met; "
         "<a href=\"#annex-checks\">every check</a> stands in the annex.</p>\n" +
         html_table("Governing checks, demand against limit", check_columns(timed), {rows},
                    "checks") +
         "</section>\n";
}

std::string annex_html(const Json& data) {
  std::string html;
  if (const Json& checks = at(data["summary"], "checks"); checks.is_array() && !checks.empty()) {
    const bool timed = is_timed(checks);
    std::vector<HtmlRows> groups;
    for (const CheckGroup& group :
         group_checks(checks, text_at(at(data["summary"], "standard"), "name"))) {
      HtmlRows rows{group.name, {}};
      for (const Json* check : group.checks) rows.rows.push_back(check_row(*check, timed, ""));
      groups.push_back(std::move(rows));
    }
    html +=
        "<h3 id=\"annex-checks\">Checks</h3>\n" +
        html_table("Every check, by group and utilisation", check_columns(timed), groups, "checks");
  }
  HtmlRows values;
  for (const InputValue& value : list_input_values(text_at(data["case"], "yaml")))
    values.rows.push_back(
        {"<code>" + escape_html(value.key) + "</code>", escape_html(value.value)});
  if (!values.rows.empty())
    html += "<h3 id=\"annex-input\">Input</h3>\n" +
            html_table("Values of the case file; those that it leaves out are the manual's",
                       {{"Key", true}, {"Value", true}}, {values}, "input");
  if (html.empty()) return "";
  return "<section id=\"annex\"><h2>Annex</h2>\n" + html + "</section>\n";
}

std::string margins_css(const Json& data) {
  const Json& document = at(data["summary"], "document");
  const auto joined = [](const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts)
      if (!part.empty()) text += (text.empty() ? "" : " · ") + part;
    return css_string(text);
  };
  const auto named = [&](const char* name, const char* key) {
    const std::string text = text_at(document, key);
    return text.empty() ? text : name + text;
  };
  const std::string hash = text_at(data["case"], "hash");
  return fmt::format(
      "@page{{@top-left{{content:{}}}@top-right{{content:{}}}@bottom-left{{content:{}}}"
      "@bottom-right{{content:\"page \" counter(page) \" of \" counter(pages)}}}}",
      joined({text_at(document, "project"), text_at(document, "client")}),
      joined({text_at(data["case"], "name"), named("revision ", "revision")}),
      joined({named("prepared ", "prepared"), named("checked ", "checked"),
              named("approved ", "approved"), hash.empty() ? "" : "input " + hash}));
}

}  // namespace blocklift::pipeline
