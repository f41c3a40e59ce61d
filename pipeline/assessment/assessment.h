#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/assessment/block_assessment.h"
#include "pipeline/assessment/buckling_assessment.h"
#include "pipeline/assessment/checks.h"
#include "pipeline/assessment/history_assessment.h"
#include "pipeline/assessment/lift_run.h"
#include "pipeline/assessment/padeye_assessment.h"
#include "pipeline/coupling/shell_pressure.h"
#include "structure/response/block_error.h"

namespace blocklift::pipeline {

/// The structural stage with what its pictures are made of. Without a model where no structure was asked:
/// the load is a vessel.
struct BlockRun {
  std::unique_ptr<structure::ElasticModel> model;
  std::unique_ptr<structure::UnitResponses> responses;
  BlockAssessment assessment;
  std::optional<HistoryAssessment> history;  ///< every sample of the lift; none for a load table
  structure::BlockError error;               ///< estimated, at the load that governs the stress
  BucklingAssessment buckling;               ///< of every panel
  PadeyesAssessment padeyes;                 ///< of lugs that are made as padeyes
  std::optional<PressureBasis> pressure;     ///< of the water on its shell; none: it stays dry
  double mesh_s = 0;                         ///< wall-clock time of meshing and mass properties
};

/// All that one run found out about a case.
struct Assessment {
  LiftCase lift_case;
  std::optional<LiftRun> lift;  ///< none for a load table
  BlockRun block;
  std::vector<Check> checks;
  double total_s = 0;  ///< wall-clock time up to the writing of results

  bool pass() const { return all_pass(checks); }
};

/// Runs all stages of a case: mesh and mass of the block, static sweep, time integration, load
/// mapping, unit responses, stresses, checks.
/// @throws dynamics::SimulationError, structure::ModelError, std::runtime_error as the stages do.
Assessment assess(LiftCase lift_case, const Progress& progress);

/// Asks before a run whether its results can be written; makes nothing.
/// @throws InputError if the folder is a file or lies in one, or the user may not write there.
void require_writable(const std::filesystem::path& folder);

/// Writes results.h5, summary.json, the .vtu files and report.html into a folder (made if missing).
/// They are prepared aside and moved into place together at the end: whatever goes wrong before,
/// results that lie there stay as they are.
/// @returns the path of report.html.
std::filesystem::path write_results(const Assessment& assessment,
                                    const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
