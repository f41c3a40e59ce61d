#include "pipeline/files/named_file.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "structure/outside_files.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> folders_of(const std::string& list) {
  std::vector<fs::path> folders;
  std::istringstream stream(list);
  for (std::string folder; std::getline(stream, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

/// The program in whose place this process reads; empty: it is the program itself.
fs::path& other_program() {
  static fs::path program;
  return program;
}

bool goes_up(const fs::path& name) {
  return std::any_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

}  // namespace

std::vector<fs::path> model_path() {
  if (const char* list = std::getenv("BLOCKLIFT_MODELS")) return folders_of(list);
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path executable = other_program().empty() ? fs::read_symlink("/proc/self/exe", error)
                                                      : fs::canonical(other_program(), error);
  if (!error) {
    const fs::path place = executable.parent_path();
    folders = {place / "models", place.parent_path() / "share" / "blocklift" / "models",
               place.parent_path().parent_path() / "models"};
  }
  folders.emplace_back(BLOCKLIFT_SOURCE_MODELS);
  std::erase_if(folders, [](const fs::path& folder) {
    std::error_code ignored;
    return !fs::is_directory(folder, ignored);
  });
  return folders;
}

void take_models_of(const fs::path& program) { other_program() = program; }

bool is_within(const fs::path& name, const fs::path& folder, const std::vector<fs::path>& homes,
               const std::vector<fs::path>& models) {
  const bool goes_down = name.is_relative() && !goes_up(name);
  if (goes_down && structure::leads_into(folder, models)) return true;
  return structure::leads_into(folder / name, homes) ||
         structure::leads_into(folder / name, models);
}

void complain_about_outside(const Located<std::string>& name, Diagnostics& diagnostics) {
  diagnostics.error(
      name.mark,
      fmt::format("\"{}\" leads outside the folder of this input and the models", name.value),
      {"files that input names lie in the folder of the file that names them, of its case, or of "
       "models (BLOCKLIFT_MODELS); symbolic links are followed",
       fmt::format("if you trust this input: --allow-outside, or {}=1 in the environment",
                   structure::allow_outside_variable)});
}

std::optional<fs::path> path_of_named_file(const Located<std::string>& name, const fs::path& folder,
                                           Diagnostics& diagnostics, std::vector<fs::path> homes) {
  homes.push_back(folder);
  if (!structure::are_files_outside_allowed() &&
      !is_within(name.value, folder, homes, model_path())) {
    complain_about_outside(name, diagnostics);
    return std::nullopt;
  }
  return folder / name.value;
}

}  // namespace blocklift::pipeline
