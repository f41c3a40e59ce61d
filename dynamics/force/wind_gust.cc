#include "dynamics/force/wind_gust.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

/// Shares of the duration at which a gust is looked at: ends, extremes, and places between.
std::vector<double> shares_of(WindGust::Shape shape) {
  using std::numbers::pi;
  switch (shape) {
    case WindGust::Shape::one_minus_cosine:
    case WindGust::Shape::coherent_rise:
      return {0.0, 0.25, 0.5, 0.75, 1.0};
    case WindGust::Shape::operating: {
      // d/dx [sin 3a (1 - cos 2a)] = 0, a = pi x, is cos(a)^2 = 11/20, or a = pi/2.
      const double dip = std::acos(std::sqrt(11.0 / 20.0)) / pi;
      return {0.0, dip, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0 - dip, 1.0};
    }
  }
  return {};
}

}  // namespace

WindGust::WindGust(Shape shape, double magnitude, double start, double duration)
    : shape_(shape), magnitude_(magnitude), duration_(duration) {
  if (!std::isfinite(start) || start < 0.0 || !std::isfinite(magnitude) || !(magnitude > 0.0) ||
      !std::isfinite(duration) || !(duration > 0.0)) {
    throw ModelError("a gust has the magnitude " + std::to_string(magnitude) + ", the start " +
                     std::to_string(start) + " and the duration " + std::to_string(duration) +
                     "; a start from zero, and a magnitude and duration above zero are due");
  }
  for (const double share : shares_of(shape)) times_.push_back(start + share * duration);
}

WindGust::WindGust(std::vector<double> times, std::vector<double> speeds)
    : times_(std::move(times)), speeds_(std::move(speeds)) {
  if (times_.size() < 2 || times_.size() != speeds_.size()) {
    throw ModelError("a gust has " + std::to_string(times_.size()) + " times and " +
                     std::to_string(speeds_.size()) +
                     " speeds; two points and one of each for each point are due");
  }
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (!std::isfinite(times_[i]) || !std::isfinite(speeds_[i])) {
      throw ModelError("point " + std::to_string(i + 1) + " of a gust is not finite");
    }
    if (i > 0 && !(times_[i] > times_[i - 1])) {
      throw ModelError("the times of a gust must ascend, but " + std::to_string(times_[i]) +
                       " s follows " + std::to_string(times_[i - 1]) + " s");
    }
  }
}

double WindGust::evaluate(double time) const {
  using std::numbers::pi;
  if (!speeds_.empty()) {
    if (time <= times_.front()) return speeds_.front();
    if (time >= times_.back()) return speeds_.back();
    const auto upper = std::upper_bound(times_.begin(), times_.end(), time);
    const auto i = static_cast<std::size_t>(upper - times_.begin());
    const double share = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
    return std::lerp(speeds_[i - 1], speeds_[i], share);
  }
  const double x = (time - times_.front()) / duration_;
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return shape_ == Shape::coherent_rise ? magnitude_ : 0.0;
  switch (shape_) {
    case Shape::one_minus_cosine:
      return 0.5 * magnitude_ * (1.0 - std::cos(2.0 * pi * x));
    case Shape::coherent_rise:
      return 0.5 * magnitude_ * (1.0 - std::cos(pi * x));
    case Shape::operating:
      return -0.37 * magnitude_ * std::sin(3.0 * pi * x) * (1.0 - std::cos(2.0 * pi * x));
  }
  return 0.0;
}

double WindGust::lowest() const {
  double least = evaluate(times_.front());
  for (const double time : times_) least = std::min(least, evaluate(time));
  return least;
}

double WindGust::highest() const {
  double most = evaluate(times_.front());
  for (const double time : times_) most = std::max(most, evaluate(time));
  return most;
}

}  // namespace blocklift::dynamics
