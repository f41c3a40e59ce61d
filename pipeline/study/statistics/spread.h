#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/study/statistics/swings.h"

namespace blocklift::pipeline {

/// A quantile of a sample with the interval that holds that of the population at 95 %.
struct Quantile {
  double share = 0;
  double value = 0, low = 0, high = 0;  ///< low or high is not finite where the sample is too small
};

/// A law of extremes that was fitted to a sample.
struct ExtremeFit {
  std::string law;       ///< "Gumbel", "generalised Pareto above the 90 % quantile"
  double share = 0.999;  ///< of the figures on the better side of the value: below, mostly
  /// With the interval of 95 % by the profile likelihood (gumbel_law.h, pareto_tail.h).
  double value = 0, low = 0, high = 0;
  double p_value =
      0;  ///< Anderson and Darling's (goodness_of_fit.h): below 0.05 the law does not fit
};

/// What is taken for rounding between values of a figure: a thousandth of a millionth of the
/// largest.
double rounding_of_values(const std::vector<double>& values);
/// Do values differ by more than that?
bool values_vary(const std::vector<double>& values);

/// The fewest independent values of which the largest lies beyond a quantile of their population at
/// 97.5 %, so that find_quantile knows both ends of its interval: share^n <= 0.025.
int fewest_for_interval(double share);

/// What a figure's values over all members say.
struct Spread {
  std::string path;
  bool worse_when_smaller = false;  ///< a clearance, a margin: its extremes are at the low end
  bool varies = true;               ///< false: its values are alike, but for rounding
  double mean = 0, deviation = 0;   ///< the deviation of one value is not a number
  double smallest = 0, largest = 0;
  int member_of_smallest = 0, member_of_largest = 0;
  std::vector<Quantile> quantiles;   ///< 1 %, 5 %, 50 %, 95 % and 99 %
  std::vector<ExtremeFit> extremes;  ///< none of fewer than 30 values, or of values all alike
  /// With each variable (Spearman); zero of what does not vary.
  Eigen::VectorXd rank_correlation;
  Swings swings = {};  ///< with each variable; none of a search, which is no sample

  double worst() const { return worse_when_smaller ? smallest : largest; }
  int member_of_worst() const {
    return worse_when_smaller ? member_of_smallest : member_of_largest;
  }
  /// That so many of the figures are better than: 0.95 is the 5 % quantile where small is bad.
  const Quantile& quantile_of_better(double share) const;
};

/// Quantile of a sample with its interval by order statistics, which holds for any law of values
/// that are independent (David and Nagaraja 2003, section 7.1).
Quantile find_quantile(std::vector<double> values, double share);

/// @param values of the members. @param members their numbers. @param design a member a row.
Spread find_spread(std::string path, const std::vector<double>& values,
                   const std::vector<int>& members, const Eigen::MatrixXd& design,
                   bool worse_when_smaller = false);

}  // namespace blocklift::pipeline
