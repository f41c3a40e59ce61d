#pragma once

#include "pipeline/formats/results_store.h"
#include "pipeline/lift/history_assessment.h"
#include "structure/output/surface.h"

namespace blocklift::pipeline {

/// Envelope over the whole lift, on the surface and at the patches, and the stress in time at the
/// followed points, where results_layout.h has them.
void write_block_history(ResultsWriter& file, const structure::Surface& surface,
                         const structure::UnitResponses& responses,
                         const HistoryAssessment& history);

}  // namespace blocklift::pipeline
