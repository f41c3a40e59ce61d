#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <yaml-cpp/node/node.h>

#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {

/// The largest input file that is read, in bytes. Bigger files are data, not a description by hand.
constexpr std::uintmax_t largest_input_file = 10'000'000;

/// A YAML file in memory: its nodes know their line and column.
struct Document {
  std::shared_ptr<const std::string> file;  ///< path as it is shown in messages
  std::string text;                         ///< the file as it stands
  YAML::Node root;                          ///< never null

  Mark mark_of(const YAML::Node& node) const;
};

/// Reads a YAML file.
///
/// Complains about, and returns nothing for, a file that is missing, no ordinary file, unreadable,
/// larger than `largest_input_file` (without reading it), empty, binary, not UTF-8, not YAML,
/// nested beyond reason, or more than one YAML document.
std::optional<Document> load_document(const std::filesystem::path& path, Diagnostics& diagnostics);

/// The path as messages show it: relative to the working directory where that is shorter to say.
std::string shown_path(const std::filesystem::path& path);

}  // namespace blocklift::pipeline
