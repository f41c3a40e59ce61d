#pragma once

#include <utility>
#include <vector>

namespace blocklift::pipeline {

/// Gumbel's law of the largest, P(X <= x) = exp(-exp(-(x - location) / scale)).
struct GumbelLaw {
  double location = 0;
  double scale = 1;  ///< above zero; both in the figure's unit

  /// The value below which a share of them lies.
  double quantile(double share) const;
  /// The share that lies below a value.
  double share_below(double value) const;
};

/// The likeliest law of a sample.
/// @throws std::invalid_argument if there are fewer than three values, or all are alike.
GumbelLaw fit_gumbel(const std::vector<double>& values);

/// The interval of 95 % of a quantile of the population by its profile likelihood, as
/// pareto_quantile_interval. Of 400 samples of 30, 60 and 300 values it holds the 99.9 % value in
/// 95.5 %, 95.3 % and 94.8 %; percentiles of a parametric bootstrap of the same fit hold it in
/// 90.7 %, 92.0 % and 91.2 % (interval_coverage_test).
/// @throws std::invalid_argument as fit_gumbel.
std::pair<double, double> gumbel_quantile_interval(const std::vector<double>& values, double share);

}  // namespace blocklift::pipeline
