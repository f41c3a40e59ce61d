#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/response/unit_responses.h"
#include "structure/stress/squares.h"
#include "structure/stress/stress_points.h"

namespace blocklift::structure {

/// Largest value of a field and where it is.
struct Extreme {
  double value = 0;                   ///< Pa, or m
  Vector3 point_B = Vector3::Zero();  ///< m
  std::string part;                   ///< such as "web_frames at x = 4 m"
};

/// Stresses of one group (plates of a name, a pad, a lug).
struct GroupStress {
  std::string group;
  std::string material;
  double yield_stress = 0;    ///< Pa
  Extreme checked_von_mises;  ///< Pa
  /// The largest over the squares of each site; without squares the peak as a field's. No part:
  /// none.
  BySite<Extreme> at_site;
  Extreme peak_von_mises;  ///< Pa
};

/// What happens within a sphere about a lug's pin.
struct LugNeighbourhood {
  std::string lug;
  double radius = 0;  ///< m
  Extreme checked_von_mises;
  BySite<Extreme> at_site;  ///< see GroupStress
  Extreme peak_von_mises;
  Extreme displacement;  ///< relative to the block's mean rigid motion, m
};

/// Stress and deformation of the block in one load case.
struct LoadCaseResult {
  std::string name;
  Extreme checked_von_mises;  ///< largest membrane stress over squares (CheckedStress), Pa
  Extreme field_von_mises;    ///< largest over squares away from corners, Pa
  Extreme peak_von_mises;     ///< largest nodal value within any cell, nothing averaged, Pa
  Extreme displacement;       ///< largest, relative to the mean rigid motion, m
  std::vector<GroupStress> groups;
  std::vector<LugNeighbourhood> lugs;
  LoadBalance balance;
};

/// Settings of stress recovery.
struct RecoveryOptions {
  double square_size = 0.05;  ///< of the checked stress, m
  /// Radius about each pin that counts as its neighbourhood, m; 0: as far as pad and lug reach.
  double lug_radius = 3;
};

/// Stress and deformation of a block that moves by sums of given motions.
class MotionStress {
 public:
  /// @param motions freedoms x m, m and rad. The model must outlive this object.
  /// @param heat of as many cases as there are motions, which must outlive this object; null: none.
  MotionStress(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions,
               const RecoveryOptions& options, const CellHeat* heat = nullptr);

  /// A column a case; one pass through all cells serves them all. With heat each case is one of
  /// the motions, in their order.
  /// @param factors of the motions, m x cases. @param moved the motions that they make up, from
  ///   which displacements are told, freedoms x cases: a rigid motion may be taken out.
  /// @returns results without names and balance.
  std::vector<LoadCaseResult> evaluate(const Eigen::MatrixXd& factors,
                                       const Eigen::MatrixXd& moved) const;
  const CheckedStress& checked() const { return checked_; }
  const StressPoints& points() const { return points_; }
  /// Radius about a lug's pin that counts as its neighbourhood, m.
  double lug_radius(const LiftingPoint& lug) const {
    return options_.lug_radius > 0 ? options_.lug_radius : lug.radius;
  }

 private:
  const ElasticModel& model_;
  RecoveryOptions options_;
  CheckedStress checked_;
  StressPoints points_;
  const CellHeat* heat_;
};

/// Evaluates load cases from unit responses. The checked stress costs a product with stored unit
/// stresses; the raw peak needs the superposed displacement once through all cells.
class StressRecovery {
 public:
  using Options = RecoveryOptions;

  /// The responses must outlive this object.
  explicit StressRecovery(const UnitResponses& responses) : StressRecovery(responses, Options{}) {}
  StressRecovery(const UnitResponses& responses, const Options& options);

  LoadCaseResult evaluate(const LoadCase& load_case) const;
  /// Several at once, in their order: one pass through all cells serves them all.
  std::vector<LoadCaseResult> evaluate(const std::vector<LoadCase>& load_cases) const;
  const CheckedStress& checked() const { return of_motions_.checked(); }
  const StressPoints& points() const { return of_motions_.points(); }
  /// Radius about a lug's pin that counts as its neighbourhood, m.
  double lug_radius(const LiftingPoint& lug) const { return of_motions_.lug_radius(lug); }

 private:
  const UnitResponses& responses_;
  MotionStress of_motions_;
};

}  // namespace blocklift::structure
