#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/simulation/history.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/lift/block_assessment.h"
#include "pipeline/measures/measure.h"

/// What of an assessment goes where in results.h5 (pipeline/formats/results/results_layout.h).
namespace blocklift::pipeline {

/// A body as it is drawn: boxes fixed in it.
struct DrawnBox {
  dynamics::Vector3 size;    ///< along the box's edges, m
  dynamics::Vector3 centre;  ///< in the body's frame, m
  dynamics::Vector4 orientation{1, 0, 0,
                                0};  ///< of the edges in the body's frame, quaternion w x y z
};
struct DrawnBody {
  std::string name;
  std::string kind;  ///< "crane", "hook block", "load"
  std::vector<DrawnBox> boxes;
};

/// A hoist's tackle within the ropes of the system.
struct DrawnTackle {
  std::string name;
  std::size_t rope = 0;
  bool hook_is_first = false;  ///< does the rope begin at the hook block?
};

/// Names and roles that the dynamics itself does not know.
struct Scene {
  std::vector<DrawnBody> bodies;
  std::vector<DrawnTackle> hoists;  ///< all other ropes are lines
  std::string load_body;
  std::vector<structure::LiftingPoint> lugs;
};

/// The time of day in UTC as results carry it (ISO 8601).
std::string creation_time();

/// @param run identity of the run (new_run_identity), which its summary carries too.
void write_case(ResultsWriter& file, const std::string& name, const std::string& title,
                const std::string& yaml, const std::string& run);
/// The model files of a case, beside its own.
void write_models(ResultsWriter& file, const std::vector<ModelText>& models);
void write_operation(ResultsWriter& file, const dynamics::Operation& operation);
/// @param group layout::static_history or layout::dynamic_history
void write_history(ResultsWriter& file, std::string_view group, const dynamics::LiftSystem& system,
                   const dynamics::History& history, const Scene& scene);
/// Measures beside both histories.
void write_measures(ResultsWriter& file, const std::vector<LiftMeasure>& measures);
/// @param history in which ropes touch edges that they are drawn over.
void write_scene(ResultsWriter& file, const dynamics::LiftSystem& system,
                 const dynamics::History& history, const Scene& scene);
/// Measured series beside the computed ones.
void write_measured(ResultsWriter& file, const Comparison& compare);
/// Surface of the block and the four states of both ways that the report shows.
void write_block(ResultsWriter& file, const structure::Surface& surface,
                 const structure::UnitResponses& responses, const BlockAssessment& assessment);

}  // namespace blocklift::pipeline
