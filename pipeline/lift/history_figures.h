#pragma once

#include <Eigen/Core>

#include "dynamics/simulation/history.h"

namespace blocklift::pipeline {

/// Angle of the rope's first segment against the vertical at each sample, rad.
Eigen::VectorXd swing_angles(const dynamics::RopeHistory& rope);

/// What the energy terms leave unexplained at each sample: E(t) - E(0) - (supplied - dissipated),
/// J.
Eigen::VectorXd energy_imbalance(const dynamics::EnergyHistory& energy);

}  // namespace blocklift::pipeline
