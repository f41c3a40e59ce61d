#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/index.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/part_mesh.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// Stresses xx, yy, zz, xy, yz, zx, a column each, Pa.
using StressColumns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Solids on common nodes, of a block or a part: all that their stress is found from.
struct SolidSet {
  Eigen::Matrix3Xd nodes;                 ///< m
  std::vector<const ElementKind*> kinds;  ///< of each solid; they outlive the set
  /// Place in `members` of each solid's first node; the last is their number.
  std::vector<int> first{0};
  std::vector<int> members;      ///< nodes of the solids, one solid after another
  std::vector<Elasticity> laws;  ///< along the axes of the nodes' places, Pa
  std::vector<int> law;          ///< of each solid, place in `laws`

  int count() const { return static_cast<int>(kinds.size()); }
  const ElementKind& kind(int solid) const { return *kinds[at(solid)]; }
  int node(int solid, int local) const { return members[at(first[at(solid)] + local)]; }
  /// Places of a solid's nodes, 3 x nodes, m.
  Eigen::Matrix3Xd places(int solid) const;
  /// Adds a solid of as many nodes as its kind has.
  void add(const ElementKind& kind, const int* nodes_of_solid, int law_of_solid);
};

/// The solids of a space on its nodes.
SolidSet solids_of(const Space& space);

/// Stresses of a solid at points whose gradients by the local coordinates are given: row 3 q + a
/// holds d/dxi_a of the shape functions at point q.
/// @param displacement 3 a node, m.
StressColumns stresses_of(const SolidSet& solids, int solid, const Eigen::MatrixXd& gradients,
                          const Eigen::VectorXd& displacement);

}  // namespace blocklift::structure
