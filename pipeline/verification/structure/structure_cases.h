#pragma once

#include <vector>

#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Cases of the structure.
std::vector<VerificationCase> structure_cases();

/// A smooth field on distorted hexahedra: orders of convergence.
VerificationCase manufactured_solution();
/// Clamped square plates of one layer of cubic hexahedra under pressure, against Kirchhoff's plate.
VerificationCase clamped_plate();
/// NAFEMS LE10, thick elliptic plate: stress at the inner edge.
VerificationCase nafems_le10();

}  // namespace blocklift::pipeline
