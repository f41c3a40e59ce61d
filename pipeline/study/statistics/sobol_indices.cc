#include "pipeline/study/statistics/sobol_indices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "pipeline/files/study/study_file.h"
#include "pipeline/study/statistics/spread.h"

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

/// Indices by the base members of some rows. Samples A and B are alike by chance, which the two
/// correlations of E take up: least squares of E by both give each its own part (Glen and Isaacs
/// 2012).
class PlainIndices {
 public:
  PlainIndices(const std::vector<Eigen::Index>& rows, const Eigen::MatrixXd& figures,
               double smallest)
      : chance_(correlation_over(rows, figures, 0, 1, smallest)) {
    for (Eigen::Index v = 0; v < figures.cols() - 2; ++v) {
      with_a_.push_back(correlation_over(rows, figures, 0, v + 2, smallest));
      with_b_.push_back(correlation_over(rows, figures, 1, v + 2, smallest));
    }
  }

  double first(Eigen::Index v) const { return part_of(with_b_[v], with_a_[v]); }
  /// Where sample B is all alike there is no chance in it.
  double total(Eigen::Index v) const {
    return 1 - (std::isnan(chance_) ? with_a_[v] : part_of(with_a_[v], with_b_[v]));
  }

 private:
  double part_of(double own, double other) const {
    constexpr double least = 1e-6;  // below, the two samples are one
    const double apart = 1 - chance_ * chance_;
    // Not a number is not more.
    return apart > least ? std::clamp((own - other * chance_) / apart, -1.0, 1.0) : no_index;
  }

  double chance_;  ///< correlation of A and B
  std::vector<double> with_a_, with_b_;
};

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
  const auto keep = [](double value, BootstrappedIndex& index) {
    if (!std::isnan(value)) index.again.push_back(value);
  };
  const PlainIndices all(rows, figures, smallest);
  for (Eigen::Index v = 0; v < variables; ++v) {
    indices[v].first.value = all.first(v);
    indices[v].total.value = all.total(v);
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
    const PlainIndices drawn(rows, figures, smallest);
    for (Eigen::Index v = 0; v < variables; ++v) {
      keep(drawn.first(v), indices[v].first);
      keep(drawn.total(v), indices[v].total);
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
