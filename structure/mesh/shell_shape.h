#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Is a shell folded? The normal of its surface turns over on it: its corners are not in turn about
/// it, one of them turns inwards by more than rounded coordinates do, or middles of its edges lie
/// far off. Judged at corners, and of curved shells at the middles and Gauss' points, too. A shell
/// without area is not said to be folded.
bool is_folded(const Mesh& mesh, const Shell& shell);

/// Vertices that are fastened to curved shells (SurfacePoint, such as a force or a mass at the
/// middle of an edge), off the places that straight shells between the same corners have there.
/// Elements of degree 1 are straight: what is fastened would not turn with them as a rigid body,
/// and a force there lose its moment.
std::vector<int> fastened_off_straight_shells(const Mesh& mesh);

}  // namespace blocklift::structure
