#include "algebra/quantile.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace blocklift::algebra {
namespace {

/// What a quantile lies between: its value below, and how far it is on the way to the next.
struct QuantilePlace {
  std::size_t below;
  double part;
};

QuantilePlace place_of_quantile(std::size_t count, double share) {
  const double place = share * static_cast<double>(count - 1);
  const auto below = std::min(static_cast<std::size_t>(place), count - 1);
  return {below, place - static_cast<double>(below)};
}

}  // namespace

double quantile_of(std::vector<double> values, double share) {
  const auto [below, part] = place_of_quantile(values.size(), share);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), at, values.end());
  if (at + 1 == values.end()) return *at;
  return (1 - part) * *at + part * *std::min_element(at + 1, values.end());
}

double quantile_of_sorted(const std::vector<double>& values, double share) {
  const auto [below, part] = place_of_quantile(values.size(), share);
  return (1 - part) * values[below] + part * values[std::min(below + 1, values.size() - 1)];
}

}  // namespace blocklift::algebra
