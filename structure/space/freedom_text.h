#pragma once

#include <string>

#include "structure/space/space.h"

namespace blocklift::structure {

/// Where and how a freedom moves: "at (1, 2, 3) m, displacement along x".
std::string describe_freedom(const Space& space, int freedom);

/// What may let a part move: beams that bend and have no torsional stiffness, as a sentence in
/// parentheses behind a blank, with the number of the first; empty without any. With an offset such
/// a beam may not only turn about its own line but swing its nodes about it.
std::string hint_at_torsion(const Mesh& mesh);

/// The freedom that depends most on an unknown.
int freedom_of(const Space& space, int unknown);

}  // namespace blocklift::structure
