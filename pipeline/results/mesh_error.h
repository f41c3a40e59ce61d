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

}  // namespace blocklift::pipeline
