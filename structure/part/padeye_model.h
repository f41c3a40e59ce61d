#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/part_model.h"
#include "structure/elasticity/part_unknowns.h"
#include "structure/mesh/padeye/padeye.h"
#include "structure/part/padeye_stress.h"
#include "structure/part/part_solution.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

/// What acts on a padeye at one instant, in its frame P.
struct PadeyeLoad {
  Vector3 force = Vector3::Zero();                      ///< of the pin on the hole, N
  Vector3 gravity_less_acceleration = Vector3::Zero();  ///< of the padeye, m/s^2
  /// Displacement of the base, 3 a node of PadeyeModel::base_nodes(), m; empty: it is held.
  Eigen::VectorXd base_displacement;
};

/// A padeye under a load.
struct PadeyeResult : PadeyeStress {
  Eigen::VectorXd displacement;  ///< 3 a node, m
  Wrench reaction;               ///< that the base exerts, moment about the middle of the hole
  double force_residual = 0;     ///< |loads + reactions| over the sum of the loads' magnitudes
  double moment_residual = 0;    ///< of moments, over that sum times the padeye's height
};

/// A padeye meshed finely, cut from the block along its base: a sub-model that is driven by the
/// block's displacement there, or held. Factorised once for any number of loads.
class PadeyeModel {
 public:
  /// @param divisions elements around the hole. @throws ModelError as make_padeye_mesh does.
  PadeyeModel(const PadeyeGeometry& padeye, const Material& material, int divisions = 32);

  const PadeyeGeometry& geometry() const { return geometry_; }
  const std::vector<PadeyeMesh::Column>& columns() const { return columns_; }
  /// Mesh and materials ("main" and "cheeks", alike), without loads.
  const PartModel& part() const { return part_; }
  /// Nodes of the cut, places in PartMesh::nodes.
  const std::vector<int>& base_nodes() const { return base_nodes_; }

  PadeyeResult solve(const PadeyeLoad& load) const;
  /// The solution as that of a part, for files: displacement and averaged stress.
  PartSolution as_part(const PadeyeResult& result) const;

 private:
  Eigen::VectorXd load_vector(const PadeyeLoad& load) const;
  void find_balance(const Eigen::VectorXd& load, const Eigen::VectorXd& reactions,
                    PadeyeResult& result) const;

  PadeyeGeometry geometry_;
  std::vector<PadeyeMesh::Column> columns_;
  PartModel part_;
  std::vector<int> base_nodes_;
  std::vector<std::vector<int>> solids_of_column_;
  std::unique_ptr<PartUnknowns> unknowns_;
  std::unique_ptr<ConstrainedSystem> system_;
};

}  // namespace blocklift::structure
