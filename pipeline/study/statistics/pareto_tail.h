#pragma once

#include <utility>
#include <vector>

namespace blocklift::pipeline {

/// Pareto's generalised law of the excesses x of a figure over a threshold,
///   P(X > x) = (1 + shape x / scale)^(-1 / shape),
/// exponential where the shape is zero, without members beyond -scale / shape where it is negative.
struct ParetoTail {
  double scale = 1;  ///< the figure's unit
  double shape = 0;

  /// The excess below which a share of them lies.
  double quantile(double share) const;
  /// The share of them that lies below an excess.
  double share_below(double excess) const;
};

/// The likeliest tail of a sample (Grimshaw 1993). Its shape is at least -1/2: below, the largest
/// excess alone decides, and likelihood does not tell how far to trust it (Smith 1985).
/// @param excesses not negative.
/// @throws std::invalid_argument if there are fewer than three, or none is above zero.
ParetoTail fit_pareto_tail(const std::vector<double>& excesses);

/// The interval of 95 % of a quantile of the population: all values whose profile likelihood, the
/// likeliest of all tails that have that quantile, comes near enough to the likeliest of all (Coles
/// 2001, section 4.3.3). It is as skew as what is known of it. Near enough is what it is for the
/// mean of as many normal values in place of the limit for many, 1.92: n/2 ln(1 + t^2 / (n - 2)),
/// t being Student's 97.5 % value of n - 2 degrees.
///
/// Of 400 samples of 300 figures, 30 of which are beyond the threshold, it holds the 99.9 % value
/// of the figures in 93.8 % where these are exponential, in 97.0 % where their shape is -0.3 and in
/// 94.0 % where it is 0.2. Percentiles of a parametric bootstrap of the same fit hold it in 70.0 %,
/// 66.0 % and 76.5 % (interval_coverage_test).
/// @throws std::invalid_argument as fit_pareto_tail.
std::pair<double, double> pareto_quantile_interval(const std::vector<double>& excesses,
                                                   double share);

}  // namespace blocklift::pipeline
