#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/space/space.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

/// 3-2-1 support: six unknowns at three nodes far apart, which remove the rigid motions and
/// nothing else. The first node is held along x, y, z; of the components at the other two, those
/// three are held that best resist the rigid motions (largest smallest singular value). Of nodes on
/// one line, such as a pipe of beams, the second is held across it and the first against a turn
/// about it.
/// @throws ModelError if all nodes lie on one line and none of them turns, as of rods or solids.
std::vector<FixedUnknown> statically_determinate_support(const Space& space);

}  // namespace blocklift::structure
