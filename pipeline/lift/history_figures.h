#pragma once

#include <Eigen/Core>

#include "dynamics/simulation/history.h"

namespace blocklift::pipeline {

/// A tackle's pull on its hook block at each sample, in W, N.
const dynamics::RopeHistory::Rows3& hook_pull(const dynamics::RopeHistory& tackle,
                                              bool hook_is_first);

/// Angle of such a pull against the plumb, rad; zero where the tackle is slack.
Eigen::VectorXd swing_angles(const dynamics::RopeHistory::Rows3& hook_pull);

/// What the energy terms leave unexplained at each sample: E(t) - E(0) - (supplied - dissipated),
/// J.
Eigen::VectorXd energy_imbalance(const dynamics::EnergyHistory& energy);

}  // namespace blocklift::pipeline
