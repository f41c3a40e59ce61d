#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/lift/sling_lengths.h"

namespace blocklift::pipeline {

/// What the lengths of slings do, for the summary: SI units, slings by name.
nlohmann::ordered_json sling_lengths_json(const SlingLengths& lengths);

}  // namespace blocklift::pipeline
