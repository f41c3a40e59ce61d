#include "pipeline/templates/new_case.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/document.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/templates/template_file.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view name_mark = "NAME_OF_FOLDER";

[[noreturn]] void refuse(const fs::path& folder, std::string message,
                         std::vector<std::string> hints = {}) {
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(folder.string()), 0, 0},
                    std::move(message), std::move(hints));
  throw InputError(diagnostics);
}

/// The folder's name with what no name may hold turned into hyphens.
std::string name_for(const fs::path& folder) {
  fs::path whole = fs::absolute(folder).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  std::string name = whole.filename().string();
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter)) && letter != '_') letter = '-';
  return name;
}

std::string filled(std::string text, const std::string& name) {
  for (std::size_t at = text.find(name_mark); at != std::string::npos;
       at = text.find(name_mark, at + name.size()))
    text.replace(at, name_mark.size(), name);
  return text;
}

/// The command that runs a file of a template.
std::string command_for(const std::string& file) {
  if (file == "part.yaml") return "stress";
  if (file == "study.yaml") return "sweep";
  return file == "mechanism.yaml" ? "simulate" : "assess";
}

/// A study is one of the case with a single hook, which is written beside it.
bool belongs_to(const TemplateFile& file, const std::string& kind) {
  return file.kind == kind || (kind == "study" && file.kind == "single-hook");
}

}  // namespace

std::vector<std::string> template_kinds() {
  std::vector<std::string> kinds;
  for (const TemplateFile& file : template_files())
    if (std::find(kinds.begin(), kinds.end(), file.kind) == kinds.end()) kinds.push_back(file.kind);
  return kinds;
}

std::string write_new_case(const std::string& kind, const fs::path& folder) {
  const std::vector<std::string> kinds = template_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    refuse(kind, "is no kind of case", {names_hint("the kinds are", kinds, kind)});
  if (folder.empty()) refuse(folder, "the name of the folder is empty");
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)))
    refuse(folder, "is there already", {"a new case goes into a new folder"});
  // All files first lie beside the folder's place; renaming them there cannot stop halfway.
  fs::path whole = fs::absolute(folder).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  const fs::path aside = whole.parent_path() / ("." + whole.filename().string() + ".new");
  const std::string name = name_for(folder);
  std::string command;
  try {
    for (const TemplateFile& file : template_files()) {
      if (!belongs_to(file, kind)) continue;
      write_file(aside / file.name, filled(file.text, name));
      // A part has no folder's name: its file is named.
      if (command.empty() && file.kind == kind) {
        const std::string run = command_for(file.name);
        command = fmt::format("blocklift {} {}", run,
                              run == "assess" ? folder.string() : (folder / file.name).string());
      }
    }
    fs::rename(aside, whole);
  } catch (const std::exception& failure) {
    fs::remove_all(aside, error);
    refuse(folder, fmt::format("cannot be written: {}", failure.what()));
  }
  return command;
}

}  // namespace blocklift::pipeline
