#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/checks/assessment.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// One of four slings of a hook, as it pulls at its lug.
struct DiagonalSling {
  structure::Vector3 p_B = structure::Vector3::Zero();    ///< of the lug's pin, m
  structure::Vector3 force = structure::Vector3::Zero();  ///< at rest, in B, N
  double skew = 1;  ///< its largest tension under skew over that at rest
};

/// What the slings' forces change by when one diagonal bears more and the other less.
using DiagonalChange = std::array<structure::Vector3, 4>;

/// The changes of four slings whose lines meet in a point, for either diagonal: the only tensions
/// that load nothing but what hangs on the slings, so large that each sling of one diagonal reaches
/// its skew, but no sling would push.
/// @returns none where the lines do not meet, or more than one such set of tensions exists.
std::optional<std::array<DiagonalChange, 2>> diagonal_changes(
    const std::array<DiagonalSling, 4>& slings);

/// Takes into the stresses of the structure by how much they grow when the slings of a hook with
/// four share unevenly on either diagonal: by the skew factor of the case's rules, and as the
/// slings' tolerances of length gave it. At the largest load at rest.
/// @pre the case names rules, and the block has responses.
void add_structure_skew(const Assessment& assessment, LiftFacts& facts);

}  // namespace blocklift::pipeline
