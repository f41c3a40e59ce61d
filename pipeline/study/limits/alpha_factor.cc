#include "pipeline/study/limits/alpha_factor.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/study/limits/study_table.h"

namespace blocklift::pipeline {
namespace {

constexpr double hour = 3600;

constexpr const char* operation_column = "operation_period_h";
constexpr const char* limit_column = "significant_height_m";
constexpr const char* factor_column = "alpha";

/// Rows of a table by their period, h: factors by height, m.
using AlphaRows = std::map<double, std::map<double, double>>;

/// What a value of a table may not be; empty: it is well.
std::string fault_of_factor(double period, double height, double factor) {
  if (!(period > 0)) return fmt::format("a period of {:g} h is not above zero", period);
  if (height < 0) return fmt::format("a height of {:g} m is negative", height);
  if (!(factor >= 0.01 && factor <= 1))
    return fmt::format("alpha is {:g}; from 0.01 to 1 is allowed", factor);
  return "";
}

/// A row that lacks a height of another would be read beyond what it says.
void check_rows_are_whole(const AlphaRows& rows, const Mark& head, Diagnostics& diagnostics) {
  std::set<double> heights;
  for (const auto& [period, factors] : rows)
    for (const auto& [height, factor] : factors) heights.insert(height);
  for (const auto& [period, factors] : rows)
    for (const double height : heights)
      if (!factors.contains(height))
        diagnostics.error(head, fmt::format("operations of {:g} h have no alpha for {:g} m; each "
                                            "period has the same heights",
                                            period, height));
}

AlphaRows read_alpha_rows(const std::filesystem::path& path) {
  const StudyTable table(path);
  Diagnostics diagnostics;
  table.check_names({operation_column, limit_column, factor_column}, diagnostics);
  const auto* periods = table.find(operation_column, diagnostics);
  const auto* heights = table.find(limit_column, diagnostics);
  const auto* factors = table.find(factor_column, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  AlphaRows rows;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const double period = (*periods)[row], height = (*heights)[row], factor = (*factors)[row];
    if (const std::string fault = fault_of_factor(period, height, factor); !fault.empty())
      diagnostics.error(table.row(row), fault);
    else if (!rows[period].try_emplace(height, factor).second)
      diagnostics.error(table.row(row),
                        fmt::format("{:g} h and {:g} m are there already", period, height));
  }
  if (!diagnostics.has_errors()) check_rows_are_whole(rows, table.head(), diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return rows;
}

}  // namespace

AlphaFactor::AlphaFactor(std::vector<double> heights, std::vector<double> factors,
                         double row_period, double planned_period, double contingency)
    : heights_(std::move(heights)),
      factors_(std::move(factors)),
      row_period_(row_period),
      planned_period_(planned_period),
      contingency_(contingency) {}

double AlphaFactor::at(double limiting_height) const {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(heights_, limiting_height) -
                                             heights_.begin());
  if (next == 0) return factors_.front();
  if (next == heights_.size()) return factors_.back();
  const double part =
      (limiting_height - heights_[next - 1]) / (heights_[next] - heights_[next - 1]);
  return factors_[next - 1] + part * (factors_[next] - factors_[next - 1]);
}

std::string AlphaFactor::text() const {
  if (!is_of_table()) return fmt::format("alpha {:g}", factors_.front());
  const auto [least, most] = std::ranges::minmax(factors_);
  return fmt::format("alpha from {:g} to {:g}, by the height, of operations up to {:g} h", least,
                     most, row_period_);
}

AlphaFactor read_alpha_factor(const StudyFile& study) {
  const SeaLimits& limits = *study.limits;
  if (!limits.alpha_table) return limits.alpha ? limits.alpha->value : 1;
  const AlphaRows rows = read_alpha_rows(study.beside(limits.alpha_table->value));
  const double planned = limits.planned_period->value / hour;
  constexpr double slack = 1e-9;  // 1200 min are 20 h
  const auto row = rows.lower_bound(planned * (1 - slack));
  if (row == rows.end()) {
    Diagnostics diagnostics;
    diagnostics.error(limits.planned_period->mark,
                      fmt::format("the operation is planned for {:g} h, and {} ends at {:g} h",
                                  planned, limits.alpha_table->value, rows.rbegin()->first));
    throw InputError(diagnostics);
  }
  std::vector<double> heights, factors;
  for (const auto& [height, factor] : row->second) {
    heights.push_back(height);
    factors.push_back(factor);
  }
  const double contingency = limits.contingency ? limits.contingency->value / hour : 0;
  return {std::move(heights), std::move(factors), row->first, planned, contingency};
}

}  // namespace blocklift::pipeline
