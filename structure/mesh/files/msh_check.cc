#include "structure/mesh/files/msh_check.h"

#include <fstream>
#include <sstream>
#include <unordered_set>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

// Goes on behind the line that holds a section's name alone.
bool find_section(std::istream& file, const std::string& name) {
  for (std::string line; std::getline(file, line);)
    if (line.rfind(name, 0) == 0) return true;
  return false;
}

bool is_text_of_format_2(std::istream& file) {
  double version = 0;
  int is_binary = 1;
  return find_section(file, "$MeshFormat") && file >> version >> is_binary && version >= 2 &&
         version < 3 && is_binary == 0;
}

}  // namespace

void require_known_nodes(const std::string& path) {
  std::ifstream file(path);
  std::size_t count = 0;
  if (!is_text_of_format_2(file) || !find_section(file, "$Nodes") || !(file >> count)) return;
  std::unordered_set<std::size_t> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t tag = 0;
    double x = 0, y = 0, z = 0;
    if (!(file >> tag >> x >> y >> z)) return;
    nodes.insert(tag);
  }
  if (!find_section(file, "$Elements") || !(file >> count)) return;
  std::string line;
  std::getline(file, line);
  for (std::size_t i = 0; i < count && std::getline(file, line); ++i) {
    // Number, type, how many marks, the marks, the nodes.
    std::istringstream numbers(line);
    std::size_t element = 0, type = 0, marks = 0, value = 0;
    if (!(numbers >> element >> type >> marks)) return;
    for (std::size_t m = 0; m < marks && numbers; ++m) numbers >> value;
    while (numbers >> value)
      if (nodes.count(value) == 0)
        throw ModelError(
            fmt::format("element {} names node {}, which does not exist", element, value));
  }
}

}  // namespace blocklift::structure
