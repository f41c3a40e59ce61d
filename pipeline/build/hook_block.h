#pragma once

#include <string>
#include <vector>

#include "dynamics/multibody/mechanism.h"
#include "dynamics/rope/rope.h"
#include "dynamics/simulation/lift_system.h"
#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Bodies of a hook block, each carried by the one before it; the last is the hook, which has the
/// hoist's name and at whose origin slings begin.
///
/// A block that keeps its direction is one body on a translational joint to the world. One that
/// turns is a body without mass, `name`.place, on such a joint, and what turns about the vertical
/// on it; with a bearing that is `name`.block, and the hook turns on it.
std::vector<dynamics::BodyDefinition> hook_bodies(const std::string& name,
                                                  const HookBlockModel& block);

/// Gives a tackle from sheave to block the falls of a block that turns: plumb and parallel at the
/// start, apart along the level line across the x axis of the body that they leave, or across its y
/// axis where x stands upright.
/// @param R_WT of the body that they leave, at the start.
/// @returns the direction of the block's x axis then, from that of the world, rad.
double hang_twin_falls(const TurningBlockModel& turning, const Eigen::Matrix3d& R_WT,
                       dynamics::RopeDefinition& tackle);

/// Friction of a hook on its bearing.
dynamics::JointFriction bearing_friction(const dynamics::Mechanism& mechanism,
                                         dynamics::BodyIndex hook, const HookBearingModel& bearing);

}  // namespace blocklift::pipeline
