#include "pipeline/measurement/snatches.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "algebra/quantile.h"

namespace blocklift::pipeline {
namespace {

/// Samples on each side that make a median, and those behind a leap that are looked at.
constexpr std::size_t half_of_a_median = 10, samples_behind = 24;
constexpr double slack = 0.05, taut = 0.2;  // of the load

}  // namespace

Snatches::Snatches(const std::vector<double>& values, double limit)
    : values_(values), limit_(limit) {
  constexpr double mostly = 0.5, usual = 0.95;
  if (values.empty()) return;
  load_ = algebra::quantile_of(values, mostly);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < values.size(); ++i) sizes.push_back(std::abs(stand_off(i)));
  usual_ = algebra::quantile_of(std::move(sizes), usual);
}

double Snatches::stand_off(std::size_t i) const {
  const std::size_t first = i - std::min(i, half_of_a_median),
                    last = std::min(i + half_of_a_median + 1, values_.size());
  const std::vector<double> about(values_.begin() + static_cast<std::ptrdiff_t>(first),
                                  values_.begin() + static_cast<std::ptrdiff_t>(last));
  return values_[i] - algebra::quantile_of(about, 0.5);
}

double Snatches::median_behind(std::size_t i) const {
  const std::size_t last = std::min(i + samples_behind, values_.size());
  if (i >= last) return 0;
  return algebra::quantile_of({values_.begin() + static_cast<std::ptrdiff_t>(i),
                               values_.begin() + static_cast<std::ptrdiff_t>(last)},
                              0.5);
}

bool Snatches::comes_taut(const FaultySamples& one) const {
  const double load = std::abs(load_);
  if (one.begin == 0 || std::abs(values_[one.begin - 1]) > slack * load ||
      std::abs(median_behind(one.end)) < taut * load)
    return false;
  for (std::size_t i = one.begin - 1; i > 0; --i) {
    if (std::abs(values_[i - 1] - values_[i]) > limit_) return false;
    if (std::abs(values_[i - 1]) > taut * load) return true;
  }
  return true;  // slack from the beginning
}

bool Snatches::is_alone(std::size_t begin, std::size_t end) const {
  constexpr std::size_t samples_about = 4;
  constexpr double far = 2;  // times what dances beside it
  const auto farthest = [&](std::size_t from, std::size_t to) {
    double most = 0;
    for (std::size_t i = from; i < to; ++i) most = std::max(most, std::abs(stand_off(i)));
    return most;
  };
  const std::size_t first = begin - std::min(begin, samples_about),
                    last = std::min(end + samples_about, values_.size());
  return farthest(begin, end) > far * std::max(farthest(first, begin), farthest(end, last));
}

bool Snatches::belongs_to(const FaultySamples& snatch, const FaultySamples& one) const {
  constexpr double as_high = 1.5;  // samples need not meet the crest of the snatch itself
  // The dance that goes on behind a spike is the snatch's, and makes no snatch of the spike.
  return !is_alone(one.begin, one.end) &&
         (std::abs(one.leap) < as_high * std::abs(snatch.leap) || is_snatch(one));
}

bool Snatches::dances_behind(const FaultySamples& one) const {
  constexpr double far = 2;  // times what is usual
  constexpr int fewest_turns = 3;
  const std::size_t end = std::min(one.end + samples_behind, values_.size());
  double last = one.leap;
  int turns = 0;
  std::vector<double> heights;  // of each half swing
  for (std::size_t i = one.begin + 1; i < end; ++i) {
    const double off = stand_off(i);
    if (std::abs(off) <= far * usual_ || is_alone(i, i + 1)) continue;
    if (off * last < 0) {
      ++turns;
      heights.push_back(0);
    }
    if (!heights.empty()) heights.back() = std::max(heights.back(), std::abs(off));
    last = off;
  }
  return turns >= fewest_turns && heights.back() < heights.front() &&
         heights.front() < 1.5 * std::abs(one.leap);
}

bool Snatches::is_snatch(const FaultySamples& one) const {
  return one.leap * load_ > 0 && (comes_taut(one) || dances_behind(one));
}

std::vector<FaultySamples> Snatches::among(const std::vector<FaultySamples>& leaps) const {
  std::vector<FaultySamples> in_order;
  std::ranges::copy_if(leaps, std::back_inserter(in_order), [](const FaultySamples& one) {
    return one.fault == Fault::spike || one.fault == Fault::drop_out;
  });
  std::ranges::sort(in_order, {}, &FaultySamples::begin);
  std::vector<FaultySamples> found;
  for (const FaultySamples& one : in_order) {
    const bool follows = !found.empty() && one.begin < found.back().end + samples_behind;
    if (follows ? belongs_to(found.back(), one) : is_snatch(one)) found.push_back(one);
  }
  return found;
}

}  // namespace blocklift::pipeline
