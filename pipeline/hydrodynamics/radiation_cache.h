#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/build/build_marine.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/hydrodynamics/panel_cache.h"

namespace blocklift::pipeline {

/// What tells fitted memories apart: a hash of the retardation functions and of how closely they
/// are fitted.
std::string identity_of(const std::vector<dynamics::HydrodynamicDatabase>& databases,
                        const dynamics::MemoryFit& fit);

/// The memories of databases (dynamics::fit_memories): from the cache if they lie there, else
/// fitted and put there, as find_radiation does with databases.
/// @param cache folder of it (cache_folder).
/// @throws dynamics::ModelError as fit_memories.
std::vector<dynamics::MemoryStateSpace> find_memories(
    const std::vector<dynamics::HydrodynamicDatabase>& databases, const dynamics::MemoryFit& fit,
    const std::filesystem::path& cache, const std::function<void(const std::string&)>& report);

/// The radiation of a problem.
struct FoundRadiation {
  std::shared_ptr<const dynamics::HydrodynamicSeries> series = {};  ///< null: vessels make no waves
  /// Whole sentences about panels, runs and coupling (hydrodynamic_report.h), the same whether the
  /// databases were computed or kept. Of several draughts the worst of each counts.
  std::vector<std::string> doubts = {};
};

/// The database of a problem, or, where a body is lowered, one for each of its draughts after that
/// of the others alone (dynamics::with_dry_body): from the cache or computed (find_database). Their
/// memories are found with them (find_memories, memory_fit_of_vessels).
/// @param report called with a sentence about what is done, and with each doubt after "warning: ";
///   may be empty.
/// @param progress told the fraction that is done and of which bodies, while databases are
///   computed; may be empty.
/// @param cache folder of it.
/// @returns nothing for a problem without bodies, or one whose surface is marched directly.
/// @throws InputError if the panel method refuses the problem (a wave too short for the panels,
///   hulls in each other's way, a surface that cannot be meshed), dynamics::SimulationError as
///   compute_radiation, dynamics::ModelError as find_memories.
FoundRadiation find_radiation(const RadiationProblem& problem,
                              const std::function<void(const std::string&)>& report,
                              const std::function<void(double, const std::string&)>& progress = {},
                              const std::filesystem::path& cache = cache_folder());

/// make_marched_water, what is wrong with the problem being wrong input.
/// @throws InputError for a wrong problem, dynamics::SimulationError.
MarchedWater find_marched_water(const RadiationProblem& problem);

}  // namespace blocklift::pipeline
