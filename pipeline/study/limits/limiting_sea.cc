#include "pipeline/study/limits/limiting_sea.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/study/limits/figure_limit.h"
#include "pipeline/study/limits/study_table.h"

namespace blocklift::pipeline {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double whole_turn = 2 * std::numbers::pi;

/// Column of a variable in a design; -1: the study has none of that name.
Eigen::Index column_of(const StudyFile& study, const std::optional<Located<std::string>>& name) {
  if (!name) return -1;
  for (std::size_t v = 0; v < study.variables.size(); ++v)
    if (study.variables[v].name.value == name->value) return static_cast<Eigen::Index>(v);
  return -1;
}

/// Different values of a column, ascending.
std::vector<double> values_in(const Eigen::MatrixXd& design, Eigen::Index column) {
  if (column < 0) return {0};
  const Eigen::VectorXd values = design.col(column);
  const std::set<double> different(values.begin(), values.end());
  return {different.begin(), different.end()};
}

std::size_t place_of(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) -
                                  values.begin());
}

/// The worse of two; what is not known is worst.
double worse(double a, double b, bool worse_when_smaller) {
  if (std::isnan(a) || std::isnan(b)) return not_known;
  return worse_when_smaller ? std::min(a, b) : std::max(a, b);
}

/// The grid of sea states that a study runs.
struct SeaGrid {
  Eigen::Index height, period, heading;
  std::vector<double> heights, periods, headings;

  std::size_t cell_of(const Eigen::MatrixXd& design, Eigen::Index member) const {
    const std::size_t at_period = place_of(periods, design(member, period));
    return at_period * headings.size() +
           (heading < 0 ? 0 : place_of(headings, design(member, heading)));
  }
};

SeaGrid grid_of(const StudyFile& study, const Eigen::MatrixXd& design) {
  SeaGrid grid{column_of(study, study.limits->height),
               column_of(study, study.limits->period),
               column_of(study, study.limits->heading),
               {},
               {},
               {}};
  grid.heights = values_in(design, grid.height);
  grid.periods = values_in(design, grid.period);
  grid.headings = values_in(design, grid.heading);
  return grid;
}

/// The worst value over seeds of a quantity in each sea state: heights of a cell.
std::vector<std::vector<double>> worst_over_seeds(const SeaGrid& grid,
                                                  const Eigen::MatrixXd& design,
                                                  const std::vector<Member>& members,
                                                  const std::string& path,
                                                  bool worse_when_smaller) {
  const double best = (worse_when_smaller ? 1 : -1) * std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> worst(grid.periods.size() * grid.headings.size(),
                                         std::vector<double>(grid.heights.size(), best));
  for (const Member& member : members) {
    const Eigen::Index row = member.number;
    double& value =
        worst[grid.cell_of(design, row)][place_of(grid.heights, design(row, grid.height))];
    value = worse(value, member.figure(path), worse_when_smaller);
  }
  return worst;
}

/// Of each sea state the member with the lowest height that has no value of a quantity; -1: none.
std::vector<int> failed_members(const SeaGrid& grid, const Eigen::MatrixXd& design,
                                const std::vector<Member>& members, const std::string& path) {
  std::vector<int> failed(grid.periods.size() * grid.headings.size(), -1);
  for (const Member& member : members) {
    if (!std::isnan(member.figure(path))) continue;
    int& lowest = failed[grid.cell_of(design, member.number)];
    if (lowest < 0 || design(member.number, grid.height) < design(lowest, grid.height))
      lowest = member.number;
  }
  return failed;
}

constexpr const char* height_column = "significant_height_m";
constexpr const char* period_column = "peak_period_s";
constexpr const char* heading_column = "heading_deg";

/// Steps of a forecast that are far longer than usual.
std::vector<Operability::Window> find_holes(const std::vector<SeaState>& states) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < states.size(); ++i)
    steps.push_back(states[i].time - states[i - 1].time);
  if (steps.empty()) return {};
  const auto median = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), median, steps.end());
  const double longest = 2 * *median;
  std::vector<Operability::Window> holes;
  for (std::size_t i = 1; i < states.size(); ++i)
    if (states[i].time - states[i - 1].time > longest * (1 + 1e-9))
      holes.push_back({states[i - 1].time, states[i].time});
  return holes;
}

/// Place of a value in ascending figures: the one below and the part of the way to the next.
struct Between {
  std::size_t below = 0, above = 0;
  double part = 0;
};

