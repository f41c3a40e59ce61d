#pragma once

#include "tests/benchmarks/peers/peer.h"

namespace blocklift::peers {

/// Chain of revolute joints alternately about z and y: links of 1 m and 1 kg.
TreeModel chain(int count);

/// Free base of 10 kg with five arms of six such links: 36 degrees of freedom.
TreeModel floating_tree();

/// Coordinates, velocities and torques between -1 and 1; the same number gives the same state.
TreeState some_state(const TreeModel& model, unsigned number);

}  // namespace blocklift::peers
