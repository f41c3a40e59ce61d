#include "structure/mesh/files/universal_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/mesh/files/abaqus_file.h"
#include "structure/mesh/files/abaqus_model.h"

namespace blocklift::structure {

namespace {

using NodeTags = std::vector<std::size_t>;

/// A kind of element: Gmsh's type, and where the file has each of Gmsh's nodes, and each of
/// Abaqus' of a solid.
struct UniversalKind {
  int dimension = 0, type = 0;
  std::vector<std::size_t> place;
  std::vector<std::size_t> place_for_faces = {};
};

/// The file goes round an element's edges and has the middles between the corners; Gmsh has the
/// corners first. Source: Gmsh's manual, node ordering.
const UniversalKind* universal_kind(int descriptor, std::size_t nodes) {
  static const UniversalKind line{1, 1, {0, 1}}, curve{1, 8, {0, 2, 1}};
  static const std::map<std::size_t, UniversalKind> plates = {
      {3, {2, 2, {0, 1, 2}}},
      {4, {2, 3, {0, 1, 2, 3}}},
      {6, {2, 9, {0, 2, 4, 1, 3, 5}}},
      {8, {2, 16, {0, 2, 4, 6, 1, 3, 5, 7}}}};
  static const std::map<std::pair<int, std::size_t>, UniversalKind> solids = {
      {{111, 4}, {3, 4, {0, 1, 2, 3}, {0, 1, 2, 3}}},
      {{112, 6}, {3, 6, {0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}}},
      {{115, 8}, {3, 5, {0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}}},
      {{118, 10}, {3, 11, {0, 2, 4, 9, 1, 3, 5, 6, 8, 7}, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}}},
      {{113, 15},
       {3,
        18,
        {0, 2, 4, 9, 11, 13, 1, 5, 6, 3, 7, 8, 10, 14, 12},
        {0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8}}},
      {{116, 20},
       {3,
        17,
        {0, 2, 4, 6, 12, 14, 16, 18, 1, 7, 8, 3, 9, 5, 10, 11, 13, 19, 15, 17},
        {0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11}}}};
  if (descriptor == 11 || (descriptor >= 21 && descriptor <= 24))
    return nodes == 2 ? &line : nodes == 3 ? &curve : nullptr;
  // Plane stress, plane strain, plate, membrane and thin shell.
  static const std::set<int> plate_decades = {4, 5, 6, 7, 9};
  if (plate_decades.count(descriptor / 10) > 0) {
    const auto plate = plates.find(nodes);
    return plate == plates.end() ? nullptr : &plate->second;
  }
  const auto solid = solids.find({descriptor, nodes});
  return solid == solids.end() ? nullptr : &solid->second;
}

struct UniversalElement {
  std::size_t tag = 0;
  const UniversalKind* kind = nullptr;
  NodeTags nodes;            ///< in Gmsh's order
  NodeTags nodes_for_faces;  ///< of a solid: in Abaqus' order
  std::set<std::size_t> groups;
};

struct UniversalGroup {
  std::string name;
  NodeTags nodes;
  std::set<int> dimensions;  ///< of its elements
};

struct UniversalMesh {
  std::map<std::size_t, std::array<double, 3>> nodes;
  std::vector<UniversalElement> elements;
  std::vector<UniversalGroup> groups;
};

/// Reads the datasets, each between two lines of -1.
class UniversalReader {
 public:
  explicit UniversalReader(const std::string& path) : file_(path) {}

  UniversalMesh read() {
    while (next()) {
      if (trimmed() != "-1") continue;
      if (!next()) break;
      const std::string dataset = trimmed();
      if (dataset == "15")
        read_nodes(1);
      else if (dataset == "781" || dataset == "2411")
        read_nodes(2);
      else if (dataset == "2412")
        read_elements();
      else if (is_of_groups(dataset))
        read_groups(dataset < "2435" ? 2 : 4);
      else if (dataset == "71" || dataset == "780")
        fail("elements of dataset " + dataset + " are not known; write dataset 2412");
      else
        while (goes_on()) {
        }
    }
    return std::move(mesh_);
  }

