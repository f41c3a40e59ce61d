#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/part_model.h"
#include "structure/packet.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

/// What one of several processes holds of a part.
///
/// Nodes that two shares have in common belong to the lower one. Rows of the distributed stiffness
/// are numbered so that each process owns a run of nodes; every process holds all solids that touch
/// its nodes (its own and, as a halo, those of others), so that it fills its rows and averages
/// stresses at the nodes of its solids without asking anyone.
struct PartShare {
  /// Mesh of the own solids, after them those of the halo; materials. No groups, supports, loads.
  PartModel model;
  int own_solids = 0;
  std::vector<int> row_of_node;     ///< row of three in the distributed stiffness, a node here
  std::vector<int> node_in_whole;   ///< number in the whole mesh, a node here
  int first_row = 0, end_row = 0;   ///< rows of three that this process owns
  std::vector<FixedUnknown> fixed;  ///< of own rows: unknown 3 row + axis
  Eigen::VectorXd load;             ///< on own rows, N

  void put_into(Packet& packet) const;
  static PartShare from(Packet packet);
};

/// Solids dealt out to processes so that few nodes are shared.
///
/// Partition of the graph of solids that share a face, METIS (Karypis and Kumar, 1998).
class PartDistribution {
 public:
  /// @throws ModelError if there are more processes than solids.
  PartDistribution(const PartModel& model, int processes);

  /// Share of one process. Nodes of no solid have no row: what is fixed there is left out.
  PartShare share(int process, const std::vector<FixedUnknown>& fixed,
                  const Eigen::VectorXd& load) const;
  /// First row of three of each process, and the number of all.
  const std::vector<int>& first_rows() const { return first_rows_; }
  /// Node of the whole mesh that each row of three belongs to.
  const std::vector<int>& node_of_row() const { return node_of_row_; }

 private:
  const PartModel& model_;
  std::vector<int> process_of_solid_;
  std::vector<int> row_of_node_;  ///< -1: the node is on no solid
  std::vector<int> node_of_row_;
  std::vector<int> first_rows_;
};

}  // namespace blocklift::structure
