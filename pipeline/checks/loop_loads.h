#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/checks/checks.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/lift/lift_run.h"

/// What the loops of a lift's cranes bear: in results.h5, in summary.json, and in the verdict.
namespace blocklift::pipeline {

/// The load of a loop at each sample as one figure: of a rope_length its tension (N, negative where
/// the held length would have to push), of a gear the size of its multiplier (N or N m, as its
/// first joint moves), of all others the size of the force between the two bodies (N).
Eigen::VectorXd loop_load(const dynamics::Loop& loop, const dynamics::LoopHistory& history);

/// "N", or of a gear whose first joint turns "N m".
std::string loop_load_unit(const dynamics::Loop& loop);

/// Force, multipliers and residual of every loop into a history's group.
void write_loops(ResultsWriter& file, std::string_view group, const dynamics::LiftSystem& system,
                 const dynamics::History& history);

/// A row a loop: kind, largest loads at rest and in motion with their times, largest moment where
/// it holds turns, smallest tension of an equaliser, largest residual. Empty without loops.
nlohmann::ordered_json loops_json(const LiftRun& lift);

/// Equalisers are ropes: none may go slack. A check for each rope_length loop.
std::vector<Check> check_equalisers(const LiftRun& lift, double smallest_tension);

}  // namespace blocklift::pipeline
