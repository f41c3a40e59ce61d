#pragma once

#include <complex>
#include <limits>

#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics::examples {

/// Section of an endless box that floats in water of even depth; m.
struct RectangularSection {
  double breadth = not_a_number, draught = not_a_number, depth = not_a_number;
  /// Water between the box and another one, its mirror image, which moves as its image does;
  /// infinite: alone.
  double gap = std::numeric_limits<double>::infinity();
  /// Of a lid on the gap (DampingLid::rate), rad/s.
  double lid_rate = 0.0;
};

/// What the water does to a metre of such a box while it sways, heaves or rolls (about its middle
/// at the water line): A + B/(i w), over the density. A in m2, or m4 in roll.
///
/// Matched eigenfunctions. Beneath the box (height d, s that above the bottom) and on a side of it
///
///   phi = phi_p + sum_n (c_n f_n(x) + e_n f_n(-x)) cos(n pi s/d),
///   phi = sum_m a_m Z_m(s) E_m(x),
///
/// Z_m the wave and what stays beside it, E_m going outwards or even across the gap; phi_p has the
/// box's motion at its bottom. At its sides the potentials are equal beneath, and the velocities
/// everywhere, beside the box to its own: Galerkin's method with `terms` cosines and as many Z. The
/// velocity is infinite at the edge, and the error falls with their number to the power of 4/3: in
/// a section of 20 x 5 m alone, from 0.8 to 2 rad/s, 60 terms differ from 120 by 0.2 %. Source:
/// Black, Mei and Bray (1971), J. Fluid Mech. 46.
std::complex<double> calc_section_force(const RectangularSection& section, DegreeOfFreedom mode,
                                        double frequency, double gravity, int terms = 60);

}  // namespace blocklift::dynamics::examples
