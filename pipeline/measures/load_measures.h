#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Attitude of the load, angles of its slings against the level, and where its centre of mass is
/// within the polygon of the lugs that carry, seen from above.
void add_load_measures(const LiftCase& lift_case, const LiftRun& lift,
                       std::vector<LiftMeasure>& measures);

/// Turn of the load about the plumb away from where it hangs at the start, rad.
LiftMeasure turn_of_load(const LiftRun& lift);

/// Where a load may slide with nothing that holds it, and tilts as it does, its righting height has
/// no bound below: the stiffness that stands for none would make it millions of metres. This counts
/// as all that is less, m.
inline constexpr double least_righting_height = -1000;

/// The load's dynamics::calc_righting_height, while slings bear nine tenths of its weight: of the
/// equilibrium at each instant; in motion that of the last sample at rest.
LiftMeasure righting_height(const LiftCase& lift_case, const LiftRun& lift);

/// Distance of a point from the edge of the convex hull of others in the plane, m: positive inside,
/// negative outside; not a number if the others span no area.
double distance_within(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& point);

}  // namespace blocklift::pipeline
