#pragma once

#include <string>
#include <vector>

#include "pipeline/files/lift_case/standard_in_case.h"
#include "pipeline/standards/chain.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// A lift by the rules of a standard: a chain of factors for the lift as a whole, each hook, sling,
/// shackle, lug, crane and the structure, in both columns.
///
/// In the column of the standard the largest load at rest, which is that of the equilibria of the
/// operation, takes every factor of the rules. In the column of the simulation the largest load in
/// motion stands in place of dynamic amplification, tilt and yaw, and the skew computed from the
/// tolerance of the slings' lengths, where there is one, in place of the rules'; contingency and
/// centre of mass are taken by both.
struct StandardAssessment {
  std::string name, title, edition, source;  ///< of the rules
  std::vector<Chain> chains;                 ///< the lift first
  std::vector<std::string> notes;            ///< what the comparison shows, a sentence each

  /// The one of the largest utilisation; null without any that is held against a limit.
  const Chain* governing() const;
};

/// @throws std::out_of_range if the case chooses what the rules do not have; a case that was read
/// without complaints does not.
StandardAssessment assess_standard(const given::Standard& standard, const LiftFacts& facts);

}  // namespace blocklift::pipeline
