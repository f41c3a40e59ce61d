#include "pipeline/study/pages/study_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/hydrodynamics/line_chart.h"
#include "pipeline/report/html.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/pages/search_page.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

constexpr const char* style =
    "body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:62rem;padding:0 1rem;"
    "color:#1d2733;background:#fff}"
    "table{border-collapse:collapse;width:100%}th,td{padding:.25rem .6rem;text-align:right;"
    "border-bottom:1px solid #d9dee5}th:first-child,td:first-child{text-align:left;"
    "overflow-wrap:anywhere}.charts{display:flex;flex-wrap:wrap}"
    "svg{width:420px;max-width:100%;height:auto}svg text{font:10px system-ui,sans-serif}"
    "svg .title{font-weight:600;font-size:11px}svg path{fill:none;stroke-width:1.4}"
    "svg .grid{stroke:#ddd}"
    ".range{display:inline-block;position:relative;width:16em;height:.8em;"
    "background:linear-gradient(#888,#888) center/1px 100% no-repeat}"
    ".bar{position:absolute;top:.1em;height:.6em;background:#2f6db3}.bar.minus{background:#c2571a}"
    "td{font-variant-numeric:tabular-nums}"
    ".words td,.words th{text-align:left}"
    ".tornado td+td{white-space:nowrap}.tornado .range{width:11em}"
    ".note{color:#5a6675}.scroll{overflow-x:auto}.even{table-layout:fixed}"
    "@media (prefers-color-scheme:dark){body{color:#e3e8ee;background:#14191f}"
    "th,td{border-color:#38424d}svg{background:#fff}.note{color:#a9b4c0}}";

std::string cells(const std::vector<std::string>& texts, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& text : texts) row += fmt::format("<{0}>{1}</{0}>", tag, text);
  return row + "</tr>\n";
}

/// An index of Sobol' with its interval: "0.67 (0.61 to 0.74)"; "-" and "?" where figures do not
/// vary.
std::string index_text(double value, double low, double high) {
  if (std::isnan(value)) return "-";
  const auto end = [](double x) { return std::isfinite(x) ? fmt::format("{:.2f}", x) : "?"; };
  return fmt::format("{:.2f} ({} to {})", value, end(low), end(high));
}

/// "1.23 (1.20 to 1.27)"; an end that the sample is too small for is left open.
std::string with_interval(double value, double low, double high) {
  const auto end = [](double x) { return std::isfinite(x) ? format_figure(x) : "?"; };
  return fmt::format("{} ({} to {})", format_figure(value), end(low), end(high));
}

std::string name_with_unit(const StudyResults& results, const std::string& path) {
  const ShownFigure figure = results.shown(path);
  return escape_html(figure.name + (figure.unit.empty() ? "" : ", " + figure.unit));
}

/// As many decimals as the mean has, or three digits where it is so small.
std::string deviation_text(double scale, const Spread& spread) {
  const double deviation = scale * spread.deviation, mean = scale * spread.mean;
  const int more = std::abs(mean) > deviation && deviation > 0
                       ? static_cast<int>(std::floor(std::log10(std::abs(mean)))) -
                             static_cast<int>(std::floor(std::log10(deviation)))
                       : 0;
  return format_figure(deviation, std::max(3, 4 - more));
}

std::string worst_text(double scale, const Spread& spread) {
  return format_figure(scale * spread.worst()) + (spread.worse_when_smaller ? " (smallest)" : "");
}

/// Of members that are no sample.
std::string leading_of_grid(const StudyResults& results) {
  std::string text = "<h2>Leading figures</h2>\n<div class=\"scroll\"><table>\n" +
                     cells({"figure", "mean", "deviation", "worst", "in member"}, "th");
  for (const std::size_t i : results.leading) {
    const Spread& spread = results.spreads[i];
    const double scale = results.shown(spread.path).scale;
    text += cells({name_with_unit(results, spread.path), format_figure(scale * spread.mean),
                   deviation_text(scale, spread), worst_text(scale, spread),
                   std::to_string(spread.member_of_worst())},
                  "td");
  }
  return text +
         "</table></div>\n<p class=\"note\">Each value of a grid is run as often as the others: "
         "these lifts are no sample, and have no quantiles and no extremes. Of a figure whose "
         "small "
         "values are bad the worst is the smallest.</p>\n";
}