std::optional<Between> find_between(const std::vector<double>& figures, double value) {
  constexpr double slack = 1e-9;
  if (value < figures.front() - slack || value > figures.back() + slack) return std::nullopt;
  const auto next = static_cast<std::size_t>(
      std::upper_bound(figures.begin(), figures.end(), value) - figures.begin());
  const std::size_t above = std::min(next, figures.size() - 1);
  const std::size_t below = next == 0 ? 0 : next - 1;
  const double width = figures[above] - figures[below];
  return Between{below, above, width > 0 ? (value - figures[below]) / width : 0};
}

/// From the last heading on to the first.
double closing_gap(const std::vector<double>& headings) {
  return headings.front() + whole_turn - headings.back();
}

/// Do headings go round, with no gap larger than those between them?
bool closes(const std::vector<double>& headings) {
  double largest_gap = 0;
  for (std::size_t i = 1; i < headings.size(); ++i)
    largest_gap = std::max(largest_gap, headings[i] - headings[i - 1]);
  return closing_gap(headings) <= 1.01 * largest_gap;
}

/// The same of a heading: round the turn where the grid's largest gap closes it.
std::optional<Between> find_heading(const std::vector<double>& headings, double heading) {
  if (headings.size() == 1) return Between{};
  const double turns = std::floor((heading - headings.front()) / whole_turn + 1e-12);
  const double within = heading - turns * whole_turn;
  if (auto inside = find_between(headings, within)) return inside;
  if (!closes(headings)) return std::nullopt;
  return Between{headings.size() - 1, 0, (within - headings.back()) / closing_gap(headings)};
}

}  // namespace

const char* name_of(LimitKind kind) {
  switch (kind) {
    case LimitKind::found:
      return "found";
    case LimitKind::below_grid:
      return "below the grid";
    case LimitKind::above_grid:
      return "above the grid";
    case LimitKind::before_failure:
      return "before a failure";
    case LimitKind::unknown:
      return "unknown";
  }
  return "";
}

LimitingHeight find_limiting_height(const std::vector<double>& heights,
                                    const std::vector<double>& values, double limit,
                                    bool worse_when_smaller) {
  const double sign = worse_when_smaller ? -1 : 1;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (std::isnan(values[k]))
      return k == 0 ? LimitingHeight{0, LimitKind::unknown}
                    : LimitingHeight{heights[k - 1], LimitKind::before_failure};
    if (sign * (values[k] - limit) <= 0) continue;
    if (k == 0) return {0, LimitKind::below_grid};
    const double part = (limit - values[k - 1]) / (values[k] - values[k - 1]);
    return {heights[k - 1] + part * (heights[k] - heights[k - 1]), LimitKind::found};
  }
  return {heights.back(), LimitKind::above_grid};
}

bool LimitingSeas::go_round() const { return closes(headings); }

double LimitingSeas::height_at(double period, double heading) const {
  const auto p = find_between(periods, period);
  const auto h = find_heading(headings, heading);
  if (!p || !h) return 0;
  const std::array<std::pair<std::size_t, double>, 2> rows{
      {{p->below, 1 - p->part}, {p->above, p->part}}};
  const std::array<std::pair<std::size_t, double>, 2> columns{
      {{h->below, 1 - h->part}, {h->above, h->part}}};
  for (const auto& [row, of_row] : rows)
    for (const auto& [column, of_column] : columns)
      if (of_row * of_column > 0 && at(row, column).kind == LimitKind::unknown) return 0;
  const auto across = [&](std::size_t row) {
    return (1 - h->part) * at(row, h->below).height + h->part * at(row, h->above).height;
  };
  return (1 - p->part) * across(p->below) + p->part * across(p->above);
}

bool LimitingSeas::has_period(double period) const {
  return find_between(periods, period).has_value();
}

bool LimitingSeas::has_heading(double heading) const {
  return find_heading(headings, heading).has_value();
}