 private:
  static bool is_of_groups(const std::string& dataset) {
    static const std::set<std::string> known = {"2429", "2430", "2432", "2435",
                                                "2452", "2467", "2477"};
    return known.count(dataset) > 0;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw ModelError(fmt::format("line {}: {}", line_number_, what));
  }

  bool next() {
    ++line_number_;
    return static_cast<bool>(std::getline(file_, line_));
  }

  std::string trimmed() const {
    const auto first = line_.find_first_not_of(" \t\r");
    if (first == std::string::npos) return {};
    return line_.substr(first, line_.find_last_not_of(" \t\r") + 1 - first);
  }

  /// The next line, unless the dataset ends with it.
  bool goes_on() {
    if (!next()) fail("the file ends within a dataset; is it cut off?");
    return trimmed() != "-1";
  }

  /// A further line of what has begun.
  void require_line(const char* what) {
    if (!goes_on()) fail(fmt::format("the dataset ends within {}", what));
  }

  std::vector<std::size_t> whole_numbers(std::size_t at_least, const char* what) const {
    std::vector<std::size_t> numbers;
    std::istringstream words(line_);
    for (std::string word; words >> word;) {
      long long number = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || end != word.data() + word.size())
        fail(fmt::format("\"{}\" in {} is no whole number", word, what));
      numbers.push_back(number < 0 ? 0 : static_cast<std::size_t>(number));
    }
    if (numbers.size() < at_least)
      fail(fmt::format("{} has {} numbers; {} are due", what, numbers.size(), at_least));
    return numbers;
  }

