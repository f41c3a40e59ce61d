#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// Kinds of cases that write_new_case can begin: "single-hook", "turn-over", "mechanism", "part".
std::vector<std::string> template_kinds();

/// Writes a commented case that runs into a new folder, under its name. The folder appears with all
/// its files or not at all.
/// @returns the command that runs it: "blocklift assess FOLDER".
/// @throws InputError if there is no such kind, if the folder is there, or cannot be made.
std::string write_new_case(const std::string& kind, const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
