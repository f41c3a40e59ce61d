#include "structure/envelope/span_maximum.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "structure/envelope/coordinate_motions.h"

namespace blocklift::structure {

namespace {

constexpr int squares_at_once = 256;

// Unit responses of chosen squares: rows 3 place + c (11, 22, 12), Pa.
Eigen::MatrixXd components_of(const CheckedStress& checked, const int* squares, int count) {
  Eigen::MatrixXd components(3L * count, checked.components().cols());
  for (int i = 0; i < count; ++i)
    components.middleRows<3>(3L * i) = checked.components().middleRows<3>(3L * squares[i]);
  return components;
}

std::vector<int> in_falling_order(const Eigen::VectorXd& bounds) {
  std::vector<int> order(static_cast<std::size_t>(bounds.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return bounds[a] > bounds[b] || (bounds[a] == bounds[b] && a < b);
  });
  return order;
}

LargestValue largest_of_squares(const CheckedStress& checked, const LoadHistory& history,
                                const Eigen::VectorXd& bounds, int threads) {
  const std::vector<int> order = in_falling_order(bounds);
  const int squares = static_cast<int>(order.size());
  LargestValue largest;
  for (int begin = 0; begin < squares; begin += squares_at_once) {
    if (largest.point >= 0 && bounds[order[begin]] <= largest.value) break;
    const int count = std::min(squares_at_once, squares - begin);
    const auto components = [&](int first, int some) {
      return components_of(checked, &order[begin + first], some);
    };
    const LargestValue found = find_largest_in_plane(history, count, components, threads);
    if (found.point >= 0 && (largest.point < 0 || found.value > largest.value))
      largest = {found.value, order[begin + found.point], found.instant};
  }
  return largest;
}

LargestValue largest_of_points(const UnitResponses& responses, const StressPoints& points,
                               const LoadHistory& history, int threads) {
  const Eigen::MatrixXd motions = motions_in_coordinates(responses, history);
  return find_largest_stresses(
             history, points.count(), PointResponses::of_coordinates([&](int first, int count) {
               return points.stresses(first, count, motions);
             }),
             1, [](int) { return 0; }, threads)
      .von_mises.front();
}

}  // namespace

TimedExtreme find_largest_in_span(const UnitResponses& responses, const StressRecovery& recovery,
                                  const Eigen::MatrixXd& factors, const Eigen::VectorXd& bounds,
                                  int threads) {
  const Mesh& mesh = responses.model().mesh();
  const CheckedStress& checked = recovery.checked();
  const StressPoints& points = recovery.points();
  const LoadHistory history(factors, response_weights(responses, recovery));
  TimedExtreme extreme;
  if (checked.squares().empty()) {
    const LargestValue largest = largest_of_points(responses, points, history, threads);
    if (largest.point < 0) return extreme;
    extreme.value = largest.value;
    extreme.instant = largest.instant;
    extreme.point_B = points.place(largest.point);
    extreme.part = mesh.regions[points.region(largest.point)].name;
    extreme.unit_stress = points.stresses(largest.point, 1, responses.displacements());
    return extreme;
  }
  const LargestValue largest = largest_of_squares(checked, history, bounds, threads);
  if (largest.point < 0) return extreme;
  const Square& square = checked.squares()[largest.point];
  extreme.value = largest.value;
  extreme.instant = largest.instant;
  extreme.point_B = square.centre_B;
  extreme.part = mesh.regions[square.region].name;
  extreme.unit_stress = unit_stress_of_square(checked, largest.point);
  return extreme;
}

}  // namespace blocklift::structure