  std::array<double, 3> coordinates(std::istringstream& words) const {
    std::array<double, 3> place{};
    for (double& value : place) {
      std::string word;
      words >> word;
      std::replace_if(
          word.begin(), word.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
      const char* const end = word.data() + word.size();
      const auto [stop, error] = std::from_chars(word.data(), end, value);
      if (error != std::errc() || stop != end || word.empty())
        fail(fmt::format("\"{}\" is no coordinate", word));
    }
    return place;
  }

  void read_nodes(int lines) {
    while (goes_on()) {
      const bool is_one_line = lines == 1;
      std::istringstream words(line_);
      std::string tag, system, displacements, colour;
      words >> tag >> system >> displacements >> colour;
      line_ = fmt::format("{} {} {} {}", tag, system, displacements, colour);
      const std::vector<std::size_t> head = whole_numbers(2, "a node");
      if (head[1] > 1)
        fail(fmt::format("node {} is in coordinate system {}; only the global one is known",
                         head[0], head[1]));
      if (!is_one_line) {
        require_line("a node");
        words = std::istringstream(line_);
      }
      if (!mesh_.nodes.emplace(head[0], coordinates(words)).second)
        fail(fmt::format("node {} is there twice", head[0]));
    }
  }

  void read_elements() {
    while (goes_on()) {
      const std::vector<std::size_t> head = whole_numbers(6, "an element");
      const auto descriptor = static_cast<int>(head[1]);
      if (descriptor == 11 || (descriptor >= 21 && descriptor <= 24)) require_line("an element");
      NodeTags nodes;
      while (nodes.size() < head[5]) {
        require_line("an element");
        const NodeTags more = whole_numbers(1, "an element's nodes");
        nodes.insert(nodes.end(), more.begin(), more.end());
      }
      const UniversalKind* kind = universal_kind(descriptor, nodes.size());
      if (kind == nullptr)
        fail(
            fmt::format("element {} is of kind {} with {} nodes; known are bars, plates and "
                        "solids of order 1 and 2: leave others out of the file",
                        head[0], descriptor, nodes.size()));
      UniversalElement element{head[0], kind, {}, {}, {}};
      for (const std::size_t place : kind->place) {
        if (mesh_.nodes.count(nodes[place]) == 0)
          fail(
              fmt::format("element {} names node {}, which does not exist", head[0], nodes[place]));
        element.nodes.push_back(nodes[place]);
      }
      for (const std::size_t place : kind->place_for_faces)
        element.nodes_for_faces.push_back(nodes[place]);
      if (!place_of_.emplace(head[0], mesh_.elements.size()).second)
        fail(fmt::format("element {} is there twice", head[0]));
      mesh_.elements.push_back(std::move(element));
    }
  }

  /// @param width numbers that tell a member: its kind, its number and what does not count here.
  void read_groups(std::size_t width) {
    constexpr std::size_t of_nodes = 7, of_elements = 8;
    while (goes_on()) {
      const std::vector<std::size_t> head = whole_numbers(7, "a group");
      require_line("a group");
      UniversalGroup group{trimmed(), {}, {}};
      if (group.name.empty()) group.name = fmt::format("group {}", head[0]);
      for (std::size_t read = 0; read < head.back();) {
        require_line("a group");
        const std::vector<std::size_t> numbers = whole_numbers(2, "a group's member");
        for (std::size_t i = 0; i + 1 < numbers.size(); i += width, ++read) {
          if (numbers[i] == of_nodes) group.nodes.push_back(known_node(numbers[i + 1], group));
          if (numbers[i] == of_elements) take_in(numbers[i + 1], group);
        }
      }
      // Gmsh writes a point as its node and as an element, which it does not write itself.
      if (first_missing_ > 0 && (group.nodes.empty() || !group.dimensions.empty()))
        fail(fmt::format("group \"{}\" names element {}, which does not exist", group.name,
                         first_missing_));
      first_missing_ = 0;
      mesh_.groups.push_back(std::move(group));
    }
  }

  std::size_t known_node(std::size_t tag, const UniversalGroup& group) const {
    if (mesh_.nodes.count(tag) == 0)
      fail(fmt::format("group \"{}\" names node {}, which does not exist", group.name, tag));
    return tag;
  }

  void take_in(std::size_t tag, UniversalGroup& group) {
    const auto place = place_of_.find(tag);
    if (place == place_of_.end()) {
      if (first_missing_ == 0) first_missing_ = tag;
      return;
    }
    UniversalElement& element = mesh_.elements[place->second];
    element.groups.insert(mesh_.groups.size());
    group.dimensions.insert(element.kind->dimension);
  }

  std::ifstream file_;
  std::string line_;
  std::size_t line_number_ = 0;
  UniversalMesh mesh_;
  std::map<std::size_t, std::size_t> place_of_;  ///< of elements, by number
  std::size_t first_missing_ = 0;                ///< element of the group that is being read
};

NodeTags sorted_corners(const NodeTags& face) {
  NodeTags corners(face.begin(), face.begin() + (face.size() % 3 == 0 ? 3 : 4));
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Makes groups of nodes that are all nodes of some outer faces of solids groups of these faces:
/// what holds the nodes then holds the middles that elements of a higher order get, too.
void take_faces_for_nodes(UniversalMesh& mesh) {
  AbaqusMesh solids;
  std::map<NodeTags, std::size_t> face_of_corners;
  std::size_t next = 1;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const UniversalElement& element = mesh.elements[e];
    next = std::max(next, element.tag + 1);
    if (element.kind->dimension == 3)
      solids.elements.push_back({element.tag, element.nodes_for_faces});
    if (element.kind->dimension == 2) face_of_corners[sorted_corners(element.nodes)] = e;
  }
  std::map<std::size_t, const AbaqusElement*> solid_of_tag;
  for (const AbaqusElement& solid : solids.elements) solid_of_tag[solid.tag] = &solid;
  for (std::size_t g = 0; g < mesh.groups.size() && !solids.elements.empty(); ++g) {
    UniversalGroup& group = mesh.groups[g];
    if (group.nodes.empty() || !group.dimensions.empty()) continue;
    for (const AbaqusFace& face :
         outer_faces_made_of(solids, {group.nodes.begin(), group.nodes.end()})) {
      const NodeTags nodes = face_nodes(*solid_of_tag.at(face.element), face.face);
      const auto [known, is_new] =
          face_of_corners.try_emplace(sorted_corners(nodes), mesh.elements.size());
      // Code 91 stands for any plate; its kind follows from the nodes, which are Gmsh's here.
      if (is_new)
        mesh.elements.push_back({next++, universal_kind(91, nodes.size()), nodes, {}, {}});
      mesh.elements[known->second].groups.insert(g);
      group.dimensions.insert(2);
    }
  }
}

/// Elements of one dimension by the groups that they are in: each combination is an entity.
void add_dimension(const UniversalMesh& mesh, int dimension, bool& has_nodes) {
  std::map<std::set<std::size_t>, std::vector<const UniversalElement*>> alike;
  for (const UniversalElement& element : mesh.elements)
    if (element.kind->dimension == dimension) alike[element.groups].push_back(&element);
  std::map<std::size_t, std::vector<int>> entities;  // by group
  for (const auto& [groups, elements] : alike) {
    const int entity = gmsh::model::addDiscreteEntity(dimension);
    if (!std::exchange(has_nodes, true)) {
      NodeTags tags;
      std::vector<double> places;
      for (const auto& [tag, place] : mesh.nodes) {
        tags.push_back(tag);
        places.insert(places.end(), place.begin(), place.end());
      }
      gmsh::model::mesh::addNodes(dimension, entity, tags, places);
    }
    std::map<int, std::pair<NodeTags, NodeTags>> by_type;  // elements and their nodes
    for (const UniversalElement* element : elements) {
      auto& [tags, nodes] = by_type[element->kind->type];
      tags.push_back(element->tag);
      nodes.insert(nodes.end(), element->nodes.begin(), element->nodes.end());
    }
    for (const auto& [type, lists] : by_type)
      gmsh::model::mesh::addElementsByType(entity, type, lists.first, lists.second);
    for (const std::size_t group : groups) entities[group].push_back(entity);
  }
  static const std::array<const char*, 4> nouns = {"point", "curve", "surface", "volume"};
  for (const auto& [place, of_group] : entities) {
    const UniversalGroup& group = mesh.groups[place];
    const bool has_name = dimension == *group.dimensions.rbegin();
    const int number = gmsh::model::addPhysicalGroup(dimension, of_group);
    gmsh::model::setPhysicalName(
        dimension, number,
        has_name ? group.name : fmt::format("{} ({})", group.name, nouns[dimension]));
  }
}

}  // namespace

bool is_universal_file(const std::string& path) { return ending_of(path) == ".unv"; }

std::map<std::string, std::vector<std::size_t>> open_universal_file(const std::string& path) {
  UniversalMesh mesh = UniversalReader(path).read();
  if (mesh.elements.empty())
    throw ModelError("it holds no elements (dataset 2412): is it a universal file of a mesh?");
  take_faces_for_nodes(mesh);
  gmsh::model::add("universal file");
  bool has_nodes = false;
  for (const int dimension : {3, 2, 1}) add_dimension(mesh, dimension, has_nodes);
  std::set<std::string> names;
  for (const UniversalGroup& group : mesh.groups)
    if (!group.dimensions.empty()) names.insert(group.name);
  std::map<std::string, std::vector<std::size_t>> points;
  for (const UniversalGroup& group : mesh.groups) {
    if (!group.dimensions.empty() || group.nodes.empty()) continue;
    NodeTags& nodes = points[names.count(group.name) > 0 ? group.name + " nodes" : group.name];
    nodes.insert(nodes.end(), group.nodes.begin(), group.nodes.end());
  }
  return points;
}

}  // namespace blocklift::structure
