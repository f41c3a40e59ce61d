#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/peers/peer.h"

namespace blocklift::peers {

/// The libraries whose modules were built; this program's own first. Those that cannot be loaded
/// are left out with a word on the standard error.
std::vector<const PeerModule*> load_modules();

/// "Simbody 3.7.0, MuJoCo 2.2.2 from the distribution (generic x86-64 builds)", with what this
/// build of ours is.
std::string describe(const std::vector<const PeerModule*>& modules);

}  // namespace blocklift::peers
