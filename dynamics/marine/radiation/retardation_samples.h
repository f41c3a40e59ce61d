#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// Brings the retardation functions of all databases to the finest step and the longest duration
/// among them, or to `least_duration` (s) if that is longer: cubic polynomials between the samples,
/// zero behind the end.
void bring_to_one_step(std::vector<HydrodynamicDatabase>& databases, double least_duration = 0.0);

}  // namespace blocklift::dynamics
