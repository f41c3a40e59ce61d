#include "structure/mesh/files/abaqus_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/outside_files.h"

namespace blocklift::structure {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  std::string inner = text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
  if (inner.size() >= 2 && inner.front() == '"' && inner.back() == '"')
    inner = inner.substr(1, inner.size() - 2);
  return inner;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t start = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos;
       comma = line.find(',', start)) {
    fields.push_back(trimmed(line.substr(start, comma - start)));
    start = comma + 1;
  }
  if (const std::string last = trimmed(line.substr(start)); !last.empty()) fields.push_back(last);
  return fields;
}

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Nodes of an element type; none if it is not known.
std::optional<std::size_t> nodes_of_type(const std::string& type) {
  constexpr std::string_view stem = "C3D", endings = "RIHMST";
  if (type.rfind(stem, 0) != 0) return std::nullopt;
  std::size_t end = stem.size();
  while (end < type.size() && std::isdigit(static_cast<unsigned char>(type[end])) != 0) ++end;
  for (std::size_t i = end; i < type.size(); ++i)
    if (endings.find(type[i]) == std::string_view::npos) return std::nullopt;
  const std::string count = type.substr(stem.size(), end - stem.size());
  for (const std::size_t known : {4U, 6U, 8U, 10U, 15U, 20U})
    if (count == std::to_string(known)) return known;
  return std::nullopt;
}

// Nodes of a plate or line; none if the type is neither.
std::optional<std::size_t> nodes_of_face_type(const std::string& type) {
  static const std::map<std::string, std::size_t> known = {
      {"CPS3", 3}, {"CPS4", 4},  {"CPS6", 6},   {"CPS8", 8}, {"CPS4R", 4}, {"CPS8R", 8},
      {"S3", 3},   {"S4", 4},    {"S6", 6},     {"S8", 8},   {"S4R", 4},   {"S8R", 8},
      {"S3R", 3},  {"STRI3", 3}, {"STRI65", 6}, {"T3D2", 2}, {"T3D3", 3}};
  const auto found = known.find(type);
  if (found == known.end()) return std::nullopt;
  return found->second;
}

/// A keyword line: *ELEMENT, TYPE=C3D8, ELSET=plate.
struct Keyword {
  std::string name;                               ///< capitals
  std::map<std::string, std::string> parameters;  ///< by capitals
  bool has(const std::string& parameter) const { return parameters.count(parameter) > 0; }
};

Keyword parse_keyword(const std::string& line) {
  Keyword keyword;
  const std::vector<std::string> fields = split(line.substr(1));
  keyword.name = fields.empty() ? std::string() : upper(fields[0]);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::size_t equals = fields[i].find('=');
    keyword.parameters[upper(trimmed(fields[i].substr(0, equals)))] =
        equals == std::string::npos ? std::string() : trimmed(fields[i].substr(equals + 1));
  }
  return keyword;
}

class AbaqusReader {
 public:
  AbaqusMesh read(const std::string& path) {
    folder_ = std::filesystem::path(path).parent_path();
    read_file(path, 0);
    finish_keyword();
    check_nodes();
    if (mesh_.elements.empty() && mesh_.plates.empty())
      throw ModelError(path + ": it holds no solid elements");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ModelError(fmt::format("{}:{}: {}", path_, line_, what));
  }

  void read_file(const std::string& path, int depth) {
    std::ifstream file(path);
    if (!file)
      throw ModelError(path_.empty()
                           ? path + ": there is no such file"
                           : fmt::format("{}:{}: there is no file \"{}\"", path_, line_, path));
    constexpr int deepest = 10;
    if (depth > deepest) fail("files include one another without end");
    const std::string outer_path = std::exchange(path_, path);
    const int outer_line = std::exchange(line_, 0);
    for (std::string line; std::getline(file, line);) {
      ++line_;
      line = trimmed(line);
      if (line.empty() || line.rfind("**", 0) == 0) continue;
      if (line.front() != '*') {
        read_data(line);
        continue;
      }
      // A keyword may go on in the next line after a comma.
      for (std::string more; line.back() == ',' && std::getline(file, more); ++line_)
        line += trimmed(more);
      begin_keyword(parse_keyword(line), depth);
    }
    path_ = outer_path;
    line_ = outer_line;
  }

  void begin_keyword(Keyword keyword, int depth) {
    finish_keyword();
    // Copies: keywords of the file that is named take this one's place.
    const std::string name = keyword.name;
    const bool names_file = name == "INCLUDE" || (keyword.has("INPUT") && has_data_here(name));
    const std::string input = names_file ? required(keyword, "INPUT") : std::string();
    // A file that is included may go on with the data of the keyword before.
    if (name != "INCLUDE") {
      keyword_ = std::move(keyword);
      begin_data();
    }
    if (names_file) read_beside(name, input, depth);
  }

