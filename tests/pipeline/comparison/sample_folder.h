#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline::test {

/// The summary of a lift by two ropes of 100 and 200 kN at rest.
nlohmann::ordered_json sample_summary();

/// Writes a folder of results: a summary, and results.h5 with the input and tensions of two ropes.
/// @param block the text of the case's one model; empty: results of a version that kept none.
void write_sample_folder(const std::filesystem::path& folder, const nlohmann::ordered_json& summary,
                         const std::string& yaml, const std::string& block);

}  // namespace blocklift::pipeline::test