std::string leading_table(const StudyResults& results) {
  std::string text =
      "<div class=\"scroll\"><table>\n" +
      cells({"figure", "mean", "deviation", "median", "95 %", "99 %", "worst", "in member"}, "th");
  for (const std::size_t i : results.leading) {
    const Spread& spread = results.spreads[i];
    const double scale = results.shown(spread.path).scale;
    const auto quantile = [&](double share) {
      const Quantile& one = spread.quantile_of_better(share);
      return with_interval(scale * one.value, scale * one.low, scale * one.high);
    };
    text += cells({name_with_unit(results, spread.path), format_figure(scale * spread.mean),
                   deviation_text(scale, spread), quantile(0.5), quantile(0.95), quantile(0.99),
                   worst_text(scale, spread), std::to_string(spread.member_of_worst())},
                  "td");
  }
  return text +
         "</table></div>\n<p class=\"note\">In brackets the intervals that hold the "
         "quantiles of all such lifts at 95 %, by order statistics; \"?\": the sample is "
         "too small for that end. They are those of independent lifts, whose chance a Latin "
         "hypercube and Sobol's sequence leave in part only. Of a figure whose small values are "
         "bad, a clearance, a margin, a "
         "righting height, the worst is the smallest, and 95 % of the lifts lie above what stands "
         "under 95 %.</p>\n";
}

/// Share of the members above a value, or below it where small values are bad.
std::string exceedance(const StudyResults& results, const Spread& spread) {
  const ShownFigure figure = results.shown(spread.path);
  std::vector<double> values = results.sample_of(spread.path);
  std::sort(values.begin(), values.end());
  Curve curve{"", {}, {}};
  const auto count = static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    curve.x.push_back(figure.scale * values[i]);
    const double below = (static_cast<double>(i) + 0.5) / count;
    curve.y.push_back(spread.worse_when_smaller ? below : 1 - below);
  }
  return to_svg({figure.name,
                 figure.unit.empty() ? std::string("value") : figure.unit,
                 spread.worse_when_smaller ? "share of members below" : "share of members above",
                 {std::move(curve)}});
}

std::string extremes_table(const StudyResults& results) {
  std::string rows;
  for (const std::size_t i : results.leading) {
    const double scale = results.shown(results.spreads[i].path).scale;
    for (const ExtremeFit& fit : results.spreads[i].extremes)
      rows += cells({name_with_unit(results, results.spreads[i].path), fit.law,
                     fmt::format("{:g}", fit.share),
                     with_interval(scale * fit.value, scale * fit.low, scale * fit.high),
                     fmt::format("{:.2f}{}", fit.p_value, fit.p_value < 0.05 ? ": no fit" : "")},
                    "td");
  }
  if (rows.empty()) return "";
  return "<h2>Extremes</h2>\n<div class=\"scroll\"><table>\n" +
         cells({"figure", "law", "share of better", "value", "p of Anderson-Darling"}, "th") +
         rows +
         "</table></div>\n<p class=\"note\">A law of extremes that was fitted to the members, and "
         "the "
         "value that so many lifts stay on the better side of by it; in brackets the interval of "
         "95 % by its profile likelihood. p: how often a sample of the law itself differs as much "
         "from its own fit. Where p is small the law does not hold. A law knows nothing of what "
         "bounds a "
         "figure, such as the weight of the load.</p>\n";
}

std::string of_which_members(const StudyResults& results) {
  if (results.study.design != StudyDesign::sensitivity) return "";
  return fmt::format(
      "<p class=\"note\">All but the worst is of the first {} lifts, which were drawn "
      "independently "
      "of each other. The others, for Sobol' indices, repeat their values.</p>\n",
      results.independent());
}

/// What a sample says of all such lifts.
std::string spreads(const StudyResults& results) {
  std::string text = "<h2>Leading figures</h2>\n" + leading_table(results) +
                     of_which_members(results) + "<div class=\"charts\">\n";
  for (const std::size_t i : results.leading) text += exceedance(results, results.spreads[i]);
  return text + "</div>\n" + extremes_table(results);
}

