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

/// A shackle at rest and in motion. It bears all slings that end at its lug.
std::vector<Chain> shackle_chains(const LoadFactors& factors, const given::Shackle& shackle,
                                  const LugPull& pull);

/// A master link at rest and in motion: what hangs on its hook, against its working load. The load
/// factor of its legs (load of the link over that of its most loaded leg) is told beside that of EN
/// 818-4: 1.4 with two legs and 2.1 with more, up to 45 degrees to the plumb, 1 and 1.5 up to 60.
std::vector<Chain> master_link_chains(const LoadFactors& factors, const given::MasterLink& link,
                                      const HookFacts& hook);

/// A sheave over which a sling is led, at rest and in motion. Its pin bears both parts of the
/// sling, twice its load where they are parallel, less where they are not.
std::vector<Chain> sheave_chains(const LoadFactors& factors, const given::Sheave& sheave,
                                 const SlingFacts& sling);

/// Load below a spreader against what it bears as a column, or its sides do (EN 1993-1-1, 6.3.1),
/// over the case's factor, with the rules' consequence factor of lift points, which spreader bars
/// are among (0027/ND, table 11-1).
Chain spreader_chain(const LoadFactors& factors, const SpreaderFacts& spreader);

}  // namespace blocklift::pipeline
