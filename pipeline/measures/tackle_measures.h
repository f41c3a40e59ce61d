#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Which way the rope of a tackle runs at each sample, by its unstretched length (m); as it ran
/// last where it stands, and before it has moved as if it had hoisted the load to where it is.
std::vector<dynamics::TackleMotion> find_tackle_motion(const Eigen::VectorXd& unstretched_length);

/// Pull at the drum and largest tension of the single rope, for hoists that say how their tackle is
/// reeved.
void add_tackle_measures(const LiftCase& lift_case, const LiftRun& lift,
                         std::vector<LiftMeasure>& measures);

/// "16 falls, 1 lead sheave, 98 % a sheave: 86.1 % efficient".
std::string describe_reeving(const ReevingModel& reeving);

}  // namespace blocklift::pipeline