std::string law_text(const StudyVariable& variable) {
  const SpreadLaw& law = *variable.law;
  std::string text = std::ranges::find(SpreadLaw::kinds(), law.kind,
                                       &std::pair<std::string, SpreadLaw::Kind>::second)
                         ->first;
  const auto add = [&](const char* name, const std::optional<Located<Measure>>& value) {
    if (value) text += fmt::format(", {} {}", name, shown_value(variable, value->value.value, 6));
  };
  add("mean", law.mean);
  add("deviation", law.deviation);
  add("mode", law.mode);
  add("from", law.lowest);
  add("to", law.highest);
  return text;
}

std::string values_text(const StudyVariable& variable) {
  if (variable.law) return law_text(variable);
  const bool is_range = !variable.between.empty();
  std::string text;
  for (const Located<Measure>& value : is_range ? variable.between : variable.values)
    text += (text.empty() ? ""
             : is_range   ? " to "
                          : "; ") +
            shown_value(variable, value.value.value, 6);
  return text;
}

const char* copula_in_words(CopulaKind kind) {
  switch (kind) {
    case CopulaKind::normal:
      return "a normal copula";
    case CopulaKind::student:
      return "Student's copula";
    case CopulaKind::clayton:
      return "Clayton's copula";
    case CopulaKind::gumbel:
      return "Gumbel's copula";
    case CopulaKind::frank:
      return "Frank's copula";
    case CopulaKind::unknown:
      break;
  }
  return "";
}

/// Which values are not drawn independently of each other.
std::string what_is_joined(const StudyFile& study) {
  std::string text;
  for (const StudyCorrelation& one : study.correlations) {
    text += fmt::format("<p class=\"note\">{} and {} are joined by {}, ",
                        escape_html(one.of.front().value), escape_html(one.of.back().value),
                        copula_in_words(one.copula));
    if (one.degrees) text += fmt::format("{:g} degrees of freedom, ", *one.degrees);
    text += one.is ? fmt::format("correlation {:g}.</p>\n", *one.is)
                   : fmt::format("Kendall's tau {:g}.</p>\n", one.kendall.value_or(0));
  }
  return text;
}

/// What the members differ in.
std::string what_varies(const StudyFile& study) {
  std::string text = "<h2>What varies</h2>\n<div class=\"scroll\"><table class=\"words\">\n" +
                     cells({"value", "key", "takes"}, "th");
  for (const StudyVariable& variable : study.variables) {
    std::string keys;
    for (const Located<std::string>& key : variable.keys)
      keys += (keys.empty() ? "" : "<br>") + escape_html(key.value);
    text +=
        cells({escape_html(variable.name.value), keys, escape_html(values_text(variable))}, "td");
  }
  return text + "</table></div>\n" + what_is_joined(study);
}

/// From the middle to the right for what is positive, to the left for what is negative.
/// @param share of half the width.
std::string bar(double share) {
  const double percent = 50 * std::min(1.0, std::abs(share));
  return fmt::format(
      "<span class=\"range\"><span class=\"bar{}\" style=\"left:{:.1f}%;width:{:.1f}%\"></span>"
      "</span>",
      share < 0 ? " minus" : "", share < 0 ? 50 - percent : 50.0, percent);
}

/// "+12.3 (11.8 to 12.8)"; of a grid, which is no sample, without the interval.
std::string swing_text(const StudyResults& results, const Swing& swing, double scale) {
  if (!std::isfinite(swing.value)) return "not known";
  const double value = scale * swing.value;
  return (value > 0 ? "+" : "") + (results.is_sample()
                                       ? with_interval(value, scale * swing.low, scale * swing.high)
                                       : format_figure(value));
}

