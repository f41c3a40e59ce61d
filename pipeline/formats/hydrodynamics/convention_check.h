#pragma once

#include <string>
#include <vector>

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::pipeline {

/// What a database of another program may have in other units or by another convention than its
/// format says, told by what its figures must be to each other. Half sentences without a stop;
/// none: nothing is found, or the database holds too little to tell.
///
/// - Damping against excitation, where headings go round, or would by the hulls' planes of symmetry
///   (Haskind's relation; Newman 1977, chapter 6):
///
///     B_ii = k/(8 pi rho g c_g) int |X_i(theta)|^2 dtheta.
///
///   The mode of displacement that most frequencies tell of is doubted if the median of its ratio
///   is more than 25 % off, or an error in the frequencies explains it better. Lids and damping
///   that no wave carries off are seen, too, where no mode is free of them.
/// - Heave's excitation against its stiffness, which it tends to in long waves: what does so at the
///   highest frequency has periods in place of frequencies.
/// - Phases of surge, sway and heave in long waves, where a body is held against water that moves
///   as a whole: X = (C - w^2 (rho V + A) + i w B) eta in heave, (i g k (rho V + A) + B g k/w) eta
///   along the wave, as in the relative motion of Morison's equation.
/// - Nothing between surge and pitch, or sway and roll, of a body that has both: a hull beside the
///   water's surface has something, unless it turns without moving water.
/// - Headings that look like radians read as degrees, or degrees as radians.
std::vector<std::string> doubts_about_conventions(const dynamics::HydrodynamicDatabase& database);

}  // namespace blocklift::pipeline
