#pragma once

#include <vector>

#include "pipeline/input/model_library.h"
#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Cases of the structure.
/// @param library where parts with references are found.
/// @throws InputError if one of them cannot be read.
std::vector<VerificationCase> structure_cases(const ModelLibrary& library);

/// One case for each parts/<name>/part.yaml of the models that has references.
std::vector<VerificationCase> part_cases(const ModelLibrary& library);

/// A smooth field on distorted hexahedra: orders of convergence.
VerificationCase manufactured_solution();
/// Clamped square plates of one layer of cubic hexahedra under pressure, against Kirchhoff's plate.
VerificationCase clamped_plate();
/// NAFEMS LE10, thick elliptic plate: stress at the inner edge.
VerificationCase nafems_le10();

}  // namespace blocklift::pipeline
