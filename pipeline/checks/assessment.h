#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pipeline/checks/buckling_assessment.h"
#include "pipeline/checks/checks.h"
#include "pipeline/checks/padeye_assessment.h"
#include "pipeline/coupling/edge_loads.h"
#include "pipeline/coupling/shell_pressure.h"
#include "pipeline/lift/block_assessment.h"
#include "pipeline/lift/history_assessment.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/lift/sling_lengths.h"
#include "pipeline/lift/stage_stresses.h"
#include "pipeline/measures/measure.h"
#include "pipeline/standards/standard_assessment.h"
#include "structure/accuracy/accuracy.h"
#include "structure/accuracy/block_error.h"

namespace blocklift::pipeline {

/// The structural stage with what its pictures are made of. Without a model where no structure was
/// asked: the load is a vessel.
struct BlockRun {
  std::unique_ptr<structure::ElasticModel> model;
  std::unique_ptr<structure::UnitResponses> responses;
  double first_elastic_period = 0;  ///< of the free block, s; on the mesh that was begun with
  BlockAssessment assessment;
  std::optional<HistoryAssessment> history;  ///< every sample of the lift; none for a load table
  std::vector<StageStress> stages;           ///< of a lift; none for a load table
  structure::CheckedAccuracy accuracy;       ///< of the checked stress
  structure::BlockError error;               ///< estimated, at the load that governs the stress
  BucklingAssessment buckling;               ///< of every panel
  PadeyesAssessment padeyes;                 ///< of lugs that are made as padeyes
  std::optional<PressureBasis> pressure;     ///< of the water on its shell; none: it stays dry
  std::optional<EdgeBasis> edges;            ///< of ropes on its edges; none: no rope touches one
  double mesh_s = 0;                         ///< wall-clock time of meshing and mass properties
};

/// All that one run found out about a case.
struct Assessment {
  LiftCase lift_case;
  std::optional<LiftRun> lift;  ///< none for a load table
  std::vector<LiftMeasure> measures = {};
  BlockRun block;
  std::optional<StandardAssessment> standard;  ///< none: the case names no rules
  std::vector<Check> checks;
  double total_s = 0;                              ///< wall-clock time up to the writing of results
  std::optional<SlingLengths> sling_lengths = {};  ///< none: the load hangs on no slings

  bool pass() const { return all_pass(checks); }
};

}  // namespace blocklift::pipeline
