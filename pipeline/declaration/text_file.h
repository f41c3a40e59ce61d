#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {

/// A file of text in memory.
struct TextFile {
  std::shared_ptr<const std::string> file;  ///< path as it is shown in messages
  std::string text;                         ///< as it stands, UTF-8
};

/// Reads a file of text, whatever its form. Complaints are those of load_document that are not
/// about YAML.
std::optional<TextFile> load_text(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
