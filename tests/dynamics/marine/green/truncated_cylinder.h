#pragma once

#include <array>

namespace blocklift::dynamics::test {

/// Added mass over rho a^3 and damping over rho a^3, 1/s, of a vertical cylinder of radius a = 1 m
/// and draught 0.5 m in deep water, g = 9.80665 m/s^2, by matched eigenfunctions (Yeung 1981).
struct CylinderForces {
  double w;  ///< rad/s
  double surge_A, heave_A, surge_B, heave_B;
};
inline constexpr std::array<CylinderForces, 4> truncated_cylinder = {
    {{1.0, .68333, 2.43399, .001261, .38273},
     {1.4, .72495, 2.28487, .012839, .80505},
     {3.0, .88176, 1.55601, 1.43016, 1.45673},
     {4.0, .43641, 1.48549, 2.70330, .83563}}};

}  // namespace blocklift::dynamics::test
