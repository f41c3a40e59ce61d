#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/sling_lengths.h"

namespace blocklift::pipeline {

/// What the lengths of slings do, for the summary: SI units, slings by name.
nlohmann::ordered_json sling_lengths_json(const SlingLengths& lengths);

/// A sentence where slings that are off by their tolerance may bear more than their check allows,
/// breaking load as far as the bend leaves it over the case's factor, while the check holds for the
/// lengths that are meant: the largest tension of the worst set (with too many slings for sets, of
/// one sling that is off), times what motion makes of the sling's largest tension at rest.
std::vector<std::string> list_doubts(const LiftCase& lift_case, const LiftRun& lift,
                                     const SlingLengths& lengths);

}  // namespace blocklift::pipeline
