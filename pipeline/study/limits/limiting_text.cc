#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/study/limits/limiting_sea.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

constexpr double one_degree = std::numbers::pi / 180;

std::string percent_text(double share) { return fmt::format("{:.1f} %", 100 * share); }

/// What counts as not workable because it lies outside the grid.
std::string beyond_text(const Operability& operability) {
  std::string text;
  const auto add = [&](double share, const char* what) {
    if (share > 0)
      text += fmt::format("; {} has {} that were not run and counts as not workable",
                          percent_text(share), what);
  };
  add(operability.beyond_periods, "periods");
  add(operability.beyond_headings, "headings");
  return text;
}

/// "12 h to 36 h" or "at 12 h alone".
std::string window_text(const Operability::Window& window) {
  return window.begin < window.end ? fmt::format("{:.6g} h to {:.6g} h", window.begin, window.end)
                                   : fmt::format("at {:.6g} h alone", window.begin);
}

std::string windows_text(const std::vector<Operability::Window>& windows) {
  std::string text;
  for (const Operability::Window& window : windows)
    text += (text.empty() ? "" : "; ") + window_text(window);
  return text;
}

/// "the 18 h of the operation, 12 h planned and 6 h of contingency".
std::string reference_period_text(const AlphaFactor& alpha) {
  if (alpha.contingency() > 0)
    return fmt::format(
        "the {:.6g} h of the operation, {:.6g} h planned and {:.6g} h of contingency",
        alpha.reference_period(), alpha.planned_period(), alpha.contingency());
  return fmt::format("the {:.6g} h that the operation is planned for", alpha.planned_period());
}

/// The windows in which the whole operation finds place.
std::string plan_text(const std::vector<Operability::Window>& windows, const AlphaFactor& alpha) {
  std::vector<Operability::Window> long_enough;
  for (const Operability::Window& window : windows)
    if (window.holds(alpha.reference_period())) long_enough.push_back(window);
  const std::string period = reference_period_text(alpha);
  if (long_enough.empty()) return fmt::format("no window lasts {}", period);
  return fmt::format("windows that last {}: {}", period, windows_text(long_enough));
}

/// Shares are of a hundred or of one; counts of a thousand waves are allowed, too, and are told.
bool is_usual_sum(double sum) { return std::abs(sum - 100) <= 1 || std::abs(sum - 1) <= 0.01; }

}  // namespace

std::string limiting_text(const LimitingSeas& seas) {
  std::vector<TableColumn> columns{{"peak period, s", 0}};
  for (const double heading : seas.headings)
    columns.push_back(
        {seas.headings.size() > 1 ? fmt::format("{:.4g}°", heading / one_degree) : "height, m", 3});
  TextTable table(std::move(columns));
  for (std::size_t p = 0; p < seas.periods.size(); ++p) {
    std::vector<TextTable::Cell> row{fmt::format("{:.4g}", seas.periods[p])};
    for (std::size_t h = 0; h < seas.headings.size(); ++h) {
      const LimitingHeight& limit = seas.at(p, h);
      const std::string height = fmt::format("{:.2f}", limit.height);
      row.emplace_back(limit.kind == LimitKind::found        ? height
                       : limit.kind == LimitKind::below_grid ? "below"
                       : limit.kind == LimitKind::unknown    ? "unknown"
                                                             : "≥ " + height);
    }
    table.add_row(std::move(row));
  }
  return "Limiting significant height, m, by heading; below: the lowest is too much\n" +
         table.text();
}

std::vector<std::string> sentences_of_failures(const LimitingSeas& seas) {
  std::vector<std::string> sentences;
  for (std::size_t cell = 0; cell < seas.failed.size(); ++cell) {
    if (seas.failed[cell] < 0) continue;
    std::string place = fmt::format("{:.4g} s", seas.periods[cell / seas.headings.size()]);
    if (seas.headings.size() > 1)
      place += fmt::format(", {:.4g}°", seas.headings[cell % seas.headings.size()] / one_degree);
    const LimitingHeight& limit = seas.heights[cell];
    sentences.push_back(
        limit.kind == LimitKind::unknown
            ? fmt::format("{}: not known, member {} failed; it counts as not workable", place,
                          seas.failed[cell])
            : fmt::format("{}: not known above {:.2f} m, member {} failed", place, limit.height,
                          seas.failed[cell]));
  }
  return sentences;
}

std::vector<std::string> sentences_of_scatter(const Operability& operability,
                                              const AlphaFactor& alpha) {
  std::vector<std::string> sentences{fmt::format("scatter table: {} is workable with {}{}",
                                                 percent_text(operability.share), alpha.text(),
                                                 beyond_text(operability))};
  if (!is_usual_sum(operability.sum))
    sentences.push_back(
        fmt::format("the scatter table's shares add up to {:.6g}, neither 100 nor 1: all are parts "
                    "of that sum",
                    operability.sum));
  return sentences;
}

std::vector<std::string> sentences_of_forecast(const Operability& operability,
                                               const AlphaFactor& alpha) {
  std::string first =
      fmt::format("forecast: {} of its instants are workable with {}{}",
                  percent_text(operability.share), alpha.text(), beyond_text(operability));
  if (!operability.windows.empty()) first += "; windows: " + windows_text(operability.windows);
  std::vector<std::string> sentences{std::move(first)};
  if (alpha.is_of_table()) sentences.push_back(plan_text(operability.windows, alpha));
  if (!operability.windows.empty() && operability.windows.back().end == operability.last)
    sentences.push_back(fmt::format(
        "the last window reaches the end of the forecast, {:.6g} h: how long it lasts is "
        "not known",
        operability.last));
  if (!operability.holes.empty())
    sentences.push_back(
        fmt::format("the forecast has no instants in {}, more than twice its usual step: the sea "
                    "is not known there, and windows end",
                    windows_text(operability.holes)));
  return sentences;
}

}  // namespace blocklift::pipeline
