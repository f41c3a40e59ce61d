#include "pipeline/study/statistics/spread.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <openturns/OT.hxx>

#include "algebra/quantile.h"
#include "pipeline/study/statistics/goodness_of_fit.h"
#include "pipeline/study/statistics/gumbel_law.h"
#include "pipeline/study/statistics/pareto_tail.h"

namespace blocklift::pipeline {
namespace {

constexpr std::size_t fewest_for_a_fit = 30;
constexpr double covered = 0.95;

ExtremeFit gumbel_fit(const std::vector<double>& values, double share) {
  const GumbelLaw law = fit_gumbel(values);
  std::vector<double> shares;
  for (const double value : values) shares.push_back(law.share_below(value));
  const auto [low, high] = gumbel_quantile_interval(values, share);
  return {"Gumbel", share, law.quantile(share),
          low,      high,  p_of_gumbel_fit(anderson_darling(std::move(shares)))};
}

/// @param excesses of a share of the figures, `tail`, over a threshold.
ExtremeFit pareto_fit(const std::vector<double>& excesses, double threshold, double tail,
                      double share) {
  const ParetoTail law = fit_pareto_tail(excesses);
  std::vector<double> shares;
  for (const double excess : excesses) shares.push_back(law.share_below(excess));
  const double share_of_tail = 1 - (1 - share) / tail;
  const auto [low, high] = pareto_quantile_interval(excesses, share_of_tail);
  return {"generalised Pareto above the 90 % quantile",
          share,
          threshold + law.quantile(share_of_tail),
          threshold + low,
          threshold + high,
          p_of_pareto_fit(anderson_darling(std::move(shares)), law.shape)};
}

/// @param values of which some differ by more than rounding.
std::vector<ExtremeFit> fit_extremes(std::vector<double> values) {
  constexpr double share = 0.999, tail = 0.1;
  if (values.size() < fewest_for_a_fit || !values_vary(values)) return {};
  std::sort(values.begin(), values.end());
  std::vector<ExtremeFit> fits{gumbel_fit(values, share)};
  const auto first = static_cast<std::size_t>((1 - tail) * static_cast<double>(values.size()));
  const double threshold = values[first - 1];
  // What equals the threshold, but for rounding, is no excess: the law has no such value, and the
  // statistic of the fit would not be finite.
  const auto above = std::ranges::upper_bound(values, threshold + rounding_of_values(values));
  std::vector<double> excesses;
  for (auto value = above; value != values.end(); ++value) excesses.push_back(*value - threshold);
  if (excesses.size() < fewest_for_a_fit || !values_vary(excesses)) return fits;
  const double part = static_cast<double>(excesses.size()) / static_cast<double>(values.size());
  fits.push_back(pareto_fit(excesses, threshold, part, share));
  return fits;
}

/// The laws of the largest, of the values' negatives.
std::vector<ExtremeFit> fit_minima(std::vector<double> values) {
  for (double& value : values) value = -value;
  std::vector<ExtremeFit> fits = fit_extremes(std::move(values));
  for (ExtremeFit& fit : fits) {
    fit.law = fit.law == "Gumbel" ? "Gumbel of the smallest"
                                  : "generalised Pareto below the 10 % quantile";
    fit.value = -fit.value;
    fit.low = -std::exchange(fit.high, -fit.low);
  }
  return fits;
}

Eigen::VectorXd ranks_of(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  Eigen::VectorXd ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(begin + end - 1);  // ties share their mean
    begin = end;
  }
  return ranks;
}

double correlation(Eigen::VectorXd a, Eigen::VectorXd b) {
  a.array() -= a.mean();
  b.array() -= b.mean();
  const double norms = a.norm() * b.norm();
  return norms > 0 ? a.dot(b) / norms : 0;
}

}  // namespace

double rounding_of_values(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return 1e-9 * largest;
}

bool values_vary(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax_element(values);
  return least != values.end() && *most - *least > rounding_of_values(values);
}

int fewest_for_interval(double share) {
  return static_cast<int>(std::ceil(std::log((1 - covered) / 2) / std::log(share)));
}

const Quantile& Spread::quantile_of_better(double share) const {
  const double wanted = worse_when_smaller ? 1 - share : share;
  return *std::min_element(quantiles.begin(), quantiles.end(),
                           [&](const Quantile& a, const Quantile& b) {
                             return std::abs(a.share - wanted) < std::abs(b.share - wanted);
                           });
}

Quantile find_quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  Quantile quantile{share, algebra::quantile_of_sorted(values, share),
                    -std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
  // The number of values below the population's quantile is binomial.
  const OT::Binomial below_it(values.size(), share);
  const auto rank = [&](double probability) { return below_it.computeQuantile(probability)[0]; };
  const auto low = static_cast<std::ptrdiff_t>(rank((1 - covered) / 2)) - 1;
  const auto high = static_cast<std::size_t>(rank((1 + covered) / 2));
  if (low >= 0) quantile.low = values[low];
  if (high < values.size()) quantile.high = values[high];
  return quantile;
}

Spread find_spread(std::string path, const std::vector<double>& values,
                   const std::vector<int>& members, const Eigen::MatrixXd& design,
                   bool worse_when_smaller) {
  Spread spread;
  spread.worse_when_smaller = worse_when_smaller;
  spread.path = std::move(path);
  const Eigen::Map<const Eigen::VectorXd> all(values.data(),
                                              static_cast<Eigen::Index>(values.size()));
  spread.varies = values_vary(values);
  spread.mean = all.mean();
  spread.deviation = all.size() > 1 ? std::sqrt((all.array() - spread.mean).square().sum() /
                                                static_cast<double>(all.size() - 1))
                                    : std::numeric_limits<double>::quiet_NaN();
  Eigen::Index smallest = 0, largest = 0;
  spread.smallest = all.minCoeff(&smallest);
  spread.largest = all.maxCoeff(&largest);
  spread.member_of_smallest = members[smallest];
  spread.member_of_largest = members[largest];
  for (const double share : {0.01, 0.05, 0.5, 0.95, 0.99})
    spread.quantiles.push_back(find_quantile(values, share));
  spread.extremes = worse_when_smaller ? fit_minima(values) : fit_extremes(values);
  const Eigen::VectorXd ranks = ranks_of(all);
  spread.rank_correlation.setZero(design.cols());
  if (!spread.varies) return spread;
  for (Eigen::Index v = 0; v < design.cols(); ++v) {
    Eigen::VectorXd inputs(all.size());
    for (Eigen::Index i = 0; i < all.size(); ++i) inputs[i] = design(members[i], v);
    spread.rank_correlation[v] = correlation(ranks_of(inputs), ranks);
  }
  return spread;
}

}  // namespace blocklift::pipeline
