#pragma once

#include <string>
#include <vector>

namespace blocklift::pipeline {

/// Kinds of input files: "lift case", "crane", "rope", "block".
std::vector<std::string> input_file_kinds();

/// JSON schema (draft 2020-12) of the input files, from the declarations that the readers use: for
/// editors that complete and check YAML while one writes.
/// @param kind one of input_file_kinds(), or empty for a schema that takes any of them.
/// @throws std::invalid_argument if there is no such kind; the message lists those that exist.
std::string json_schema(const std::string& kind = {});

/// The manual of the input files in Markdown, key by key, from the same declarations.
/// @param kind as for json_schema; empty: all kinds.
std::string markdown_manual(const std::string& kind = {});

}  // namespace blocklift::pipeline
