#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace blocklift::pipeline {

/// By how much the likelihood of a law of two parameters may be less than the highest for a value
/// to lie in its interval of 95 %: what it is for the mean of as many normal values,
/// n/2 ln(1 + t^2 / (n - 2)), t being Student's 97.5 % value of n - 2 degrees, in place of the
/// limit for many, 1.92 (half of the 95 % value of chi-square).
/// @param count of the values, three at least.
double allowed_loss_of_likelihood(double count);

/// The highest value of a function, and where it is.
struct Highest {
  double place = 0;
  double value = -std::numeric_limits<double>::infinity();
};

/// The highest value of a function between two places: the best of a row of them, then by the
/// golden section between its neighbours.
template <class Function>
Highest find_highest(const Function& function, double from, double to) {
  constexpr int places = 32;
  constexpr int sections = 30;
  const double golden = (std::sqrt(5.0) - 1) / 2, step = (to - from) / places;
  Highest best{.place = from};
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

/// The end of what is inside, on the side of a step that doubles until it is out or farther than
/// `farthest` from where it began: an end that nothing bounds.
template <class IsInside>
double find_end_from(double begin, double step, double farthest, const IsInside& is_inside) {
  double inside = begin;
  while (std::abs(inside - begin) < farthest && is_inside(inside + step)) {
    inside += step;
    step *= 2;
  }
  return find_end(inside, inside + step, is_inside);
}

}  // namespace blocklift::pipeline
