#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// `stages` of summary.json: the loads stage by stage.
nlohmann::ordered_json stages_json(const LiftRun& lift);

/// `parted` of summary.json: ropes that parted, with what they carried and had stored.
nlohmann::ordered_json parted_json(const LiftRun& lift);

/// `worst_instant` of summary.json: when a fault is worst, and all instants that were tried; null
/// where none was sought.
nlohmann::ordered_json worst_instant_json(const LiftRun& lift);

/// `measures` of summary.json: of each the value that is furthest out, at rest and in motion.
nlohmann::ordered_json measures_json(const LiftRun& lift, const std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
