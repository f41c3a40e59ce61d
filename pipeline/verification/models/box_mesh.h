#pragma once

#include <array>
#include <functional>

#include "structure/elasticity/discretisation.h"
#include "structure/mesh/hex_mesh.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure::testing {

/// Grid of counts[0] x counts[1] x counts[2] cells on the box [0, size], each vertex moved by
/// `place` (identity if empty). One group, "box".
BlockMesh box_mesh(const std::array<int, 3>& counts, const Vector3& size, const Material& material,
                   const std::function<Vector3(const Vector3&)>& place = {});

/// Turns every cell's own axes by one of the 24 rotations of a cube, picked by the cell's number:
/// the same geometry with faces and edges that run every way.
void turn_cells(HexMesh& mesh);

/// Nodes that `selects`, held at `displacement` along the axes given.
void hold(const Discretisation& space, const std::function<bool(const Vector3&)>& selects,
          const std::function<Vector3(const Vector3&)>& displacement,
          const std::array<bool, 3>& axes, std::vector<FixedUnknown>& fixed);

/// Assembles, factorises and solves once.
Eigen::VectorXd solve(const HexMesh& mesh, const Discretisation& space,
                      const std::vector<FixedUnknown>& fixed, const Eigen::VectorXd& load);

}  // namespace blocklift::structure::testing
