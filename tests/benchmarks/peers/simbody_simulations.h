#pragma once

#include "tests/benchmarks/peers/peer.h"

namespace blocklift::peers {

/// Both by Runge-Kutta-Merson steps at the integrator's own accuracy setting.
SimulationRun simulate_block_on_six_ropes(double accuracy);
SimulationRun simulate_andrews(double accuracy);

}  // namespace blocklift::peers
