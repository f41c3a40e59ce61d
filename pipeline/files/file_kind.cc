#include "pipeline/files/file_kind.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <system_error>

#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/document.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::array files_of_folders{"case.yaml",   "mechanism.yaml", "part.yaml",
                                      "study.yaml",  "block.yaml",     "crane.yaml",
                                      "vessel.yaml", "vessels.yaml"};

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
  if (!document || !document->root.IsMap()) return FileKind::lift_case;
  if (document->root["mechanism"]) return FileKind::mechanism;
  if (document->root["part"]) return FileKind::part;
  if (document->root["study"]) return FileKind::study;
  const YAML::Node node = document->root["kind"];
  const std::string kind = node && node.IsScalar() ? node.Scalar() : std::string();
  if (kind == "crane") return FileKind::crane;
  if (kind == "block") return FileKind::block;
  if (kind == "rope") return FileKind::rope;
  if (kind == "vessel") return FileKind::vessel;
  if (kind == "vessels") return FileKind::vessels;
  if (kind == "standard") return FileKind::standard;
  if (kind == "rigging") return FileKind::rigging;
  return FileKind::lift_case;
}

}  // namespace blocklift::pipeline
