#include "pipeline/command_line/validate_command.h"

#include <filesystem>
#include <iostream>
#include <optional>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/assessment/block_preparation.h"
#include "pipeline/input/document.h"
#include "pipeline/input/lift_case.h"
#include "pipeline/input/operation_schedule.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

std::string count(std::size_t number, const std::string& noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

/// The `kind` that a model file names; empty for lift cases and for what cannot be read.
std::string kind_of(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return {};
  Diagnostics ignored;  // the reader of the lift case says the same again
  const std::optional<Document> document = load_document(path, ignored);
  if (!document || !document->root.IsMap()) return {};
  const YAML::Node kind = document->root["kind"];
  return kind && kind.IsScalar() ? kind.Scalar() : std::string();
}

std::string summary_of(const LiftCase& lift_case) {
  if (lift_case.load_table) {
    return fmt::format("load table with {}",
                       count(lift_case.load_table->static_loads.size(), "lug"));
  }
  Diagnostics none;
  const Schedule schedule = schedule_operation(lift_case, none);
  return fmt::format("{}, {}, {}, {:.0f} s", count(lift_case.cranes.size(), "crane"),
                     count(lift_case.ropes.size(), "rope"), count(schedule.stages.size(), "stage"),
                     schedule.duration);
}

/// Reads one file of whatever kind; what it is, if it is sound.
std::optional<std::string> validate(const fs::path& path, ModelLibrary& library,
                                    Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  const auto if_sound = [&](std::string summary) -> std::optional<std::string> {
    if (diagnostics.error_count() > errors_before) return std::nullopt;
    return summary;
  };
  const std::string kind = kind_of(path);
  if (kind == "crane") {
    const auto crane = library.read_crane(path, diagnostics);
    if (!crane) return std::nullopt;
    return if_sound(fmt::format(
        "crane with {}, {} and {}",
        crane->bodies.size() == 1 ? "1 body" : fmt::format("{} bodies", crane->bodies.size()),
        count(crane->drives.size(), "drive"), count(crane->hoists.size(), "hoist")));
  }
  if (kind == "block") {
    const auto block = library.read_block(path, diagnostics);
    if (!block || diagnostics.error_count() > errors_before) return std::nullopt;
    check_block_model(*block, path.string(), diagnostics);
    return if_sound(fmt::format("block with {} and {}",
                                count(block->plates.size(), "kind") + " of plates",
                                count(block->lugs.size(), "lug")));
  }
  if (kind == "rope") {
    library.read_rope(path, diagnostics);
    return if_sound("rope");
  }
  const std::optional<LiftCase> lift_case = read_lift_case(path, library, diagnostics);
  if (!lift_case) return std::nullopt;
  check_block_model(*lift_case->load.model, lift_case->load.model_name.value, diagnostics);
  return if_sound(fmt::format("lift case {}: {}", lift_case->name, summary_of(*lift_case)));
}

}  // namespace

int validate_files(const std::vector<std::string>& files) {
  Diagnostics diagnostics;
  ModelLibrary library = ModelLibrary::of_installation();
  for (const std::string& file : files) {
    if (const auto summary = validate(file, library, diagnostics)) {
      std::cout << fmt::format("{}: valid, {}\n", shown_path(file), *summary);
    }
  }
  std::cerr << diagnostics.to_text();
  return diagnostics.has_errors() ? 2 : 0;
}

}  // namespace blocklift::pipeline
