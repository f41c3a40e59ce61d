#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/response/elastic_model.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {

/// One mesh on the way to a checked stress that stands.
struct AccuracyStep {
  int unknowns = 0;
  int shells = 0;            ///< cells
  double smallest_edge = 0;  ///< of a cell, m
  double at_rest = 0;        ///< largest checked stress over all instants at rest, Pa
  double in_motion = 0;      ///< over all instants in motion, Pa

  /// By how much motion makes the stress worse, share of that at rest.
  double increase() const { return at_rest > 0 ? in_motion / at_rest - 1 : 0; }
};

/// When refinement ends.
struct AccuracyGoal {
  double change = 0.03;         ///< largest change of stress and of its increase from step to step
  int most_unknowns = 1000000;  ///< no step is begun that would have more
  double square_size = 0.05;    ///< of the checked stress, m
};

/// How far the checked stress stands: what the last refinement changed.
struct CheckedAccuracy {
  std::vector<AccuracyStep> steps;
  bool is_reached = false;

  /// Change of the stress in the last step, the larger of at rest and in motion, share; 0 for one
  /// step.
  double stress_change() const;
  /// Change of the increase by motion in the last step, in shares of the stress at rest.
  double increase_change() const;
};

/// Factors of a model's unit responses, a column an instant.
struct LoadFactors {
  Eigen::MatrixXd at_rest, in_motion;
};

/// A block on the mesh that was found to be fine enough.
struct RefinedBlock {
  std::unique_ptr<ElasticModel> model;
  std::unique_ptr<UnitResponses> responses;
  CheckedAccuracy accuracy;
};

/// What a step of the refinement hands to the next: a later run goes on from there.
struct RefinementState {
  std::vector<AccuracyStep> steps;
  std::vector<Vector3> centres;        ///< about which the cells of the last step were divided, m
  std::vector<Square> squares;         ///< that the last step looked at
  Eigen::VectorXd at_rest, in_motion;  ///< their largest checked stress, Pa
};

/// Ties a refinement to an earlier one of the same block.
struct RefinementRecord {
  const RefinementState* earlier = nullptr;  ///< steps that need not be made again; null: none
  std::function<void(const RefinementState&)> after_step = {};  ///< may be empty
};

/// Divides a block's shells about the squares with the largest checked stress, again and again,
/// until the largest stress at rest and in motion and the increase from one to the other change by
/// less than the goal.
///
/// Each step solves anew and looks at the squares that had at least six tenths of the largest
/// stress before. Cells about the largest of them are divided to 0.1 m, then 0.05 m and so on,
/// growing with the distance. The loads are those of the rigid block, whatever its mesh.
/// A block without shells stays as it is, without a step: nothing of it is looked at in squares.
/// @param responses of the model; null: they are made if they are needed.
/// @param factors_of the factors of a model's responses; it may add to them loads of its own
/// before.
/// @param record with an earlier state only its last mesh is made and solved again, and figures are
/// those of a run that was never stopped, bit for bit.
RefinedBlock refine_checked_stress(
    std::unique_ptr<ElasticModel> model, std::unique_ptr<UnitResponses> responses,
    const std::function<LoadFactors(const ElasticModel&, UnitResponses&)>& factors_of,
    const AccuracyGoal& goal, const RefinementRecord& record = {});

}  // namespace blocklift::structure
