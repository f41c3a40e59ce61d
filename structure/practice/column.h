#pragma once

#include <array>

namespace blocklift::structure {

/// Buckling curves of EN 1993-1-1, table 6.1, from the least imperfect to the most.
enum class BucklingCurve { a0, a, b, c, d };

/// Straight bar of constant section that does not twist, pinned at its ends, pressed and bent. Its
/// axes of bending are the section's principal ones, y level and z upright; infinite figures of an
/// axis: held against bending about it.
struct Column {
  double area = 0;                         ///< m^2
  double effective_area = 0;               ///< where walls buckle locally, m^2; 0: all of it
  double elastic_modulus = 210e9;          ///< Pa
  double yield_stress = 0;                 ///< Pa
  double length = 0;                       ///< between the pins, m
  std::array<double, 2> second_moments{};  ///< I_y, I_z, m^4
  std::array<double, 2> section_moduli{};  ///< W_y, W_z of the outermost fibre, m^3
  BucklingCurve curve = BucklingCurve::c;
  double imperfection = 0;  ///< alpha in place of the curve's; 0: the curve's
};

/// Forces within a section.
struct ColumnForces {
  double compression = 0;           ///< N; negative where it is pulled
  std::array<double, 2> moments{};  ///< M_y, M_z, N m
};

/// Euler's load pi^2 E I / L^2 of bending about an axis (0: y, 1: z), N.
double euler_load(const Column& column, int axis);

/// Reduction factor chi by the slenderness sqrt(A f_y / N_cr): EN 1993-1-1, 6.3.1.2, equation 6.49.
double buckling_reduction(double slenderness, BucklingCurve curve);
/// The same for an imperfection factor alpha of its own.
double buckling_reduction(double slenderness, double imperfection);

/// Characteristic buckling resistance chi A f_y about the weaker axis, N, A the effective area: EN
/// 1993-1-1, 6.3.1.1.
double buckling_resistance(const Column& column);

/// What a bar bears over what it may bear, all forces having been multiplied by a factor:
///   N / (chi A f_y) + sum over y, z of  M / (W f_y (1 - N / N_cr)).
/// The first term is equation 6.46 of EN 1993-1-1; the moments grow by 5.2.2(5), which holds for
/// the first half wave of a pinned bar, and add up linearly as in 6.2.1(7). Pulled, it is N / (A
/// f_y) and moments without growth. Closed sections do not buckle sideways under bending
/// (6.3.2.1(2)). Infinite from Euler's load on.
double column_utilisation(const Column& column, const ColumnForces& forces, double factor);

}  // namespace blocklift::structure
