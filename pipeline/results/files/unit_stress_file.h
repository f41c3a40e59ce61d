#pragma once

#include "pipeline/formats/results_store.h"
#include "pipeline/lift/history_assessment.h"
#include "structure/response/unit_responses.h"

namespace blocklift::pipeline {

/// Stress under unit loads at the hot spot, near each lug and at the worst place of each group of
/// plates in motion, and the factors of these loads over both histories. Unit stress times factors
/// is the stress at a sample. Below /structure/history, with m loads:
///   unit_stress/loads, load_units   texts [m]
///   unit_stress/places              texts [k];   unit_stress/points   m [k x 3], block frame
///   unit_stress/stress              Pa for a factor of 1 [k x 6 x m], xx yy zz xy yz zx
///   static/factors, dynamic/factors [n x m], a row a sample of the history
void write_unit_stress(ResultsWriter& file, const structure::UnitResponses& responses,
                       const HistoryAssessment& history);

}  // namespace blocklift::pipeline
