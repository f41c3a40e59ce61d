#pragma once

#include "pipeline/build/build_marine.h"

namespace blocklift::pipeline {

/// The database that a case names, for the bodies of the problem in their order.
///
/// The force of the incident wave is computed on the hulls as they lie at each instant. Where the
/// database has but the whole excitation, that force on the hulls at rest is therefore taken off,
/// as the case will put it back (dynamics::RestingWaveForce): what is left is the diffraction.
///
/// @throws InputError if a hull is not the database's: it keeps out another volume of water (by
///   more than a twentieth), or its centre of buoyancy lies elsewhere (by more than a twentieth of
///   the hull's size); if a body of the problem is lowered.
dynamics::HydrodynamicDatabase take_given_database(const RadiationProblem& problem);

}  // namespace blocklift::pipeline