  void begin_data() {
    if (keyword_.name == "ELEMENT") {
      const std::string type = upper(required("TYPE"));
      auto nodes = nodes_of_type(type);
      is_solid_ = nodes.has_value();
      is_line_ = type.rfind("T3D", 0) == 0;
      if (!nodes) nodes = nodes_of_face_type(type);
      if (!nodes)
        fail(
            fmt::format("elements of type {} are not known; solids are: C3D4, C3D6, C3D8, C3D10, "
                        "C3D15, C3D20",
                        type));
      element_nodes_ = *nodes;
    } else if (keyword_.name == "PART" && ++parts_ > 1) {
      fail(
          "a second part; a part's mesh is one part: write a flat file (Abaqus: *PREPRINT, "
          "MODEL=YES or \"do not use parts and assemblies\")");
    } else if (keyword_.name == "NSET" && keyword_.has("ELSET")) {
      nodes_of_element_set(keyword_.parameters["ELSET"]);
    }
  }

  static bool has_data_here(const std::string& keyword) {
    return keyword == "NODE" || keyword == "ELEMENT" || keyword == "NSET" || keyword == "ELSET" ||
           keyword == "SURFACE";
  }

  void read_beside(const std::string& keyword, const std::string& input, int depth) {
    const auto beside = std::filesystem::path(path_).parent_path() / input;
    if (!are_files_outside_allowed() && !leads_into(beside, {folder_}))
      fail(
          fmt::format("*{}: \"{}\" lies outside the folder of this mesh; only files in it "
                      "or below are included, unless --allow-outside, or {}=1 in the "
                      "environment, says otherwise",
                      keyword, input, allow_outside_variable));
    read_file(beside.string(), depth + 1);
  }

  std::string required(const Keyword& keyword, const std::string& parameter) const {
    const auto found = keyword.parameters.find(parameter);
    if (found == keyword.parameters.end() || found->second.empty())
      fail(fmt::format("*{} needs {}=...", keyword.name, parameter));
    return found->second;
  }

  std::string required(const std::string& parameter) const { return required(keyword_, parameter); }

  // An element whose nodes end before they should.
  void finish_keyword() {
    if (!pending_.empty())
      fail(fmt::format("element {} ends after {} of {} nodes", pending_[0], pending_.size() - 1,
                       element_nodes_));
  }

  void read_data(const std::string& line) {
    const std::vector<std::string> fields = split(line);
    if (keyword_.name == "NODE")
      read_node(fields);
    else if (keyword_.name == "ELEMENT")
      read_element(fields);
    else if (keyword_.name == "NSET")
      read_set(fields, "NSET", mesh_.node_sets);
    else if (keyword_.name == "ELSET")
      read_set(fields, "ELSET", mesh_.element_sets);
    else if (keyword_.name == "SURFACE")
      read_surface(fields);
    else if (keyword_.name == "INSTANCE")
      fail(
          "an instance that is moved or turned; write a flat file (\"do not use parts and "
          "assemblies\")");
  }

