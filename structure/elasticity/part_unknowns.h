#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/part_model.h"
#include "structure/space/elimination.h"
#include "structure/system/assembly.h"
#include "structure/system/linear_solver.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// The unknowns of a part in an order of elimination: three of each node that is on a solid, but
/// for freedoms that follow others. Freedom 3 n + a is the displacement of node n along axis a, of
/// all nodes. Immutable.
///
/// With T the freedoms by the unknowns, u = T q, the stiffness is T' K T, the mass T' M T and the
/// forces T' f: what acts on a node that follows others acts on these.
class PartUnknowns {
 public:
  explicit PartUnknowns(const PartMesh& mesh, std::vector<PartTie> ties = {});

  /// Elements are PartMesh::solids.
  const Elimination& elimination() const { return elimination_; }
  int count() const { return elimination_.count; }
  int freedoms() const { return static_cast<int>(elimination_.place.size()); }
  /// Unknown of a freedom; -1 for a node of no solid and for a freedom that follows others.
  int of(int freedom) const { return elimination_.place[freedom]; }
  /// A matrix of a solid, its rows three a node, by the unknowns that they are or follow.
  void take_solid(const PartMesh& mesh, int solid, const Eigen::MatrixXd& matrix,
                  ElementEntries& entries) const;

  /// Displacements by unknowns of those by freedoms; what follows others is left out.
  Eigen::MatrixXd to_unknowns(const Eigen::Ref<const Eigen::MatrixXd>& by_freedoms) const;
  /// T' f of forces by freedoms.
  Eigen::VectorXd forces_on_unknowns(const Eigen::VectorXd& by_freedoms) const;
  /// T q of displacements by unknowns; zero at nodes of no solid.
  Eigen::MatrixXd to_freedoms(const Eigen::Ref<const Eigen::MatrixXd>& by_unknowns) const;
  /// The unknowns of fixed freedoms, which follow none.
  std::vector<FixedUnknown> to_unknowns(const std::vector<FixedUnknown>& fixed_freedoms) const;

 private:
  std::vector<int> freedoms_of_solid(const PartMesh& mesh, int solid) const;

  std::vector<PartTie> ties_;
  std::vector<int> tie_of_;  // by freedom, -1: none; empty without ties
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
