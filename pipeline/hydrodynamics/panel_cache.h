#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "pipeline/build/panel_problem.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"

namespace blocklift::pipeline {

/// What tells databases apart: a hash of all that is in a problem. Equal problems have one database
/// in the cache, whoever asks for it.
std::string identity_of(const PanelProblem& problem);

/// What is found of a problem.
struct FoundDatabase {
  dynamics::HydrodynamicDatabase database;
  WavesLost lost = {};
  std::filesystem::path file = {};  ///< of the cache that it was taken from; empty: computed
};

/// Do panels on the water couple bodies, so that these may lose waves?
bool may_lose_waves(const PanelProblem& problem);

/// How a database comes into being that the cache does not have.
struct DatabaseMaker {
  std::string of_what;  ///< the bodies, and their draught
  std::function<FoundDatabase()> compute;
  /// On the mesh, without the database, for an entry that does not tell it.
  std::function<WavesLost()> find_waves_lost;
};

/// The database of a problem: from the cache if it lies there, else computed and put there. What
/// another run is computing is waited for and taken from there (CacheLock). A cache that cannot be
/// written is no error: the database is computed again next time.
/// @param cache folder of it (cache_folder).
/// @param say called with a sentence if the database is in the cache, or waited for.
/// @throws what `maker` throws.
FoundDatabase find_database(const PanelProblem& problem, const DatabaseMaker& maker,
                            const std::filesystem::path& cache,
                            const std::function<void(const std::string&)>& say);

}  // namespace blocklift::pipeline
