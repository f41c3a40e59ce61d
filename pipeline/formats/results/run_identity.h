#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// What results.h5 and summary.json of one run have in common and no other run has: 32 hexadecimal
/// digits, from the system's source of random numbers.
std::string new_run_identity();

/// What speaks against two files being of one run, as a sentence without a full stop; empty if
/// nothing does. Files of versions that gave no identity are taken together as they are.
std::string mixed_runs(const ResultsReader& results, const nlohmann::ordered_json& summary);

}  // namespace blocklift::pipeline
