#pragma once

#include "pipeline/standards/load_factors.h"

namespace blocklift::pipeline {

/// Load of a lug with its consequence factor against the worst of the formulae that the rules name,
/// in the direction of the largest load at rest (standard) and in motion (simulation).
Chain lug_chain(const LoadFactors& factors, const LugFacts& lug);

/// Checked stress with the factors that the loads of its lugs take, the largest of each, against
/// yield with the case's factor.
Chain stress_chain(const LoadFactors& factors, const StressFacts& stress);

}  // namespace blocklift::pipeline
