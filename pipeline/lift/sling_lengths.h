#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/build/build_lift.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// A lift at rest with slings of some lengths.
struct SlingState {
  Eigen::VectorXd tensions;  ///< of the slings, N
  double tilt = 0;           ///< of the load's z axis against the plumb, rad
  double trim = 0;           ///< of its x axis above the level, rad
  double list = 0;           ///< of its y axis above the level, rad
};

/// One sling that is longer and shorter than meant, all others being as meant.
struct SlingLengthError {
  SlingState longer, shorter;
};

/// What the lengths of the slings do, at an instant at rest while the load hangs on them.
struct SlingLengths {
  std::vector<std::string> slings;  ///< ropes to lugs and spreaders, in the order of the case
  Eigen::VectorXd lengths;          ///< unstretched, as meant, m
  double tolerance = 0;             ///< share of its length by which a sling may be off
  double time = 0;                  ///< of the instant, s
  SlingState meant;
  std::vector<SlingLengthError> errors;  ///< a sling each
  /// The largest tension of each sling over all sets of signs of all tolerances, N; empty with more
  /// than most_in_sets slings.
  Eigen::VectorXd worst_tensions;
  double worst_tilt = 0;  ///< the largest over these sets, rad
  /// Lengths that hang the load level, nearest to those meant, m; none were found where it is
  /// empty.
  Eigen::VectorXd level_lengths;
  SlingState level;  ///< with them

  std::string trouble;  ///< why nothing but `meant` is known; empty where all went well

  static constexpr std::size_t most_in_sets = 6;
};

/// Finds equilibria of the lift as it is, each anew with other lengths of slings.
///
/// The instant is the first of the history at rest at which the load hangs on its slings alone,
/// which bear its weight to 1 part in a thousand; the air is still. Slings with a winch of their
/// own count as meant. Level lengths follow by Newton's method for trim and list; of all changes of
/// length that level the load it takes the one with the least sum of squares.
///
/// @param flexibility of the load as in build_lift; null: it is rigid.
/// @returns nothing where the load never hangs on slings alone, or the case asks for no tolerance.
std::optional<SlingLengths> find_sling_lengths(const LiftCase& lift_case, const LoadMass& load,
                                               const LoadFlexibility* flexibility,
                                               const LiftRun& lift);

}  // namespace blocklift::pipeline
