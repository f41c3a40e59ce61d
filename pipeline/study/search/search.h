#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"
#include "pipeline/study/members/members.h"

namespace blocklift::pipeline {

/// Computes a member of given values, SI units.
using EvaluateMember = std::function<Member(const Eigen::VectorXd& values, int number)>;

/// A bound, and what the best member has of it; the summary's units.
struct BoundOfSearch {
  std::string figure;
  double limit = 0, value = 0;
  bool is_least = false;  ///< the value may not be smaller
  /// The value lies within a hundredth of the limit; where that is zero, of the largest that the
  /// figure is in the first sample.
  bool is_active = false;
  bool is_exceeded = false;  ///< the value lies beyond the limit, or is not a number
};

/// What a search found.
struct SearchResults {
  std::string figure;  ///< that is to be small, or large
  bool is_largest = false;
  Eigen::MatrixXd design;       ///< all values that were tried, a member a row
  std::vector<Member> members;  ///< in order; those of the first sample first
  int first_sample = 0;         ///< how many of them
  int best = 0;                 ///< number of the best member that keeps to all bounds
  bool is_feasible = false;     ///< false: none does, and `best` exceeds its bounds least
  double value = 0;             ///< the figure of the best member
  std::vector<BoundOfSearch> bounds;
  std::vector<int> at_edge;  ///< of each variable: -1 at its lowest value, 1 at its highest, else 0
  bool is_converged = false;  ///< the last steps were below a thousandth of each range
  /// The best figure of a second search that began elsewhere; none where members did not suffice,
  /// or it met no member that keeps to all bounds.
  std::optional<double> elsewhere;
};

/// Searches for the best member from those of a first sample on, by linear approximations in a
/// trust region (COBYLA; Powell 1994, "A direct search optimization method that models the
/// objective and constraint functions by linear interpolation"; OpenTURNS'), which needs no
/// derivatives. It goes on from the best of the sample, then, with what members are left, from the
/// best far away from what it found. The same study tries the same values.
///
/// @param sample values of the first members, a member a row. @param members they themselves.
/// @throws InputError if the unit of a bound is not that of its figure.
SearchResults search_members(const StudyFile& study, const Eigen::MatrixXd& sample,
                             std::vector<Member> members, const EvaluateMember& evaluate);

/// The best figure after each member, of those that keep to all bounds; not a number before one
/// does.
std::vector<double> best_so_far(const StudyFile& study, const SearchResults& results);

}  // namespace blocklift::pipeline
