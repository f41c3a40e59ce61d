#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/checks/checks.h"
#include "pipeline/lift/block_assessment.h"
#include "pipeline/lift/history_assessment.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// The sharpest that a rope is bent round.
struct RopeBend {
  double diameter = 0;    ///< m
  std::string edge = {};  ///< of the load; empty: what the rope's bend_diameter is of
};

/// The least of a rope's bend_diameter and of the rounds of edges that it touches while it pulls,
/// at rest or in motion; none where it is not bent.
std::optional<RopeBend> find_bend(const given::Rope& rope, const LiftRun& lift);

/// What the bend of a rope leaves of its breaking load, as a share; all of it where its model has
/// no diameter.
double bend_efficiency(const given::Rope& rope, const LiftRun& lift);

/// Ropes and tackle against breaking load, hooks and cranes against capacity, slack and swing; each
/// by the larger of the static and the dynamic history. Of a load whose ropes have all parted,
/// whether it is borne: check_held.
std::vector<Check> check_lift(const LiftCase& lift_case, const LiftRun& lift);

/// Do the case's rules allow more near corners of the structure than in fields?
bool tells_sites_apart(const LiftCase& lift_case);

/// Checked von Mises stress against yield with the case's factor, a line a material: the plate with
/// the highest utilisation at any instant of the lift, or in the load table's states where there is
/// no history (null). Where the case's rules tell what is allowed near corners (a `fine_mesh`
/// section), a line for each site: the field by the case's factor, corners by the rules' factor on
/// that.
std::vector<Check> check_block(const LiftCase& lift_case, const BlockAssessment& block,
                               const HistoryAssessment* history = nullptr);

}  // namespace blocklift::pipeline
