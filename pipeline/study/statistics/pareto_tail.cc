#include "pipeline/study/statistics/pareto_tail.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "pipeline/study/statistics/profile_likelihood.h"

namespace blocklift::pipeline {
namespace {

constexpr double least_shape = -0.5;
constexpr double largest_shape = 3;
constexpr double straight = 1e-9;  // shapes nearer to zero are exponential to the last digits
constexpr double impossible = -std::numeric_limits<double>::infinity();

/// Quantile of a tail of scale 1.
double unit_quantile(double shape, double share) {
  const double exponential = -std::log1p(-share);
  return std::abs(shape) < straight ? exponential : std::expm1(shape * exponential) / shape;
}

class TailLikelihood {
 public:
  explicit TailLikelihood(const std::vector<double>& excesses)
      : excesses_(excesses), count_(static_cast<double>(excesses.size())) {
    if (excesses.size() < 3) throw std::invalid_argument("a tail needs three excesses at least");
    largest_ = *std::ranges::max_element(excesses);
    mean_ = std::accumulate(excesses.begin(), excesses.end(), 0.0) / count_;
    if (!(largest_ > 0)) throw std::invalid_argument("no excess is above zero");
  }

  double of(const ParetoTail& tail) const {
    if (std::abs(tail.shape) < straight)
      return -count_ * (std::log(tail.scale) + mean_ / tail.scale);
    const double ratio = tail.shape / tail.scale;
    if (!(1 + ratio * largest_ > 0)) return impossible;
    return -count_ * std::log(tail.scale) - (1 + 1 / tail.shape) * sum_of_logarithms(ratio);
  }

  /// Of a given ratio of shape to scale the likeliest shape is a mean of logarithms (Grimshaw
  /// 1993): one variable is left. It is the logarithm of 1 + ratio times the largest excess.
  ParetoTail likeliest() const {
    constexpr double far = 8;
    const auto of_variable = [&](double variable) { return of(tail_of(variable)); };
    const Highest inside = find_highest(of_variable, -far, far);
    const auto at_edge = [&](double scale) { return of({scale, least_shape}); };
    const Highest edge =
        find_highest(at_edge, -least_shape * largest_, -8 * least_shape * largest_);
    return edge.value > inside.value ? ParetoTail{edge.place, least_shape} : tail_of(inside.place);
  }

  /// The likelihood of the likeliest tail that has a quantile.
  double of_quantile(double quantile, double share) const {
    const auto of_shape = [&](double shape) {
      return of({quantile / unit_quantile(shape, share), shape});
    };
    return find_highest(of_shape, least_shape, largest_shape).value;
  }

  double count() const { return count_; }

 private:
  double sum_of_logarithms(double ratio) const {
    double sum = 0;
    for (const double excess : excesses_) sum += std::log1p(ratio * excess);
    return sum;
  }

  /// A scale that is not a number, which has no likelihood, where the shape is out of its range.
  ParetoTail tail_of(double variable) const {
    const double ratio = std::expm1(variable) / largest_;
    const double shape = sum_of_logarithms(ratio) / count_;
    if (std::abs(shape) < straight) return {mean_, 0};
    if (shape < least_shape || shape > largest_shape)
      return {std::numeric_limits<double>::quiet_NaN(), shape};
    return {shape / ratio, shape};
  }

  const std::vector<double>& excesses_;
  double count_, largest_ = 0, mean_ = 0;
};

}  // namespace

double ParetoTail::quantile(double share) const { return scale * unit_quantile(shape, share); }

double ParetoTail::share_below(double excess) const {
  if (std::abs(shape) < straight) return -std::expm1(-excess / scale);
  const double inside = 1 + shape * excess / scale;
  return inside > 0 ? -std::expm1(-std::log(inside) / shape) : 1;
}

ParetoTail fit_pareto_tail(const std::vector<double>& excesses) {
  return TailLikelihood(excesses).likeliest();
}

std::pair<double, double> pareto_quantile_interval(const std::vector<double>& excesses,
                                                   double share) {
  const TailLikelihood likelihood(excesses);
  const ParetoTail tail = likelihood.likeliest();
  const double value = tail.quantile(share);
  const double least = likelihood.of(tail) - allowed_loss_of_likelihood(likelihood.count());
  const auto is_inside = [&](double quantile) {
    return likelihood.of_quantile(quantile, share) >= least;
  };
  constexpr double farthest = 1e6;  // times the value: an end that nothing bounds
  return {find_end(value, 1e-3 * value, is_inside),
          find_end_from(value, value / 4, farthest * value, is_inside)};
}

}  // namespace blocklift::pipeline
