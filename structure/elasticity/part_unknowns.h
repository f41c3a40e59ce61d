#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/part_model.h"
#include "structure/space/elimination.h"
#include "structure/system/linear_solver.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// The unknowns of a part in an order of elimination: three of each node that is on a solid.
/// Freedom 3 n + a is the displacement of node n along axis a, of all nodes. Immutable.
class PartUnknowns {
 public:
  explicit PartUnknowns(const PartMesh& mesh);

  /// Elements are PartMesh::solids.
  const Elimination& elimination() const { return elimination_; }
  int count() const { return elimination_.count; }
  int freedoms() const { return static_cast<int>(elimination_.place.size()); }
  /// Unknown of a freedom; -1 for a node of no solid.
  int of(int freedom) const { return elimination_.place[freedom]; }
  /// Unknowns of a solid, in the order of its stiffness.
  std::vector<int> of_solid(const PartMesh& mesh, int solid) const;

  /// Rows by unknowns for rows by freedoms; nodes of no solid are left out.
  Eigen::MatrixXd to_unknowns(const Eigen::Ref<const Eigen::MatrixXd>& by_freedoms) const;
  /// Rows by freedoms for rows by unknowns; zero at nodes of no solid.
  Eigen::MatrixXd to_freedoms(const Eigen::Ref<const Eigen::MatrixXd>& by_unknowns) const;
  /// The same of what is fixed.
  std::vector<FixedUnknown> to_unknowns(const std::vector<FixedUnknown>& fixed_freedoms) const;

 private:
  Elimination elimination_;
};

/// Stiffness of a part by its unknowns, N/m.
/// @throws ModelError if it would not fit into the memory that is free; the message has the
/// figures.
SparseLower assemble_part_stiffness(const PartModel& model, const PartUnknowns& unknowns,
                                    int threads = 0);

/// Consistent mass of a part by its unknowns, kg.
SparseLower assemble_part_mass(const PartModel& model, const PartUnknowns& unknowns,
                               int threads = 0);

}  // namespace blocklift::structure
