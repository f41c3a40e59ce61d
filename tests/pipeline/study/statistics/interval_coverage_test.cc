// How many intervals of samples hold what they are of, and how often a fit's p lies below a value,
// over many samples. Figures that comments of the laws give are those that this program prints.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/study/statistics/goodness_of_fit.h"
#include "pipeline/study/statistics/gumbel_law.h"
#include "pipeline/study/statistics/pareto_tail.h"

namespace blocklift::pipeline {
namespace {

using Values = std::vector<double>;
using Interval = std::pair<double, double>;

constexpr int samples = 400;

/// Values of a law that is known by its quantiles; the same on every machine.
class Drawing {
 public:
  template <class Law>
  Values from(const Law& law, std::size_t count) {
    Values values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(law.quantile((static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53));
    return values;
  }

 private:
  std::mt19937_64 engine_{1};
};

/// What is between percentiles of a quantile's values over samples that are drawn from a fit and
/// fitted again: the parametric bootstrap, which is what the profile likelihood is held against.
template <class Fit>
Interval bootstrap_interval(const Fit& fit, const Values& values, double share, Drawing& drawing) {
  constexpr int redrawn = 200;
  const auto law = fit(values);
  Values again;
  for (int i = 0; i < redrawn; ++i)
    again.push_back(fit(drawing.from(law, values.size())).quantile(share));
  std::ranges::sort(again);
  return {again[5], again[redrawn - 6]};
}

template <class Law>
double p_of(const Law& law, const Values& values,
            const std::function<double(double statistic)>& p_of_statistic) {
  Values shares;
  for (const double value : values) shares.push_back(law.share_below(value));
  return p_of_statistic(anderson_darling(std::move(shares)));
}

bool holds(const Interval& interval, double truth) {
  return interval.first <= truth && truth <= interval.second;
}

struct Share {
  int count = 0;
  double value() const { return static_cast<double>(count) / samples; }
};

// Of 400 intervals of which each holds the truth at 95 %, 92 % or more do but once in 200 times.
TEST(IntervalCoverage, OfGumbelsQuantiles) {
  for (const std::size_t figures : {30, 60, 300}) {
    Drawing drawing;
    const GumbelLaw law{3, 2};
    constexpr double share = 0.999;
    const double truth = law.quantile(share);
    Share of_profile, of_bootstrap, rejected;
    for (int i = 0; i < samples; ++i) {
      const Values values = drawing.from(law, figures);
      of_profile.count += int{holds(gumbel_quantile_interval(values, share), truth)};
      of_bootstrap.count +=
          int{holds(bootstrap_interval(fit_gumbel, values, share, drawing), truth)};
      rejected.count += int{p_of(fit_gumbel(values), values, p_of_gumbel_fit) < 0.05};
    }
    std::printf("%zu figures: profile %.3f, bootstrap %.3f, p below 0.05: %.3f\n", figures,
                of_profile.value(), of_bootstrap.value(), rejected.value());
    EXPECT_GE(of_profile.value(), 0.92) << figures;
    EXPECT_GE(of_profile.count, of_bootstrap.count) << figures;
    EXPECT_LT(rejected.value(), 0.08) << figures;
  }
}

TEST(IntervalCoverage, OfParetosQuantiles) {
  constexpr std::size_t figures = 300, beyond = 30;
  for (const double shape : {-0.3, 0.0, 0.2}) {
    Drawing drawing;
    const ParetoTail law{1, shape};
    Share of_profile, of_bootstrap;
    for (int i = 0; i < samples; ++i) {
      Values values = drawing.from(law, figures);
      std::ranges::sort(values);
      const double threshold = values[figures - beyond - 1];
      Values excesses;
      for (std::size_t k = figures - beyond; k < figures; ++k)
        excesses.push_back(values[k] - threshold);
      const double truth = law.quantile(0.999) - threshold;
      constexpr double share = 0.99;
      of_profile.count += int{holds(pareto_quantile_interval(excesses, share), truth)};
      of_bootstrap.count +=
          int{holds(bootstrap_interval(fit_pareto_tail, excesses, share, drawing), truth)};
    }
    std::printf("shape %4.1f: profile %.3f, bootstrap %.3f\n", shape, of_profile.value(),
                of_bootstrap.value());
    EXPECT_GE(of_profile.value(), 0.92) << shape;
    EXPECT_GT(of_profile.count, of_bootstrap.count) << shape;
  }
}

// p is that of many values: of 30 it is to reject one true law in twenty, too.
TEST(IntervalCoverage, OneInTwentyParetoTailsIsRejected) {
  for (const std::size_t figures : {30, 100})
    for (const double shape : {-0.3, 0.0, 0.2, 0.5}) {
      Drawing drawing;
      const ParetoTail law{2, shape};
      Share rejected, doubtful;
      for (int i = 0; i < samples; ++i) {
        const Values values = drawing.from(law, figures);
        const ParetoTail fit = fit_pareto_tail(values);
        const double p = p_of(
            fit, values, [&](double statistic) { return p_of_pareto_fit(statistic, fit.shape); });
        rejected.count += int{p < 0.05};
        doubtful.count += int{p < 0.5};
      }
      std::printf("%3zu excesses of shape %4.1f: p below 0.05: %.3f, below 0.5: %.3f\n", figures,
                  shape, rejected.value(), doubtful.value());
      EXPECT_LT(rejected.value(), 0.08) << shape;
      EXPECT_NEAR(doubtful.value(), 0.5, 0.1) << shape;
    }
}

}  // namespace
}  // namespace blocklift::pipeline
