#pragma once

#include <string>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// Beyond this share of the checked stress an error of the mesh makes the verdict indicative.
inline constexpr double largest_mesh_error = 0.1;

/// Why the verdict is indicative only, as a sentence without a full stop; empty if it stands.
///
/// It is where the last refinement moved the checked stress by more than largest_mesh_error, or by
/// more than the case asks for; and, with one mesh only, where the estimated error of the stress
/// field in the energy norm is larger than largest_mesh_error.
std::string why_indicative(const Assessment& assessment);

/// Half the width of the band in which the mesh leaves a checked stress of the block, as a share of
/// it: how far the last refinement moved the largest, or, with one mesh only, the estimated error
/// of the stress field in the energy norm. Of a block that was assessed.
double checked_stress_band(const BlockRun& block);

/// Gives a check of such a stress, or of what is proportional to it, the band, and says in its note
/// between what the demand stands: MPa for a stress.
void note_band(double band, Check& check);

}  // namespace blocklift::pipeline
