#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Distance of a touch from the nearer end of its edge, m; negative beyond it, not a number where
/// the rope does not touch or is slack.
double distance_from_end(const dynamics::RopeHistory& rope, std::size_t edge, double length,
                         Eigen::Index sample);

/// For each rope and each edge that it may touch: force on the edge, angle of wrap, where it
/// touches, how far that is from the edge's ends, and with friction the tensions of both spans and
/// how friction would hold it sideways.
void add_edge_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
