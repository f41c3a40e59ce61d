#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/formats/results_store.h"
#include "pipeline/measurement/time_series.h"
#include "pipeline/measurement/weighing.h"

namespace blocklift::pipeline {

/// Names, as records call them, of the ropes and hoists that pull at the load.
std::vector<std::string> ropes_at_load(const ResultsReader& results);

/// The instants of a window with the measured tensions; directions of the ropes and attitude of the
/// load are the computed ones of the same instant, ropes are straight lines. No more than 2000
/// instants are taken, evenly.
/// @param tensions of every rope of ropes_at_load, on the clock of the lift, N.
/// @throws ResultsError if the results have no scene or no poses.
std::vector<WeighingInstant> weighing_instants(const ResultsReader& results,
                                               const std::map<std::string, TimeSeries>& tensions,
                                               const TimeWindow& window);

}  // namespace blocklift::pipeline
