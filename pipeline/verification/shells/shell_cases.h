#pragma once

#include <vector>

#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Cases of shells and beams.
std::vector<VerificationCase> shell_cases();

/// MacNeal and Harder's patch: membrane, bending, twist, shear.
std::vector<VerificationCase> patch_cases();
/// Clamped and simply supported square plates of any thickness, skew plates.
std::vector<VerificationCase> plate_cases();
/// Curved shells: roof, cylinder, hemispheres, hook.
std::vector<VerificationCase> curved_shell_cases();
/// MacNeal and Harder's beams of shells: straight with distorted elements, curved, twisted.
std::vector<VerificationCase> strip_cases();
/// Membrane stress: NAFEMS LE1, Cook's membrane.
std::vector<VerificationCase> membrane_cases();
/// Natural modes of plates and of a stiffened box.
std::vector<VerificationCase> vibration_cases();
/// NAFEMS' beams, tapered membrane, clamped rhombus and Z section.
std::vector<VerificationCase> nafems_cases();
/// Girders: stiffened plates, box and I sections, and what drilling stiffness does to them.
std::vector<VerificationCase> girder_cases();
/// A box girder in bending.
std::vector<VerificationCase> box_girder_cases();
/// Beams, rods, links, springs and masses.
std::vector<VerificationCase> frame_cases();

}  // namespace blocklift::pipeline
