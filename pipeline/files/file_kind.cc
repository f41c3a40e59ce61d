#include "pipeline/files/file_kind.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/document.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::array files_of_folders{"case.yaml",   "mechanism.yaml", "part.yaml",
                                      "study.yaml",  "block.yaml",     "crane.yaml",
                                      "vessel.yaml", "vessels.yaml"};

constexpr std::array<std::pair<std::string_view, FileKind>, 7> kinds_of_models{
    {{"block", FileKind::block},
     {"crane", FileKind::crane},
     {"rigging", FileKind::rigging},
     {"rope", FileKind::rope},
     {"standard", FileKind::standard},
     {"vessel", FileKind::vessel},
     {"vessels", FileKind::vessels}}};

/// Keys by which a block, a lift case or a part is known.
constexpr std::array keys_of_blocks{"plates",   "bars",   "lugs",  "pads",
                                    "openings", "repeat", "mirror"};
constexpr std::array keys_of_cases{"case", "load", "cranes", "ropes", "operation", "load_table"};
constexpr std::array keys_of_parts{"supports", "loads", "probes", "hot_spots", "join"};

template <class Keys>
auto count_keys(const YAML::Node& root, const Keys& keys) {
  return std::count_if(keys.begin(), keys.end(),
                       [&](const char* key) { return static_cast<bool>(root[key]); });
}

/// The kind that a document says, or else that of a lift case.
FileKind kind_of_root(const YAML::Node& root) {
  if (!root.IsMap()) return FileKind::lift_case;
  if (root["mechanism"]) return FileKind::mechanism;
  if (root["part"]) return FileKind::part;
  if (root["study"]) return FileKind::study;
  const YAML::Node node = root["kind"];
  const std::string kind = node && node.IsScalar() ? node.Scalar() : std::string();
  for (const auto& [name, of_model] : kinds_of_models)
    if (kind == name) return of_model;
  return FileKind::lift_case;
}

bool begins_as_xml(const fs::path& path) {
  std::ifstream stream(path);
  std::string word;
  return stream >> word && word.starts_with('<');
}

}  // namespace

fs::path input_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  for (const char* name : files_of_folders)
    if (fs::exists(path / name, error)) return path / name;
  return path;
}

std::string name_of_input(const fs::path& path) {
  const fs::path file = fs::absolute(input_file(path)).lexically_normal();
  const fs::path folder = file.parent_path();
  const bool is_of_folder = std::find(files_of_folders.begin(), files_of_folders.end(),
                                      file.filename()) != files_of_folders.end();
  if (is_of_folder && folder.has_filename()) return folder.filename().string();
  return (file.has_filename() ? file : folder).stem().string();
}

FileKind kind_of_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const fs::path file = input_file(path);
    return file == path || file.filename() == "case.yaml" ? FileKind::lift_case
                                                          : kind_of_file(file);
  }
  if (fs::is_regular_file(path, error) && (path.extension() == ".urdf" || begins_as_xml(path))) {
    return FileKind::robot;
  }
  if (path.extension() == ".csv") return FileKind::rigging;
  Diagnostics ignored;  // the reader of the file says the same again
  const std::optional<Document> document = load_document(path, ignored);
  return document ? kind_of_root(document->root) : FileKind::lift_case;
}

bool complain_about_untold_kind(const fs::path& path, Diagnostics& diagnostics) {
  Diagnostics ignored;  // the reader of the file says the same again
  const std::optional<Document> document = load_document(input_file(path), ignored);
  return document && complain_about_untold_kind(*document, diagnostics);
}

bool complain_about_untold_kind(const Document& document, Diagnostics& diagnostics) {
  const YAML::Node& root = document.root;
  if (!root.IsMap() || kind_of_root(root) != FileKind::lift_case) return false;
  if (count_keys(root, keys_of_cases) > 0) return false;
  if (const YAML::Node kind = root["kind"]; kind && kind.IsScalar()) {
    std::vector<std::string> names;
    for (const auto& [name, of_model] : kinds_of_models) names.emplace_back(name);
    diagnostics.error(document.mark_of(kind),
                      fmt::format("kind \"{}\" is not known", kind.Scalar()),
                      {names_hint("the kinds of models are", names, kind.Scalar())});
    return true;
  }
  const YAML::Node mesh = root["mesh"];
  const bool has_units = mesh && mesh.IsMap() && mesh["units"];
  const auto of_block = count_keys(root, keys_of_blocks) + (has_units ? 1 : 0);
  const auto of_part = count_keys(root, keys_of_parts);
  if (of_block == 0 && of_part == 0) return false;
  const bool is_block = of_block >= of_part;
  diagnostics.error(
      document.mark_of(root),
      is_block ? "this is a block by its keys, and does not say so"
               : "this is a part by its keys, and has no name",
      {is_block ? "begin the file with \"kind: block\"" : "begin the file with \"part: NAME\""});
  return true;
}

}  // namespace blocklift::pipeline
