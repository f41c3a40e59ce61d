#pragma once

#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// What a run finds besides the motion and the loads, each at a cost of its own. The motion is the
/// same bit for bit, whatever is left out.
struct RunExtent {
  NaturalModesOfRun natural_modes = NaturalModesOfRun::found;
  /// Works of drives, winches and surroundings at every step, as much as a third of the motion.
  /// Left out: the energy history has no works, and a summary no `energy`.
  bool energy = true;
  /// Left out: not a number at each sample.
  bool righting_height = true;
};

/// run_lift that leaves out what nobody asks for.
/// @throws dynamics::SimulationError as run_lift.
LiftRun run_lift(const LiftCase& lift_case, BuiltLift model, const Progress& progress,
                 const RunExtent& extent);

}  // namespace blocklift::pipeline
