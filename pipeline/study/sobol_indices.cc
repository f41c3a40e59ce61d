#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "pipeline/study/spread.h"
#include "pipeline/study/study_design.h"

namespace blocklift::pipeline {
namespace {

constexpr int sobol_resamples = 500;
constexpr double sobol_covered = 0.95;
constexpr double no_index = std::numeric_limits<double>::quiet_NaN();

/// Figures of the base members all of whose lifts ran, a row each: of sample A, of B, and of A with
/// each variable's value of B. Less their mean.
Eigen::MatrixXd complete_rows(const Eigen::VectorXd& figure, Eigen::Index members,
                              Eigen::Index variables) {
  const Eigen::Map<const Eigen::MatrixXd> all(figure.data(), members, variables + 2);
  Eigen::MatrixXd complete(members, variables + 2);
  Eigen::Index count = 0;
  for (Eigen::Index row = 0; row < members; ++row)
    if (all.row(row).allFinite()) complete.row(count++) = all.row(row);
  complete.conservativeResize(count, Eigen::NoChange);
  if (count > 0) complete.array() -= complete.mean();
  return complete;
}

/// @param smallest deviation of what is not all alike. @returns not a number of what is.
double correlation_over(const std::vector<Eigen::Index>& rows, const Eigen::MatrixXd& figures,
                        Eigen::Index a, Eigen::Index b, double smallest) {
  const auto count = static_cast<double>(rows.size());
  double mean_a = 0, mean_b = 0, aa = 0, bb = 0, ab = 0;
  for (const Eigen::Index row : rows) {
    mean_a += figures(row, a) / count;
    mean_b += figures(row, b) / count;
  }
  for (const Eigen::Index row : rows) {
    const double x = figures(row, a) - mean_a, y = figures(row, b) - mean_b;
    aa += x * x;
    bb += y * y;
    ab += x * y;
  }
  const double least = count * smallest * smallest;
  return aa > least && bb > least ? std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0) : no_index;
}

/// An index with what the bootstrap made of it.
struct BootstrappedIndex {
  double value = no_index;
  std::vector<double> again;

  /// The value that a part of the resamples lies below; not a number where in half of them all
  /// figures were alike.
  double at(double part) {
    if (again.size() < sobol_resamples / 2 || std::isnan(value)) return no_index;
    std::sort(again.begin(), again.end());
    return again[static_cast<std::size_t>(part * static_cast<double>(again.size() - 1))];
  }
};

struct IndicesOfVariable {
  BootstrappedIndex first, total;
};

std::vector<IndicesOfVariable> bootstrap_indices(const Eigen::MatrixXd& figures, double smallest) {
  const Eigen::Index count = figures.rows(), variables = figures.cols() - 2;
  std::vector<IndicesOfVariable> indices(static_cast<std::size_t>(variables));
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < count; ++row) rows.push_back(row);
  const auto first = [&](Eigen::Index v) {
    return correlation_over(rows, figures, 1, v + 2, smallest);
  };
  const auto total = [&](Eigen::Index v) {
    return 1 - correlation_over(rows, figures, 0, v + 2, smallest);
  };
  const auto keep = [](double value, BootstrappedIndex& index) {
    if (!std::isnan(value)) index.again.push_back(value);
  };
  for (Eigen::Index v = 0; v < variables; ++v) {
    indices[v].first.value = first(v);
    indices[v].total.value = total(v);
  }
  // The library's distributions differ between standard libraries; the engine does not.
  std::mt19937_64 engine(1);
  const auto draw = [&] {
    constexpr double unit = 1.0 / (1ULL << 53);
    return static_cast<Eigen::Index>(static_cast<double>(engine() >> 11) * unit *
                                     static_cast<double>(count));
  };
  for (int resample = 0; resample < sobol_resamples; ++resample) {
    std::ranges::generate(rows, draw);
    for (Eigen::Index v = 0; v < variables; ++v) {
      keep(first(v), indices[v].first);
      keep(total(v), indices[v].total);
    }
  }
  return indices;
}

}  // namespace

Sensitivity find_sensitivity(const Eigen::MatrixXd& design, const Eigen::VectorXd& figure,
                             int members) {
  const Eigen::Index variables = design.cols();
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(variables, no_index);
  Sensitivity found{none, none, none, none, none, none, 0};
  const Eigen::MatrixXd figures = complete_rows(figure, members, variables);
  found.members = static_cast<int>(figures.rows());
  if (found.members < fewest_for_sobol_indices) return found;
  std::vector<double> values;
  for (const double value : figure)
    if (std::isfinite(value)) values.push_back(value);
  if (!values_vary(values)) return found;
  std::vector<IndicesOfVariable> indices = bootstrap_indices(figures, rounding_of_values(values));
  for (Eigen::Index v = 0; v < variables; ++v) {
    auto& [first, total] = indices[v];
    found.first[v] = first.value;
    found.first_low[v] = first.at((1 - sobol_covered) / 2);
    found.first_high[v] = first.at((1 + sobol_covered) / 2);
    found.total[v] = total.value;
    found.total_low[v] = total.at((1 - sobol_covered) / 2);
    found.total_high[v] = total.at((1 + sobol_covered) / 2);
  }
  return found;
}

}  // namespace blocklift::pipeline
