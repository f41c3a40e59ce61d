#pragma once

#include "pipeline/files/crane/crane_pose.h"
#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// The pose of a crane with its drives where its case starts them; see the function for a model.
/// @throws dynamics::SimulationError as that does.
CranePose pose_at_start(const given::Crane& crane);

}  // namespace blocklift::pipeline
