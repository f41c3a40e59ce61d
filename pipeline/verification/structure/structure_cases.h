#pragma once

#include <vector>

#include "pipeline/files/model_library.h"
#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Cases of the structure.
/// @param library where parts with references are found.
/// @throws InputError if one of them cannot be read.
std::vector<VerificationCase> structure_cases(const ModelLibrary& library);

/// One case for each parts/<name>/part.yaml and lugs/<name>/part.yaml of the models that has references.
std::vector<VerificationCase> part_cases(const ModelLibrary& library);

/// A smooth field on distorted hexahedra: orders of convergence.
VerificationCase manufactured_solution();
/// A linear field on distorted hexahedra of each degree: exact.
VerificationCase patch_test();
/// Superposition, balance and envelope of a small block on four lugs.
VerificationCase lifted_block();
/// Belytschko's pinched cylinder with end diaphragms, curved hexahedra.
VerificationCase pinched_cylinder();
/// NAFEMS FV12 and FV16, natural frequencies of a thin plate, by cubic hexahedra.
VerificationCase free_vibration();
/// The estimated error of parts over the true one, and the accuracy that refinement reaches.
VerificationCase error_estimate(const ModelLibrary& library);
/// Clamped square plates of one layer of cubic hexahedra under pressure, against Kirchhoff's plate.
VerificationCase clamped_plate();
/// NAFEMS LE10, thick elliptic plate: stress at the inner edge.
VerificationCase nafems_le10();

}  // namespace blocklift::pipeline
