#pragma once

#include <string>

namespace CLI {
class App;
}

namespace blocklift::pipeline {

/// Completion of commands, options and their words for bash, from the declarations of the command
/// line.
std::string bash_completion(const CLI::App& app);

/// The page for man (section 1, in man's macros), from the same declarations.
std::string manual_page(const CLI::App& app, const std::string& version);

}  // namespace blocklift::pipeline
