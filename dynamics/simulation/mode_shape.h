#pragma once

#include "dynamics/simulation/linearisation.h"

namespace blocklift::dynamics {

/// Fills `mode.bodies` from its shape and scales both, see Mode::shape.
void find_body_motions(const Mechanism& mechanism, const Kinematics& kinematics, Mode& mode);

/// The mode in words, from the motions of its bodies.
///
/// Named are the bodies with the most kinetic energy, until they have 60 % of it, and the kind of
/// motion that has most of the first one's: level displacement "pendulum along x" ("sway" where
/// ropes, springs or pads rather than weight bring it back), upright displacement "bounce", turn
/// about the vertical "yaw", about x "roll about x", about y "pitch about y", about another level
/// axis "rocking about ...", vibration "vibration in" the elastic mode that has most of it. Kinds
/// that have as much of it within 5 % are named together: "pendulum along x and pitch about y".
/// Directions within 15 degrees of an axis of W are named by it. A
/// further body with 5 % of the energy or more that moves the other way is named with "against".
std::string mode_name(const Mechanism& mechanism, const Kinematics& kinematics, const Mode& mode);

}  // namespace blocklift::dynamics
