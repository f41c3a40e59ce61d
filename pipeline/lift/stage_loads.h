#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// Time of a stage of the operation. Its pause belongs to it, and the time to settle to the last
/// one.
struct StageSpan {
  std::string stage;
  double start = 0;                ///< s
  double end = 0;                  ///< s
  std::optional<double> met = {};  ///< when the condition that ends it came about, s; none: no such
};

/// Samples of a history within a stage.
struct SampleSpan {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// @param time of the samples, ascending, s.
SampleSpan samples_within(const StageSpan& stage, const Eigen::VectorXd& time);

/// Stages of a lift, one behind another.
std::vector<StageSpan> find_stage_spans(const LiftRun& lift);

/// Largest load of a rope, a hoist or all slings together within a stage, at rest and in motion.
struct StageLoad {
  std::string name;
  double at_rest = 0;         ///< N
  double time_at_rest = 0;    ///< s
  double in_motion = 0;       ///< N
  double time_in_motion = 0;  ///< s
};

/// What the ropes carry within a stage of the operation.
struct StageLoads : StageSpan {
  std::vector<StageLoad> ropes;   ///< in the order of the case
  std::vector<StageLoad> hoists;  ///< in the order of cranes and their hoists
  StageLoad load;                 ///< vertical force of all slings on the load
};

/// The lift's loads stage by stage, so that one phase does not hide another. Stages in which no
/// sample lies are left out.
std::vector<StageLoads> find_stage_loads(const LiftRun& lift);

}  // namespace blocklift::pipeline
