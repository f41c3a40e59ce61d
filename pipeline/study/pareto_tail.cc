#include "pipeline/study/pareto_tail.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <openturns/DistFunc.hxx>

namespace blocklift::pipeline {
namespace {

constexpr double least_shape = -0.5;
constexpr double largest_shape = 3;
constexpr double straight = 1e-9;  // shapes nearer to zero are exponential to the last digits
constexpr double impossible = -std::numeric_limits<double>::infinity();

struct Highest {
  double place, value;
};

/// The highest value of a function between two places: the best of a row of them, then by the
/// golden section between its neighbours.
template <class Function>
Highest find_highest(const Function& function, double from, double to) {
  constexpr int places = 32;
  constexpr int sections = 30;
  const double golden = (std::sqrt(5.0) - 1) / 2, step = (to - from) / places;
  Highest best{from, impossible};
  for (int i = 0; i <= places; ++i) {
    const double place = from + step * i;
    if (const double value = function(place); value > best.value) best = {place, value};
  }
  double low = std::max(from, best.place - step), high = std::min(to, best.place + step);
  const auto at = [&](double share) {
    const double place = low + share * (high - low);
    return Highest{place, function(place)};
  };
  Highest left = at(1 - golden), right = at(golden);
  for (int i = 0; i < sections; ++i) {
    const bool is_right = left.value < right.value;
    if (const Highest& higher = is_right ? right : left; higher.value > best.value) best = higher;
    (is_right ? low : high) = is_right ? left.place : right.place;
    (is_right ? left : right) = is_right ? right : left;
    (is_right ? right : left) = at(is_right ? golden : 1 - golden);
  }
  return best;
}

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

  /// By how much a quantile's likelihood may be less than the highest.
  double allowed_loss() const {
    const double student = OT::DistFunc::qStudent(count_ - 2, 0.975);
    return count_ / 2 * std::log1p(student * student / (count_ - 2));
  }

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

/// Halves the way from a place that is inside to one that is not; the last that is.
template <class IsInside>
double find_end(double inside, double outside, const IsInside& is_inside) {
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (inside + outside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

double ParetoTail::quantile(double share) const { return scale * unit_quantile(shape, share); }

ParetoTail fit_pareto_tail(const std::vector<double>& excesses) {
  return TailLikelihood(excesses).likeliest();
}

std::pair<double, double> pareto_quantile_interval(const std::vector<double>& excesses,
                                                   double share) {
  const TailLikelihood likelihood(excesses);
  const ParetoTail tail = likelihood.likeliest();
  const double value = tail.quantile(share);
  const double least = likelihood.of(tail) - likelihood.allowed_loss();
  const auto is_inside = [&](double quantile) {
    return likelihood.of_quantile(quantile, share) >= least;
  };
  constexpr double farthest = 1e6;  // times the value: an end that nothing bounds
  double step = value / 4, inside = value;
  while (inside < farthest * value && is_inside(inside + step)) {
    inside += step;
    step *= 2;
  }
  return {find_end(value, 1e-3 * value, is_inside), find_end(inside, inside + step, is_inside)};
}

}  // namespace blocklift::pipeline