  std::size_t tag_of(const std::string& text) const {
    std::size_t tag = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), tag);
    if (error != std::errc() || end != text.data() + text.size() || tag == 0)
      fail(fmt::format("\"{}\" is no number of a node or element", text));
    return tag;
  }

  double value_of(std::string text) const {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
    const std::size_t sign = text.rfind('+', 0) == 0 ? 1 : 0;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(fmt::format("\"{}\" is no coordinate", text));
    return value;
  }

  // The name as it was written first: capitals do not matter.
  template <typename Contents>
  Contents& named(std::map<std::string, Contents>& all, const std::string& name) {
    for (auto& [known, contents] : all)
      if (upper(known) == upper(name)) return contents;
    return all[name];
  }

  template <typename Contents>
  Contents* find(std::map<std::string, Contents>& all, const std::string& name) {
    for (auto& [known, contents] : all)
      if (upper(known) == upper(name)) return &contents;
    return nullptr;
  }

  void read_node(const std::vector<std::string>& fields) {
    if (fields.size() < 2 || fields.size() > 4)
      fail("a node is a number and up to three coordinates: 17, 0.5, 1.0, 0.0");
    const std::size_t tag = tag_of(fields[0]);
    std::array<double, 3> place{};
    for (std::size_t i = 1; i < fields.size(); ++i)
      place[i - 1] = fields[i].empty() ? 0 : value_of(fields[i]);
    if (!mesh_.nodes.emplace(tag, place).second) fail(fmt::format("node {} is there twice", tag));
    if (keyword_.has("NSET")) named(mesh_.node_sets, keyword_.parameters["NSET"]).push_back(tag);
  }

  void read_element(const std::vector<std::string>& fields) {
    for (const std::string& field : fields) pending_.push_back(tag_of(field));
    if (pending_.size() <= element_nodes_) return;
    if (pending_.size() > element_nodes_ + 1)
      fail(fmt::format("element {} has {} nodes; its type has {}", pending_[0], pending_.size() - 1,
                       element_nodes_));
    AbaqusElement element{pending_[0], {pending_.begin() + 1, pending_.end()}};
    pending_.clear();
    if (!element_lines_.emplace(element.tag, std::pair(path_, line_)).second)
      fail(fmt::format("element {} is there twice", element.tag));
    if (is_line_) return;
    auto& elements = is_solid_ ? mesh_.elements : mesh_.plates;
    (is_solid_ ? place_of_element_ : place_of_plate_)[element.tag] = elements.size();
    if (keyword_.has("ELSET"))
      named(mesh_.element_sets, keyword_.parameters["ELSET"]).push_back(element.tag);
    elements.push_back(std::move(element));
  }

  // Sets grow without end by large steps of numbers, or when they name themselves.
  void require_few(std::size_t members) const {
    constexpr std::size_t most = 20'000'000;
    if (members > most) fail(fmt::format("the set has more than {} members", most));
  }

  void read_set(const std::vector<std::string>& fields, const std::string& parameter,
                std::map<std::string, std::vector<std::size_t>>& sets) {
    std::vector<std::size_t>& set = named(sets, required(parameter));
    if (keyword_.has("GENERATE")) {
      if (fields.size() < 2 || fields.size() > 3)
        fail("with GENERATE a line is first, last and step: 1, 99, 2");
      const std::size_t first = tag_of(fields[0]), last = tag_of(fields[1]);
      const std::size_t step = fields.size() == 3 ? tag_of(fields[2]) : 1;
      if (first <= last) require_few((last - first) / step);
      for (std::size_t tag = first; tag <= last; tag += step) set.push_back(tag);
      return;
    }
    for (const std::string& field : fields) {
      if (is_number(field)) {
        set.push_back(tag_of(field));
        continue;
      }
      const auto* other = find(sets, field);
      if (!other) fail(fmt::format("there is no set \"{}\" before this line", field));
      const std::vector<std::size_t> copy = *other;
      require_few(set.size() + copy.size());
      set.insert(set.end(), copy.begin(), copy.end());
    }
  }

  void nodes_of_element_set(const std::string& name) {
    const auto* elements = find(mesh_.element_sets, name);
    if (!elements) fail(fmt::format("there is no element set \"{}\" before this line", name));
    std::set<std::size_t> nodes;
    for (const std::size_t tag : *elements) {
      const AbaqusElement* element = find_element(tag);
      if (element == nullptr) continue;  // named where the sets are checked
      nodes.insert(element->nodes.begin(), element->nodes.end());
    }
    std::vector<std::size_t>& set = named(mesh_.node_sets, required("NSET"));
    set.insert(set.end(), nodes.begin(), nodes.end());
  }

  /// Solid or plate; null for none.
  const AbaqusElement* find_element(std::size_t tag) const {
    if (const auto solid = place_of_element_.find(tag); solid != place_of_element_.end())
      return &mesh_.elements[solid->second];
    const auto plate = place_of_plate_.find(tag);
    return plate == place_of_plate_.end() ? nullptr : &mesh_.plates[plate->second];
  }

  void read_surface(const std::vector<std::string>& fields) {
    const std::string name = required("NAME");
    if (keyword_.has("TYPE") && upper(keyword_.parameters["TYPE"]) == "NODE") {
      for (const std::string& field : fields) {
        if (is_number(field)) {
          named(mesh_.node_sets, name).push_back(tag_of(field));
          continue;
        }
        if (const auto* other = find(mesh_.node_sets, field)) {
          const std::vector<std::size_t> copy = *other;
          auto& set = named(mesh_.node_sets, name);
          set.insert(set.end(), copy.begin(), copy.end());
        }
      }
      return;
    }
    if (fields.size() != 2 || fields[1].size() != 2 || std::toupper(fields[1][0]) != 'S')
      fail("a line of a surface is an element or a set and a face: plate, S2");
    std::vector<std::size_t> elements;
    if (is_number(fields[0])) {
      elements = {tag_of(fields[0])};
    } else {
      const auto* set = find(mesh_.element_sets, fields[0]);
      if (!set) fail(fmt::format("there is no element set \"{}\" before this line", fields[0]));
      elements = *set;
    }
    for (const std::size_t tag : elements) add_face(name, tag, fields[1][1] - '0');
  }

  void add_face(const std::string& name, std::size_t tag, int face) {
    const auto found = place_of_element_.find(tag);
    if (found == place_of_element_.end())
      fail(place_of_plate_.count(tag) > 0 ? fmt::format("element {} is no solid", tag)
                                          : fmt::format("there is no element {}", tag));
    const auto& faces = abaqus_faces(mesh_.elements[found->second].nodes.size());
    if (face < 1 || face > static_cast<int>(faces.size()))
      fail(fmt::format("element {} has no face S{}; it has {} faces", tag, face, faces.size()));
    named(mesh_.surfaces, name).push_back({tag, face});
  }

  void check_nodes() {
    for (const auto* elements : {&mesh_.elements, &mesh_.plates})
      for (const AbaqusElement& element : *elements)
        for (const std::size_t node : element.nodes)
          if (mesh_.nodes.count(node) == 0) {
            std::tie(path_, line_) = element_lines_.at(element.tag);
            fail(fmt::format("element {} names node {}, which does not exist", element.tag, node));
          }
    for (const auto& [name, set] : mesh_.element_sets) {
      std::vector<std::size_t> plates;
      std::copy_if(set.begin(), set.end(), std::back_inserter(plates),
                   [&](std::size_t tag) { return place_of_plate_.count(tag) > 0; });
      if (!plates.empty()) mesh_.plate_sets[name] = std::move(plates);
    }
    // Sets may name what is not there (generated ranges with gaps): that much is left out.
    for (auto& [name, set] : mesh_.element_sets)
      set.erase(std::remove_if(set.begin(), set.end(),
                               [&](std::size_t tag) { return place_of_element_.count(tag) == 0; }),
                set.end());
    // Of lines and plates alone: no group of solids.
    if (element_lines_.size() > mesh_.elements.size())
      std::erase_if(mesh_.element_sets, [](const auto& entry) { return entry.second.empty(); });
    for (auto& [name, set] : mesh_.node_sets)
      set.erase(std::remove_if(set.begin(), set.end(),
                               [&](std::size_t tag) { return mesh_.nodes.count(tag) == 0; }),
                set.end());
  }

  AbaqusMesh mesh_;
  std::filesystem::path folder_;  // of the file that is read first
  std::string path_;
  int line_ = 0, parts_ = 0;
  Keyword keyword_;
  std::size_t element_nodes_ = 0;
  std::vector<std::size_t> pending_;  ///< of an element that goes on in the next line
  std::map<std::size_t, std::pair<std::string, int>> element_lines_;  ///< file and line
  std::map<std::size_t, std::size_t> place_of_element_, place_of_plate_;
  bool is_solid_ = false, is_line_ = false;  ///< elements that are being read
};

