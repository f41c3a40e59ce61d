#pragma once

#include <vector>

#include "pipeline/standards/load_factors.h"

namespace blocklift::pipeline {

/// The lift as a whole: from its net weight to the dynamic hook load.
Chain lift_chain(const LoadFactors& factors);

/// Tackle load against the hoist's capacity.
Chain hook_chain(const LoadFactors& factors, const HookFacts& hook);

/// All hoists of a crane against its capacity, less what several cranes must hold back.
Chain crane_chain(const LoadFactors& factors, const CraneFacts& crane);

/// Sling load against breaking load over the safety factor, whose parts are told.
Chain sling_chain(const LoadFactors& factors, const SlingFacts& sling);

/// A shackle at rest and in motion.
std::vector<Chain> shackle_chains(const LoadFactors& factors, const ShackleInCase& shackle,
                                  const SlingFacts& sling);

}  // namespace blocklift::pipeline
