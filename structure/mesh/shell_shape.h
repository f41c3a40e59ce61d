#pragma once

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Is a shell folded? The normal of its surface turns over on it: its corners are not in turn about
/// it, one of them turns inwards by more than rounded coordinates do, or middles of its edges lie
/// far off. Judged at corners, and of curved shells at the middles and Gauss' points, too. A shell
/// without area is not said to be folded.
bool is_folded(const Mesh& mesh, const Shell& shell);

}  // namespace blocklift::structure
