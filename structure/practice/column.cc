#include "structure/practice/column.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blocklift::structure {
namespace {

constexpr double pi = 3.14159265358979323846;

/// EN 1993-1-1, table 6.1.
double imperfection_factor(BucklingCurve curve) {
  switch (curve) {
    case BucklingCurve::a0:
      return 0.13;
    case BucklingCurve::a:
      return 0.21;
    case BucklingCurve::b:
      return 0.34;
    case BucklingCurve::c:
      return 0.49;
    case BucklingCurve::d:
      break;
  }
  return 0.76;
}

}  // namespace

double euler_load(const Column& column, int axis) {
  return pi * pi * column.elastic_modulus * column.second_moments[axis] /
         (column.length * column.length);
}

double buckling_reduction(double slenderness, BucklingCurve curve) {
  return buckling_reduction(slenderness, imperfection_factor(curve));
}

double buckling_reduction(double slenderness, double imperfection) {
  if (slenderness <= 0.2) return 1;
  const double phi = 0.5 * (1 + imperfection * (slenderness - 0.2) + slenderness * slenderness);
  return std::min(1.0, 1 / (phi + std::sqrt(phi * phi - slenderness * slenderness)));
}

double buckling_resistance(const Column& column) {
  const double area = column.effective_area > 0 ? column.effective_area : column.area;
  const double squash = area * column.yield_stress;
  const double critical = std::min(euler_load(column, 0), euler_load(column, 1));
  const double alpha =
      column.imperfection > 0 ? column.imperfection : imperfection_factor(column.curve);
  return buckling_reduction(std::sqrt(squash / critical), alpha) * squash;
}

double column_utilisation(const Column& column, const ColumnForces& forces, double factor) {
  const double compression = factor * forces.compression;
  double sum = compression > 0 ? compression / buckling_resistance(column)
                               : -compression / (column.area * column.yield_stress);
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double left = 1 - std::max(0.0, compression) / euler_load(column, axis);
    if (left <= 0) return std::numeric_limits<double>::infinity();
    sum += factor * std::abs(forces.moments[i]) /
           (column.section_moduli[i] * column.yield_stress * left);
  }
  return sum;
}

}  // namespace blocklift::structure
