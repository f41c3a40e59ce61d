#pragma once

#include <string>

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::pipeline {

/// Waves carry energy away, and water that is pushed has a mass.
/// @throws dynamics::ModelError, with mode and frequency, if a mode's damping on itself is below
///   zero by more than 1 % of its largest and a thousandth of the largest of its kind
///   (displacements or rotations) of all modes, or the added mass of a displacement at infinite
///   frequency by more than 1 % of the largest. Added mass at a frequency may be negative: between
///   hulls and in moonpools it is.
void require_passive(const dynamics::HydrodynamicDatabase& database);

/// That the retardation functions miss added mass and damping by more than a tenth of the waves'
/// largest share (dynamics::calc_memory_error), mostly for damping that has not faded at the last
/// frequency; empty if they do not.
std::string doubt_about_memory(const dynamics::HydrodynamicDatabase& database);

}  // namespace blocklift::pipeline
