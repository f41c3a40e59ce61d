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

/// Curved triangles that are much too stiff in bending in elements of degree 2 or 3, the highest
/// first: those whose edges rise over the plane of their corners by more than their thickness.
///
/// Membrane strains of triangles of degree 3 and 4 are those of the displacements, which lock; of
/// degree 2 they are tied along the sides (ShellOperator). Measured: a quarter of a ring, thickness
/// over radius 0.02, of one row of 16, 8, 4 and 2 pairs of triangles gives way to a force by this
/// share of what it should,
///   rise over thickness   0.06    0.24    0.96    3.9
///   degree 2              1.003   1.009   1.001   0.722
///   degree 3              1.000   1.000   0.982   0.754
///   degree 4              1.000   1.000   1.000   0.997
std::vector<int> find_locking_triangles(const Mesh& mesh, int degree);

}  // namespace blocklift::structure
