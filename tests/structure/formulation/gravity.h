#pragma once

#include <array>

#include "structure/mesh/mesh.h"

namespace blocklift::structure::test {

/// Upward forces on three supports under a mesh's own weight (9.81 m/s^2 down), N: the first holds
/// x, y and z, the second y and z, the third z alone. The second must lie along x from the first.
/// @throws ModelError if the structure is loose or has a mechanism.
std::array<double, 3> weigh(const Mesh& mesh, int degree, const std::array<Vector3, 3>& supports);

}  // namespace blocklift::structure::test
