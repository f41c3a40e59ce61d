#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

/// Holds a summary against what results_layout.h says of it: the kinds of the values, the lengths
/// of points, and the names without which a row says nothing. Keys that it does not know may be
/// anything.
/// @returns what is wrong, each a sentence that names the key, what is there and what is due:
///   "ropes.R1.max_static_tension_N" is the text "a"; a number or null is due. At most twenty.
std::vector<std::string> complaints_about_summary(const nlohmann::ordered_json& summary);

}  // namespace blocklift::pipeline
