#pragma once

#include <string>
#include <vector>

namespace blocklift::structure {

/// Padeye: a main plate with a hole for a shackle's pin, and a cheek plate on each side of it or
/// none.
///
/// In its frame P the origin is the middle of the hole, x runs along the base, y away from it, z
/// along the pin. The main plate ends in an arc about the hole; straight edges touch the arc and
/// run down to the ends of the base y = -height. All lengths in m.
struct PadeyeGeometry {
  double radius = 0;           ///< of the main plate about the hole
  double thickness = 0;        ///< of the main plate
  double hole_diameter = 0;    ///< D_H
  double pin_diameter = 0;     ///< D_p
  double cheek_radius = 0;     ///< 0 without cheek plates
  double cheek_thickness = 0;  ///< of each cheek plate
  double height = 0;           ///< from the base to the middle of the hole
  double base_left = 0;        ///< of the base, towards -x
  double base_right = 0;       ///< of the base, towards +x

  bool has_cheeks() const { return cheek_thickness > 0; }
  /// Thickness that the pin bears on.
  double bearing_thickness() const { return thickness + 2 * cheek_thickness; }
};

/// What is wrong with a padeye's measures, a sentence each with the figures; empty: nothing.
/// Circles lie within one another (hole, cheek plate, main plate, base), and the pin within its
/// hole.
std::vector<std::string> padeye_faults(const PadeyeGeometry& padeye);

}  // namespace blocklift::structure
