#pragma once

#include <vector>

#include "pipeline/lift/lift_run.h"
#include "pipeline/rigging/master_link_choice.h"
#include "pipeline/rigging/settling.h"
#include "pipeline/rigging/shackle_choice.h"
#include "pipeline/rigging/sheave_choice.h"
#include "pipeline/rigging/sling_choice.h"
#include "pipeline/rigging/spreader_choice.h"
#include "pipeline/rigging/stock.h"

namespace blocklift::pipeline {

/// A sling of the lift with what was chosen for it, and its loads with that choice.
struct RiggedSling {
  SlingDemand demand;
  ChosenSling chosen;
};

/// A lift with its rigging from stock.
struct RiggedLift {
  LiftCase lift_case;  ///< with the chosen slings as its ropes, and the chosen bars
  Stock stock;
  std::vector<RiggedSling> slings;
  std::vector<ChosenShackle> shackles;  ///< one a lug
  std::vector<ChosenMasterLink>
      master_links;                   ///< of hooks with several slings; of a stock with links
  std::vector<ChosenSheave> sheaves;  ///< of slings that are led over some; of a stock with sheaves
  std::vector<ChosenSpreader> spreaders;  ///< of bars whose length the stock has
  Settled settled;

  /// The choice stands, and all that was chosen passes.
  bool pass() const;
};

/// Runs of the lift until the choice stands, at most.
inline constexpr int most_rigging_runs = 15;

/// Chooses for each sling of a case the weakest of a stock that passes the case's checks against
/// its largest loads, at rest and in motion, and for each spreader the lightest of its length,
/// running the lift again with the choice until it stands; shackles, master links and sheaves
/// follow from the last run.
/// Checks of the block and of cranes are not asked.
/// @throws InputError if the case has no slings, or the block cannot be meshed; as run_lift does.
RiggedLift rig_lift(LiftCase lift_case, Stock stock, const Progress& progress);

}  // namespace blocklift::pipeline
