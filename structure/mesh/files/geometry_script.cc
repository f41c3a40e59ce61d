#include "structure/mesh/files/geometry_script.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/outside_files.h"

namespace blocklift::structure {

namespace {

/// Gmsh's words for statements that reach beyond the script.
constexpr std::array<std::string_view, 24> reaching_words = {"AutoMergeFile",
                                                             "BackgroundMesh",
                                                             "CreateDir",
                                                             "FileExists",
                                                             "GetEnv",
                                                             "Include",
                                                             "ListFromFile",
                                                             "Merge",
                                                             "MergeFile",
                                                             "MergeWithBoundingBox",
                                                             "NonBlockingSystem",
                                                             "NonBlockingSystemCall",
                                                             "OnelabAction",
                                                             "OnelabRun",
                                                             "Open",
                                                             "OpenProject",
                                                             "Parse",
                                                             "Plugin",
                                                             "Print",
                                                             "Save",
                                                             "ShapeFromFile",
                                                             "Solver",
                                                             "System",
                                                             "SystemCall"};
/// Those that write into a file if one follows a ">".
constexpr std::array<std::string_view, 3> printing_words = {"Printf", "Error", "Warning"};

/// Endings of formats that hold data alone, by which Gmsh tells them.
bool is_data(const std::string& path) {
  constexpr std::array<std::string_view, 12> data = {".step", ".stp",  ".iges", ".igs",
                                                     ".brep", ".stl",  ".unv",  ".vtk",
                                                     ".med",  ".mesh", ".cgns", ".ply"};
  return std::find(data.begin(), data.end(), ending_of(path)) != data.end();
}

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The end of a comment or of a quoted text that begins at a place; that place if none does.
std::size_t skipped(std::string_view text, std::size_t at) {
  const auto end_of = [&](std::string_view mark, std::size_t from) {
    const std::size_t end = text.find(mark, from);
    return end == std::string_view::npos ? text.size() : end + mark.size();
  };
  if (text.substr(at, 2) == "//") return std::min(text.find_first_of("\r\n", at), text.size());
  if (text.substr(at, 2) == "/*") return end_of("*/", at + 2);
  if (text[at] == '"' || text[at] == '\'') return end_of(text.substr(at, 1), at + 1);
  return at;
}

/// Whether a ">" stands in what is left of a statement.
bool is_redirected(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != ';' && text[at] != '>') {
    const std::size_t end = skipped(text, at);
    at = end > at ? end : at + 1;
  }
  return at < text.size() && text[at] == '>';
}

bool is_among(std::string_view word, const auto& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

void require_closed_script(const std::string& path) {
  if (are_files_outside_allowed() || is_data(path)) return;
  std::ifstream file(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string_view text = all;
  if (text.starts_with("$MeshFormat") || text.starts_with("$NOD")) return;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    while (at < text.size() && is_of_word(text[at])) ++at;
    if (at == begin) {
      const std::size_t end = skipped(text, at);
      at = end > at ? end : at + 1;
      continue;
    }
    const std::string_view word = text.substr(begin, at - begin);
    const bool reaches = is_among(word, reaching_words) || word.ends_with("FileName") ||
                         (is_among(word, printing_words) && is_redirected(text, at));
    if (!reaches) continue;
    const auto lines = std::count(text.begin(), text.begin() + static_cast<long>(begin), '\n');
    throw ModelError(fmt::format(
        "line {}: {} may reach other files or programs, which a geometry must not; if you trust "
        "this input: --allow-outside, or {}=1 in the environment",
        lines + 1, word, allow_outside_variable));
  }
}

}  // namespace blocklift::structure
