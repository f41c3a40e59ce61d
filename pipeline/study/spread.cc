#include "pipeline/study/spread.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <openturns/OT.hxx>

#include "algebra/quantile.h"
#include "pipeline/study/pareto_tail.h"

namespace blocklift::pipeline {
namespace {

constexpr std::size_t fewest_for_a_fit = 30;
constexpr int bootstrap_samples = 200;
constexpr double covered = 0.95;

OT::Sample sample_of(const std::vector<double>& values) {
  OT::Sample sample(values.size(), 1);
  for (std::size_t i = 0; i < values.size(); ++i) sample(i, 0) = values[i];
  return sample;
}

/// A law of the family does not fit most samples of itself.
class UnsteadyFit : public std::runtime_error {
 public:
  UnsteadyFit() : std::runtime_error("most samples of a law cannot be fitted again") {}
};

/// The law of a family that fits a sample.
using FitOfLaw = std::function<OT::Distribution(const OT::Sample&)>;

OT::Distribution gumbel_law(const OT::Sample& sample) { return OT::GumbelFactory().build(sample); }

OT::Distribution pareto_law(const OT::Sample& excesses) {
  std::vector<double> values;
  for (OT::UnsignedInteger i = 0; i < excesses.getSize(); ++i) values.push_back(excesses(i, 0));
  const ParetoTail tail = fit_pareto_tail(values);
  return OT::GeneralizedPareto(tail.scale, tail.shape, 0);
}

/// The value below which the share of the law lies, with its interval over samples that are drawn
/// from the law and fitted again. As many of these samples as differ more from their own fit than
/// the given one are the p-value: a law that was fitted to a sample is nearer to it than the tables
/// of Kolmogorov's statistic have it, which are for a law that is known (Lilliefors 1967). The
/// library's own test of that kind would draw and fit samples once more.
/// @throws UnsteadyFit, OT::Exception if there is no such law.
ExtremeFit fit(const std::string& name, const FitOfLaw& fit_law, const OT::Sample& sample,
               double share) {
  const OT::Distribution law = fit_law(sample);
  ExtremeFit result{name, share, law.computeQuantile(share)[0], 0, 0, 0};
  const double difference = OT::FittingTest::ComputeKolmogorovStatistics(sample, law);
  std::vector<double> again;
  int farther = 0;
  for (int b = 0; b < bootstrap_samples; ++b) {
    try {
      const OT::Sample drawn = law.getSample(sample.getSize());
      const OT::Distribution refitted = fit_law(drawn);
      again.push_back(refitted.computeQuantile(share)[0]);
      farther += int{OT::FittingTest::ComputeKolmogorovStatistics(drawn, refitted) >= difference};
    } catch (const OT::Exception&) {
      continue;  // a sample that no law of the family fits
    }
  }
  if (2 * again.size() < std::size_t{bootstrap_samples}) throw UnsteadyFit();
  std::sort(again.begin(), again.end());
  // The given sample is one of them.
  result.p_value = (1.0 + farther) / (1.0 + static_cast<double>(again.size()));
  const auto at = [&](double part) {
    return again[static_cast<std::size_t>(part * static_cast<double>(again.size() - 1))];
  };
  result.low = at((1 - covered) / 2);
  result.high = at((1 + covered) / 2);
  return result;
}

std::vector<ExtremeFit> fit_extremes(std::vector<double> values) {
  std::vector<ExtremeFit> fits;
  if (values.size() < fewest_for_a_fit) return fits;
  if (!values_vary(values)) return fits;
  std::sort(values.begin(), values.end());
  OT::RandomGenerator::SetSeed(1);  // of the bootstrap
  constexpr double share = 0.999;
  // A law that cannot be fitted is not shown.
  const auto try_to = [](const auto& add_fit) {
    try {
      add_fit();
    } catch (const UnsteadyFit&) {
      return;
    } catch (const OT::Exception&) {
      return;
    } catch (const std::invalid_argument&) {
      return;
    }
  };
  try_to([&] { fits.push_back(fit("Gumbel", gumbel_law, sample_of(values), share)); });
  constexpr double tail = 0.1;
  const auto first = static_cast<std::size_t>((1 - tail) * static_cast<double>(values.size()));
  if (values.size() - first < fewest_for_a_fit) return fits;
  const double threshold = values[first - 1];
  std::vector<double> excesses;
  for (std::size_t i = first; i < values.size(); ++i) excesses.push_back(values[i] - threshold);
  try_to([&] {
    const double share_of_tail = 1 - (1 - share) / tail;
    ExtremeFit above = fit("generalised Pareto above the 90 % quantile", pareto_law,
                           sample_of(excesses), share_of_tail);
    // The bootstrap's percentiles are far too narrow here.
    const auto [low, high] = pareto_quantile_interval(excesses, share_of_tail);
    above.share = share;
    above.value += threshold;
    above.low = low + threshold;
    above.high = high + threshold;
    fits.push_back(std::move(above));
  });
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
