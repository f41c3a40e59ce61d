#pragma once

#include <string>

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// Heavy elastic line between two points: what it weighs, how it stretches.
struct CatenaryLine {
  double unstretched_length = not_a_number;  ///< L0, m
  double weight_per_length = not_a_number;   ///< w: submerged, of the unstretched line, N/m
  double axial_stiffness = not_a_number;     ///< EA, N
  /// Does the line lie on a level, smooth bottom at the height of its lower end, where it is slack
  /// enough? Otherwise it hangs free all along.
  bool on_seabed = false;
};

/// Shape and forces of a line in equilibrium.
struct Catenary {
  double horizontal = not_a_number;  ///< H: the same all along, N
  double vertical = not_a_number;    ///< V: upper end pulls its body down with V, N
  double lower_vertical =
      not_a_number;               ///< the lower end pulls its body up with this, N: V - w L0, or 0
  double tension = not_a_number;  ///< at the upper end, N
  double lower_tension = not_a_number;  ///< at the lower end, N
  double lying_length = 0.0;            ///< unstretched, on the bottom, m
  /// Elastic and gravity energy, with the line's weight counted from its lower end, J.
  double energy = not_a_number;
  /// d(H, V)/d(span, rise), symmetric, N/m.
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Constant(not_a_number);
};

/// The line between ends that are `span` (m, level, not negative) and `rise` (m, upper over lower
/// end; may be negative where it hangs free) apart.
///
/// Span and rise are the derivatives of a convex function of H and V, the complementary energy
///   Phi = int_0^L0 (T + T^2/(2 EA)) ds,   T = sqrt(H^2 + v^2),   v = V - w (L0 - s), not below 0
///     on
/// the bottom, so that Newton's method with a line search finds them from anywhere; the energy is
/// H span + V rise - Phi. Where the line is so slack that it lies in a heap under its upper end, H
/// is zero. Does not allocate.
/// Source: Irvine, Cable Structures (1981), sec. 2.3; Jonkman (2007), app. B.
/// @throws SimulationError if no equilibrium is found, ModelError if the line cannot be.
Catenary calc_catenary(const CatenaryLine& line, double span, double rise);

/// @throws ModelError naming the line, if length, weight or stiffness is not positive.
void require_line(const CatenaryLine& line, const std::string& name);

}  // namespace blocklift::dynamics