LimitingSeas find_limiting_seas(const StudyFile& study, const Eigen::MatrixXd& design,
                                const std::vector<Member>& members) {
  const SeaGrid grid = grid_of(study, design);
  LimitingSeas seas{grid.periods, grid.headings, {}, {}, {}};
  for (const QuantityLimit& quantity : study.limits->quantities) {
    const std::string& path = quantity.figure.value;
    const double limit = limit_of(quantity.at, path, unit_of(members, path));
    const auto has_it = [&](const Member& member) { return !std::isnan(member.figure(path)); };
    if (std::none_of(members.begin(), members.end(), has_it))
      throw std::runtime_error(fmt::format("no member has the figure {}, which is limited", path));
    const bool smaller = std::any_of(members.begin(), members.end(), [&](const Member& member) {
      return std::find(member.worse_when_smaller.begin(), member.worse_when_smaller.end(), path) !=
             member.worse_when_smaller.end();
    });
    const auto worst = worst_over_seeds(grid, design, members, path, smaller);
    const std::vector<int> failed = failed_members(grid, design, members, path);
    if (seas.quantities.empty()) {
      seas.heights.assign(worst.size(), {grid.heights.back(), LimitKind::above_grid});
      seas.governing.resize(worst.size());
      seas.failed.assign(worst.size(), -1);
    }
    for (std::size_t cell = 0; cell < worst.size(); ++cell) {
      const LimitingHeight height = find_limiting_height(grid.heights, worst[cell], limit, smaller);
      const LimitingHeight& before = seas.heights[cell];
      // Of two that allow nothing the one that was computed is told.
      const bool is_less =
          height.height < before.height || before.kind == LimitKind::above_grid ||
          (height.kind == LimitKind::below_grid && before.kind == LimitKind::unknown);
      if (height.kind == LimitKind::above_grid || !is_less) continue;
      seas.heights[cell] = height;
      const bool is_reached =
          height.kind == LimitKind::found || height.kind == LimitKind::below_grid;
      seas.governing[cell] = is_reached ? path : "";
      seas.failed[cell] = is_reached ? -1 : failed[cell];
    }
    seas.quantities.push_back(path);
  }
  return seas;
}

bool varies_heading(const StudyFile& study) {
  if (!study.limits || !study.limits->heading) return false;
  for (const StudyVariable& variable : study.variables)
    if (variable.name.value == study.limits->heading->value)
      return std::ranges::any_of(variable.values, [&](const Located<Measure>& value) {
        return value.value.value != variable.values.front().value.value;
      });
  return false;
}

std::vector<SeaState> read_sea_states(const std::filesystem::path& path, bool is_forecast,
                                      bool needs_heading) {
  const std::string measure = is_forecast ? "time_h" : "share";
  const StudyTable table(path);
  Diagnostics diagnostics;
  table.check_names({height_column, period_column, heading_column, measure}, diagnostics);
  const auto* heights = table.find(height_column, diagnostics);
  const auto* periods = table.find(period_column, diagnostics);
  const auto* measures = table.find(measure, diagnostics);
  const auto* headings = needs_heading || table.has(heading_column)
                             ? table.find(heading_column, diagnostics)
                             : nullptr;
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  std::vector<SeaState> states;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    SeaState state{(*heights)[row], (*periods)[row],
                   headings ? (*headings)[row] * std::numbers::pi / 180 : 0, (*measures)[row],
                   (*measures)[row]};
    if (state.height < 0 || !(state.period > 0) || (!is_forecast && state.share < 0))
      diagnostics.error(table.row(row), "heights and shares are not negative, periods above zero");
    if (is_forecast && row > 0 && !(state.time > states.back().time))
      diagnostics.error(table.row(row), "the times of a forecast ascend");
    states.push_back(state);
  }
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return states;
}

Operability find_operability(const LimitingSeas& seas, const std::vector<SeaState>& states,
                             const AlphaFactor& alpha, bool is_forecast) {
  Operability result;
  if (is_forecast) result.holes = find_holes(states);
  bool open = false;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const SeaState& state = states[i];
    const double share = is_forecast ? 1 : state.share;
    const double limit = seas.height_at(state.period, state.heading);
    const bool is_allowed = limit > 0 && state.height <= alpha.at(limit) * limit;
    result.sum += share;
    if (is_allowed) result.share += share;
    if (!seas.has_period(state.period)) result.beyond_periods += share;
    if (!seas.has_heading(state.heading)) result.beyond_headings += share;
    if (!is_forecast) continue;
    result.last = state.time;
    const bool is_behind_hole = std::ranges::any_of(
        result.holes, [&](const Operability::Window& hole) { return hole.end == state.time; });
    if (is_allowed && (!open || is_behind_hole)) result.windows.push_back({state.time, state.time});
    if (is_allowed) result.windows.back().end = state.time;
    open = is_allowed;
  }
  if (!(result.sum > 0)) return result;
  for (double* share : {&result.share, &result.beyond_periods, &result.beyond_headings})
    *share /= result.sum;
  return result;
}

}  // namespace blocklift::pipeline
