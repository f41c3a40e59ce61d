#pragma once

#include "tests/benchmarks/peers/peer.h"

namespace blocklift::peers {

/// This program's own side.
const PeerModule& blocklift_module();

}  // namespace blocklift::peers
