#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// Retardation functions of a database that has A(w) and B(w) alone, as frequency-domain programs
/// give them (Ogilvie 1964):
///
///   K(t) = (2/pi) int B(w) cos(w t) dw,
///
/// exact for B linear between the frequencies, from B = 0 at w = 0; nothing is assumed beyond the
/// highest frequency, so that what is radiated there is lost. Samples are 0.25 rad of the highest
/// frequency apart and last for half the period of the widest gap between frequencies (behind that
/// the integral repeats itself).
/// @throws ModelError if there are fewer than three frequencies.
void add_retardation(HydrodynamicDatabase& database);

/// A_inf = A(w) + (1/w) int K(t) sin(w t) dt, the mean over all frequencies: for databases without
/// it. Retardation functions must be there.
void add_infinite_added_mass(HydrodynamicDatabase& database);

}  // namespace blocklift::dynamics
