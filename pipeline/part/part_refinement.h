#pragma once

#include "pipeline/part/part_assessment.h"

namespace blocklift::pipeline {

/// Meshes and solves a part, with better meshes until the accuracies that its file asks for are
/// met: quadratic elements first; then a geometry of tetrahedra is meshed again with smaller
/// elements where the error is (structure::find_sizes), and of any other mesh all elements are
/// halved. Without loads it is only meshed.
/// @throws InputError if the model cannot be made or solved, or an accuracy is not reached.
void solve_to_accuracy(PartAssessment& assessment, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