/// Inputs of a figure, the largest swing on top.
std::string tornado(const StudyResults& results, const Spread& spread) {
  const std::vector<std::size_t> order = spread.swings.by_size();
  const double largest = std::abs(spread.swings.of[order.front()].value);
  const double scale = results.shown(spread.path).scale;
  std::string text =
      "<div class=\"scroll\"><table class=\"tornado\">\n" +
      cells({name_with_unit(results, spread.path), "from", "to", "", "swing", "rank correlation"},
            "th");
  for (const std::size_t v : order) {
    const StudyVariable& variable = results.study.variables[v];
    const Swing& swing = spread.swings.of[v];
    text += cells({escape_html(variable.name.value), shown_value(variable, swing.from, 4),
                   shown_value(variable, swing.to, 4),
                   bar(largest > 0 && std::isfinite(swing.value) ? swing.value / largest : 0),
                   swing_text(results, swing, scale),
                   fmt::format("{:+.2f}", spread.rank_correlation[static_cast<Eigen::Index>(v)])},
                  "td");
  }
  text += "</table></div>\n";
  if (!spread.varies) return text + "<p class=\"note\">It is the same in all lifts.</p>\n";
  if (std::isfinite(spread.swings.linear_share))
    text += fmt::format("<p class=\"note\">Straight lines explain {:.1f} % of its variance.</p>\n",
                        100 * spread.swings.linear_share);
  return text;
}

std::string sensitivities(const StudyResults& results) {
  if (results.sensitivities.empty() ||
      results.sensitivities.front().members < fewest_for_sobol_indices)
    return "";
  std::string text =
      "<h2>Sobol' indices</h2>\n<p class=\"note\">Share of the variance that a variable has by "
      "itself, and with all others together; in brackets intervals of 95 %. What lies below 0 or "
      "above 1 does so by chance: more members narrow the intervals. \"-\" and \"?\": the figure, "
      "or most of it, is the same in all lifts.</p>\n";
  for (std::size_t i = 0; i < results.sensitivities.size(); ++i) {
    const Sensitivity& one = results.sensitivities[i];
    text += "<div class=\"scroll\"><table class=\"even\">\n" +
            cells({name_with_unit(results, results.spreads[results.leading[i]].path), "by itself",
                   "in all"},
                  "th");
    for (std::size_t v = 0; v < results.study.variables.size(); ++v) {
      const auto k = static_cast<Eigen::Index>(v);
      text += cells({escape_html(results.study.variables[v].name.value),
                     index_text(one.first[k], one.first_low[k], one.first_high[k]),
                     index_text(one.total[k], one.total_low[k], one.total_high[k])},
                    "td");
    }
    text += "</table></div>\n";
  }
  return text;
}

std::string limiting_table(const LimitingSeas& seas) {
  std::vector<std::string> head{"peak period, s"};
  constexpr double degree = std::numbers::pi / 180;
  for (const double heading : seas.headings)
    head.push_back(seas.headings.size() > 1 ? fmt::format("{:.4g}°", heading / degree)
                                            : "limiting height, m");
  std::string text = "<div class=\"scroll\"><table>\n" + cells(head, "th");
  for (std::size_t p = 0; p < seas.periods.size(); ++p) {
    std::vector<std::string> row{fmt::format("{:.4g}", seas.periods[p])};
    for (std::size_t h = 0; h < seas.headings.size(); ++h) {
      const LimitingHeight& limit = seas.at(p, h);
      row.push_back(limit.kind == LimitKind::found        ? format_figure(limit.height, 3)
                    : limit.kind == LimitKind::below_grid ? "below the lowest"
                    : limit.kind == LimitKind::unknown    ? "unknown"
                                                       : "≥ " + format_figure(limit.height, 3));
    }
    text += cells(row, "td");
  }
  return text + "</table></div>\n";
}

std::string limiting_seas(const StudyResults& results) {
  if (!results.limits) return "";
  const LimitingSeas& seas = *results.limits;
  std::string quantities, sentences;
  for (const std::string& sentence : limiting_sentences(results))
    sentences += "<p>" + escape_html(sentence) + "</p>\n";
  for (const QuantityLimit& quantity : results.study.limits->quantities) {
    const ShownFigure figure = results.shown(quantity.figure.value);
    quantities +=
        fmt::format("{}{} at {} {}", quantities.empty() ? "" : "; ", escape_html(figure.name),
                    format_figure(figure.scale * quantity.at.value.value), figure.unit);
  }
  return fmt::format(
             "<h2>Limiting sea states</h2>\n<p>Significant height, m, at which the first of these "
             "reaches its limit: {}. Linear between heights that were run, and from heading to "
             "heading; of "
             "several seeds the worst counts; ≥: the next height failed or was not run (open "
             "dots); below the "
             "lowest: that is too much already (drawn as 0); unknown: the lowest failed (an open "
             "dot "
             "at 0), and nothing counts as workable there.{}</p>\n",
             quantities,
             seas.headings.size() > 1 ? " Headings are where waves travel to, from +x towards +y."
                                      : "") +
         limiting_table(seas) + "<div class=\"charts\">\n" + limiting_contours(seas) +
         limiting_polar(seas) + "</div>\n" + sentences;
}

