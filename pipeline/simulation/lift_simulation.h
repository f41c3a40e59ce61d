#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "pipeline/build/build_lift.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/lift/lift_run.h"
#include "structure/mesh/mesh.h"

namespace blocklift::pipeline {

/// The motion of a lift case, without the block's stress.
struct LiftSimulation {
  LiftCase lift_case;
  std::vector<structure::LiftingPoint> lugs;
  LiftRun run;
};

/// @throws InputError for a case that has nothing that moves, a load table.
void require_motion(const LiftCase& lift_case);

/// A verdict on a lift is not lost to a run that has none.
/// @throws InputError if the folder holds the assessment of a lift.
void require_no_verdict(const std::filesystem::path& folder);

/// Static sweep and time integration of a lift case. The load's mass is that of its mesh, as for
/// `assess`.
/// @param cache of what is computed of the vessels' water.
/// @throws InputError if the block cannot be meshed, dynamics::SimulationError as the stages do.
LiftSimulation simulate_lift(LiftCase lift_case, const Progress& progress,
                             const RunExtent& extent = {},
                             const std::filesystem::path& cache = cache_folder());

/// What the motion of a lift takes from its block.
struct KnownBlock {
  LoadMass mass;
  std::vector<structure::LiftingPoint> lugs;
  std::optional<LoadFlexibility> flexibility = {};  ///< none: it is rigid
};

/// The same of a case whose block is known already.
LiftSimulation simulate_lift(LiftCase lift_case, KnownBlock block, const Progress& progress,
                             const RunExtent& extent = {},
                             const std::filesystem::path& cache = cache_folder());

/// Writes results.h5, summary.json and report.html into a folder (made if missing), with the parts
/// that `assess` writes of the motion, and, if asked, results.csv: time, tension of each rope,
/// position of each drive, load of each loop.
/// @throws ResultsError, std::runtime_error if they cannot be written.
void write_lift_simulation(const LiftSimulation& simulation, const std::filesystem::path& folder,
                           bool with_csv);

}  // namespace blocklift::pipeline
