#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/assessment/unfinished_run.h"
#include "pipeline/checks/assessment.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/results/files/load_case_decks.h"

namespace blocklift::pipeline {

/// Runs all stages of a case: mesh and mass of the block, static sweep, time integration, load
/// mapping, unit responses, stresses, checks.
/// @param unfinished what an earlier run of the same case had done, which is taken over bit for
///   bit,
/// and where this one keeps what it has done; null: nothing is kept.
/// @param cache of what is computed of the vessels' water.
/// @throws dynamics::SimulationError, structure::ModelError, std::runtime_error as the stages do.
Assessment assess(LiftCase lift_case, const Progress& progress, UnfinishedRun* unfinished = nullptr,
                  const std::filesystem::path& cache = cache_folder());

/// Asks before a run whether its results can be written, by trying it; leaves nothing behind.
/// @throws InputError if the folder is a file or lies in one, or the user may not write there.
void require_writable(const std::filesystem::path& folder);

/// Writes results.h5, summary.json, the .vtu files and report.html into a folder (made if missing).
/// They are prepared aside and moved into place together at the end: whatever goes wrong before,
/// results that lie there stay as they are.
/// @param decks are written beside them, where they have a text; decks of an earlier run go.
/// @returns the path of report.html.
std::filesystem::path write_results(const Assessment& assessment,
                                    const std::filesystem::path& folder,
                                    const std::vector<LoadCaseFile>& decks = {});

}  // namespace blocklift::pipeline
