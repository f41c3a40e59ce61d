#include "pipeline/measurement/load_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "algebra/quantile.h"

namespace blocklift::pipeline {
namespace {

/// How far a tension jumps, and what it was before.
struct TensionJump {
  double step = 0, before = 0;
};

std::optional<TensionJump> jump_at(const TensionPair& pair, double instant) {
  constexpr std::ptrdiff_t samples_on_a_side = 20;
  const TimeSeries& measured = *pair.measured;
  const auto first_behind = std::ranges::lower_bound(measured.time, instant - 1e-9);
  const std::ptrdiff_t middle = first_behind - measured.time.begin(),
                       size = static_cast<std::ptrdiff_t>(measured.size());
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, middle - samples_on_a_side),
                       end = std::min(size, middle + samples_on_a_side);
  if (begin == middle || middle == end) return std::nullopt;
  std::vector<double> computed;
  for (const double time : measured.time) computed.push_back(pair.computed->at(time));
  const double computed_load = typical_load(computed);
  const double scale = computed_load != 0 ? typical_load(measured.values) / computed_load : 1;
  const auto level = [&](std::ptrdiff_t from, std::ptrdiff_t to, double part_of_computed) {
    std::vector<double> values;
    for (std::ptrdiff_t i = from; i < to; ++i)
      values.push_back(measured.values[i] - part_of_computed * computed[i]);
    return algebra::quantile_of(std::move(values), 0.5);
  };
  // Jumps of several cells are added up, and the sign of one may be reversed.
  const double sign = std::copysign(1.0, scale);
  return TensionJump{sign * (level(middle, end, scale) - level(begin, middle, scale)),
                     sign * level(begin, middle, 0)};
}

bool is_taken_over(const TensionJump& own, const std::vector<TensionJump>& others) {
  double sum = own.step;
  for (const TensionJump& other : others) sum += other.step;
  return std::abs(sum) < 0.5 * std::abs(own.step);
}

bool is_shared_by_all(const TensionJump& own, const std::vector<TensionJump>& others) {
  constexpr double alike = 0.25, least_left = 0.1;
  if (own.before == 0) return false;
  const double share = own.step / own.before;
  return 1 + share > least_left && std::ranges::all_of(others, [&](const TensionJump& other) {
           return other.before != 0 &&
                  std::abs(other.step / other.before - share) < alike * std::abs(share);
         });
}

}  // namespace

double typical_load(const std::vector<double>& values) {
  constexpr double loaded = 0.9;
  std::vector<double> sizes;
  double sum = 0;
  for (const double value : values) {
    sizes.push_back(std::abs(value));
    sum += value;
  }
  return std::copysign(algebra::quantile_of(std::move(sizes), loaded), sum);
}

bool is_load_change(const TensionPair& own, std::size_t jump,
                    const std::vector<TensionPair>& others) {
  const double instant = own.measured->time[jump];
  const std::optional<TensionJump> of_own = jump_at(own, instant);
  std::vector<TensionJump> of_others;
  for (const TensionPair& other : others)
    if (const auto one = jump_at(other, instant)) of_others.push_back(*one);
  if (!of_own || of_others.empty()) return false;
  return is_taken_over(*of_own, of_others) || is_shared_by_all(*of_own, of_others);
}

}  // namespace blocklift::pipeline