/// Of a folder with a case its name, whether the study names it or the file in it.
std::string name_of_case(const StudyFile& study) {
  std::error_code ignored;
  std::filesystem::path path = std::filesystem::weakly_canonical(study.case_path(), ignored);
  if (path.filename() == "case.yaml") path = path.parent_path();
  return path.empty() ? study.case_name.value : path.filename().string();
}

std::string all_figures(const StudyResults& results) {
  std::string text = "<h2>All figures</h2>\n<div class=\"scroll\"><table>\n" +
                     cells({"figure", "smallest", "mean", "deviation", "largest"}, "th");
  for (const Spread& spread : results.spreads) {
    const double scale = results.shown(spread.path).scale;
    text += cells({name_with_unit(results, spread.path), format_figure(scale * spread.smallest),
                   format_figure(scale * spread.mean), deviation_text(scale, spread),
                   format_figure(scale * spread.largest)},
                  "td");
  }
  return text + "</table></div>\n";
}

/// The whole report of the worst member stands beside the page.
std::string link_to_worst(const StudyResults& results) {
  if (results.search || results.leading.empty()) return "";
  const Spread& spread = results.spreads[results.leading.front()];
  return fmt::format(
      " <a href=\"worst/report.html\">The report of member {}</a>, the worst by: {}.",
      spread.member_of_worst(), escape_html(results.shown(spread.path).name));
}

/// How far from zero a rank correlation of so many independent members lies once in twenty: its
/// deviation is 1 / sqrt(n - 1).
std::string by_chance(const StudyResults& results) {
  const auto count = static_cast<double>(
      std::count_if(results.members.begin(), results.members.end(), [&](const Member& member) {
        return member.failure.empty() && member.number < results.independent();
      }));
  if (!results.is_sample() || count < 4) return "";
  return fmt::format(" With {:.0f} lifts what lies within ±{:.2f} may be chance.", count,
                     std::min(1.0, 1.96 / std::sqrt(count - 1)));
}

}  // namespace

std::string study_page(const StudyResults& results) {
  const StudyFile& study = results.study;
  const std::string title = escape_html(study.title.empty() ? study.name : study.title);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head><body>\n"
      "<h1>{0}</h1>\n<p>{2} lift{5} of the case {3}{4}. Each is a row of study.csv.{6}</p>\n",
      title, style, results.members.size(), escape_html(name_of_case(study)),
      results.failed() > 0 ? fmt::format("; {} failed and are left out", results.failed()) : "",
      results.members.size() == 1 ? "" : "s", link_to_worst(results));
  // What a search tries is no sample: it has no quantiles.
  if (results.search)
    return page + search_section(results) + what_varies(study) + all_figures(results) +
           "</body></html>\n";
  if (const std::string warning = survivors_warning(results); !warning.empty())
    page += "<p><strong>Warning:</strong> " + escape_html(warning) + ".</p>\n";
  for (const std::string& sentence : left_out_warnings(results))
    page += "<p><strong>Warning:</strong> " + escape_html(sentence) + ".</p>\n";
  page += limiting_seas(results);
  if (results.is_sample())
    page += spreads(results);
  else if (!results.limits)
    page += leading_of_grid(results);
  page += sensitivities(results);
  page +=
      "<h2>What they depend on</h2>\n<p class=\"note\">Swing: how far a figure goes while one "
      "value goes through the middle 90 % of what it takes and the others stay, by straight lines "
      "through all lifts (least squares); in brackets the interval of 95 %. Beside it the rank "
      "correlation (Spearman)." +
      by_chance(results) + "</p>\n";
  for (const std::size_t i : results.leading) page += tornado(results, results.spreads[i]);
  return page + what_varies(study) + all_figures(results) + "</body></html>\n";
}

}  // namespace blocklift::pipeline
