#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

/// The object of a summary.json. @throws ResultsError if it is missing, unreadable or no object.
nlohmann::ordered_json read_summary(const std::filesystem::path& path);

}  // namespace blocklift::pipeline