// Corners of the mid-edge nodes, in Abaqus' order.
std::vector<std::array<int, 2>> edges(int corners) {
  if (corners == 4) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  if (corners == 6) return {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
          {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
}

}  // namespace

AbaqusMesh read_abaqus(const std::string& path) { return AbaqusReader().read(path); }

int abaqus_corners(std::size_t nodes) {
  if (nodes == 4 || nodes == 10) return 4;
  return nodes == 6 || nodes == 15 ? 6 : 8;
}

const std::vector<std::vector<int>>& abaqus_faces(std::size_t nodes) {
  using Faces = std::vector<std::vector<int>>;
  static const Faces tetrahedron = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  static const Faces wedge = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const Faces hexahedron = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                   {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  const int corners = abaqus_corners(nodes);
  return corners == 4 ? tetrahedron : corners == 6 ? wedge : hexahedron;
}

std::vector<std::size_t> face_nodes(const AbaqusElement& element, int face) {
  const std::vector<int>& corners = abaqus_faces(element.nodes.size())[face - 1];
  std::vector<std::size_t> nodes;
  for (const int corner : corners) nodes.push_back(element.nodes[corner]);
  const int corner_count = abaqus_corners(element.nodes.size());
  if (static_cast<int>(element.nodes.size()) == corner_count) return nodes;
  const auto all = edges(corner_count);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int a = corners[i], b = corners[(i + 1) % corners.size()];
    for (std::size_t e = 0; e < all.size(); ++e)
      if ((all[e][0] == a && all[e][1] == b) || (all[e][0] == b && all[e][1] == a))
        nodes.push_back(element.nodes[corner_count + e]);
  }
  return nodes;
}

}  // namespace blocklift::structure
