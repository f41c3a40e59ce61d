#pragma once

#include <vector>

#include <Eigen/Core>

#include "dynamics/simulation/history.h"
#include "pipeline/build/build_lift.h"
#include "pipeline/coupling/load_mapping.h"
#include "structure/mesh/mesh.h"

namespace blocklift::pipeline {

/// What pulls and presses on a lifted block, at rest and in motion. The histories outlive it.
struct BlockLoads {
  /// Ropes at its lugs.
  BlockLoads(const BuiltLift& lift, const dynamics::History& static_history,
             const dynamics::History& dynamic_history,
             const std::vector<structure::LiftingPoint>& lugs)
      : attachment(attach_block(lift, lugs)), at_rest(static_history), in_motion(dynamic_history) {}

  /// Loads besides, in the order in which they join the unit responses.
  /// @tparam Basis EdgeBasis or PressureBasis.
  /// @param ropes for each load the rope that it is of, -1: of none.
  template <class Basis>
  void add(const Basis& basis, const std::vector<int>& ropes) {
    Eigen::MatrixXd& resultants = attachment.added_resultants;
    resultants.conservativeResize(6, resultants.cols() + basis.count());
    resultants.rightCols(basis.count()) = basis.resultants;
    attachment.added_ropes.insert(attachment.added_ropes.end(), ropes.begin(), ropes.end());
    const auto append = [](BlockHistory& history, const Eigen::MatrixXd& factors) {
      history.added.conservativeResize(history.added.rows() + factors.rows(), factors.cols());
      history.added.bottomRows(factors.rows()) = factors;
    };
    append(at_rest, basis.static_factors);
    append(in_motion, basis.dynamic_factors);
  }

  BlockAttachment attachment;
  BlockHistory at_rest, in_motion;
};

}  // namespace blocklift::pipeline
