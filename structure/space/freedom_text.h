#pragma once

#include <string>

#include "structure/space/space.h"

namespace blocklift::structure {

/// Where and how a freedom moves: "at (1, 2, 3) m, displacement along x".
std::string describe_freedom(const Space& space, int freedom);

/// The freedom that depends most on an unknown.
int freedom_of(const Space& space, int unknown);

}  // namespace blocklift::structure
