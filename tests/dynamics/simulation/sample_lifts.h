#pragma once

#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/rope_lifts.h"

/// Lifts that several tests and benchmarks share.
namespace blocklift::dynamics::test {

/// Two goliath cranes, each a gantry with two trolleys and three hoists, turning over a block on
/// six slings: 6 driven joints, 6 hook blocks, 12 ropes, wind.
LiftSystem two_goliaths();

}  // namespace blocklift::dynamics::test
