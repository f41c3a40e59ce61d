#include "pipeline/study/statistics/gumbel_law.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "pipeline/study/statistics/profile_likelihood.h"

namespace blocklift::pipeline {
namespace {

/// Quantile of the law at zero, of scale 1.
double reduced_quantile(double share) { return -std::log(-std::log(share)); }

/// The likelihood of values less their mean over their deviation: no unit is left, and exponentials
/// stay small.
class GumbelLikelihood {
 public:
  explicit GumbelLikelihood(const std::vector<double>& values)
      : values_(values), count_(static_cast<double>(values.size())) {
    if (values.size() < 3) throw std::invalid_argument("Gumbel's law needs three values at least");
    mean_ = std::accumulate(values.begin(), values.end(), 0.0) / count_;
    double squares = 0;
    for (const double value : values) squares += (value - mean_) * (value - mean_);
    deviation_ = std::sqrt(squares / count_);
    if (!(deviation_ > 0)) throw std::invalid_argument("all values are alike");
    for (double& value : values_) value = (value - mean_) / deviation_;
    least_ = *std::ranges::min_element(values_);
  }

  /// Of a given scale the likeliest location follows, which leaves one equation with one root,
  /// scale + mean of value exp(-value / scale) / mean of exp(-value / scale) = 0.
  GumbelLaw likeliest() const {
    const auto is_too_small = [&](double scale) {
      double sum = 0, moment = 0;
      for (const double value : values_) {
        const double weight = std::exp(-(value - least_) / scale);
        sum += weight;
        moment += value * weight;
      }
      return scale + moment / sum < 0;
    };
    double high = 1;
    while (is_too_small(high)) high *= 2;
    const double scale = find_end(1e-6, high, is_too_small);
    double sum = 0;
    for (const double value : values_) sum += std::exp(-(value - least_) / scale);
    return {least_ - scale * std::log(sum / count_), scale};
  }

  double of(const GumbelLaw& law) const {
    double sum = 0;
    for (const double value : values_) {
      const double reduced = (value - law.location) / law.scale;
      sum -= reduced + std::exp(-reduced);
    }
    return sum - count_ * std::log(law.scale);
  }

  /// The likelihood of the likeliest law that has a quantile, by Newton's method for the logarithm
  /// of its scale.
  double of_quantile(double quantile, double reduced, double first_scale) const {
    constexpr int iterations = 50;
    constexpr double longest_step = 0.5, done = 1e-9;
    double logarithm = std::log(first_scale);
    for (int i = 0; i < iterations; ++i) {
      const double inverse = std::exp(-logarithm);
      double slope = -count_, bend = 0;
      for (const double value : values_) {
        const double distance = (value - quantile) * inverse;
        const double weight = std::exp(-(distance + reduced));
        slope += distance * (1 - weight);
        bend -= distance * (1 - weight) + distance * distance * weight;
      }
      const double newton = bend < 0 ? -slope / bend : std::copysign(longest_step, slope);
      const double step = std::clamp(newton, -longest_step, longest_step);
      logarithm += step;
      if (std::abs(step) < done) break;
    }
    const double scale = std::exp(logarithm);
    return of({quantile - scale * reduced, scale});
  }

  double count() const { return count_; }
  double with_unit(double value) const { return mean_ + deviation_ * value; }
  double deviation() const { return deviation_; }

 private:
  std::vector<double> values_;
  double count_, mean_ = 0, deviation_ = 0, least_ = 0;
};

}  // namespace

double GumbelLaw::quantile(double share) const {
  return location + scale * reduced_quantile(share);
}

double GumbelLaw::share_below(double value) const {
  return std::exp(-std::exp(-(value - location) / scale));
}

GumbelLaw fit_gumbel(const std::vector<double>& values) {
  const GumbelLikelihood likelihood(values);
  const GumbelLaw law = likelihood.likeliest();
  return {likelihood.with_unit(law.location), likelihood.deviation() * law.scale};
}

std::pair<double, double> gumbel_quantile_interval(const std::vector<double>& values,
                                                   double share) {
  const GumbelLikelihood likelihood(values);
  const GumbelLaw law = likelihood.likeliest();
  const double value = law.quantile(share), reduced = reduced_quantile(share);
  const double least = likelihood.of(law) - allowed_loss_of_likelihood(likelihood.count());
  const auto is_inside = [&](double quantile) {
    return likelihood.of_quantile(quantile, reduced, law.scale) >= least;
  };
  constexpr double farthest = 1e6;  // times the scale: an end that nothing bounds
  const double step = law.scale / 4;
  const auto end = [&](double first_step) {
    return likelihood.with_unit(find_end_from(value, first_step, farthest * law.scale, is_inside));
  };
  return {end(-step), end(step)};
}

}  // namespace blocklift::pipeline
