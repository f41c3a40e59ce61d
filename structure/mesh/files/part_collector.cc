#include "structure/mesh/files/part_collector.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"
#include "structure/mesh/element_tables.h"

namespace blocklift::structure {

namespace {

const std::array<const char*, 4> entity_nouns = {"point", "curve", "surface", "volume"};

bool is_known_solid(int type) {
  // Tetrahedra, hexahedra and wedges, linear and quadratic, full and serendipity.
  static const std::array<int, 8> known = {4, 11, 5, 17, 12, 6, 18, 13};
  return std::find(known.begin(), known.end(), type) != known.end();
}

using Tags = std::vector<std::size_t>;

}  // namespace

PartMesh PartCollector::collect(const std::map<std::string, Tags>& point_sets,
                                const std::vector<FaceChoice>& faces,
                                const std::vector<PointChoice>& points) {
  read_nodes();
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dimension, entity] : entities) read_entity(dimension, entity);
  for (const auto& [name, tags] : point_sets) add_points(name, tags);
  read_physical_groups();
  if (mesh_.solids.empty()) {
    const bool has_plates =
        std::any_of(mesh_.groups.begin(), mesh_.groups.end(),
                    [](const PartGroup& group) { return group.dimension == 2; });
    throw ModelError(has_plates ? "it holds no solid elements; of mid-surfaces say how thick they "
                                  "are: mesh: {plates: {GROUP: {thickness: 12 mm}}}"
                                : "it holds no solid elements");
  }
  for (const FaceChoice& choice : faces) add_faces(choice);
  for (const PointChoice& choice : points) add_nearest(choice);
  return std::move(mesh_);
}

void PartCollector::read_nodes() {
  std::vector<std::size_t> tags;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(tags, places, parameters);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::isfinite(places[i]))
      throw ModelError(
          fmt::format("node {} has a coordinate that is no finite number", tags[i / 3]));
  all_places_ = std::move(places);
  for (std::size_t n = 0; n < tags.size(); ++n) place_of_tag_[tags[n]] = n;
}

int PartCollector::node_of(std::size_t tag) {
  const auto found = place_of_tag_.find(tag);
  if (found == place_of_tag_.end())
    throw ModelError(fmt::format("an element names node {}, which does not exist", tag));
  const auto [entry, is_new] = node_of_tag_.try_emplace(tag, static_cast<int>(places_.size() / 3));
  if (is_new)
    for (std::size_t a = 0; a < 3; ++a)
      places_.push_back(length_unit_ * all_places_[3 * found->second + a]);
  return entry->second;
}

void PartCollector::read_entity(int dimension, int entity) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  PartGroup group{fmt::format("{} {}", entity_nouns[dimension], entity), dimension, {}};
  for (std::size_t t = 0; t < types.size(); ++t) {
    const int kind = kind_of(types[t]);
    const std::size_t count = static_cast<std::size_t>(mesh_.kinds[kind].nodes);
    if (dimension == 3 && !is_known_solid(types[t]))
      throw ModelError("it holds elements of kind " + mesh_.kinds[kind].name +
                       "; hexahedra, tetrahedra and wedges of order 1 and 2 are known");
    for (std::size_t e = 0; e < tags[t].size(); ++e) {
      const int element = static_cast<int>(mesh_.elements.size());
      group.elements.push_back(element);
      if (dimension == 3) mesh_.solids.push_back(element);
      mesh_.elements.push_back({kind, static_cast<int>(mesh_.element_nodes.size()), tags[t][e]});
      for (std::size_t n = 0; n < count; ++n)
        mesh_.element_nodes.push_back(node_of(nodes[t][e * count + n]));
    }
  }
  if (group.elements.empty()) return;
  elements_of_entity_[{dimension, entity}] = group.elements;
  mesh_.groups.push_back(std::move(group));
}

void PartCollector::add_points(const std::string& name, const std::vector<std::size_t>& tags) {
  constexpr int point_type = 15;
  PartGroup group{name, 0, {}};
  for (const std::size_t tag : tags) {
    group.elements.push_back(static_cast<int>(mesh_.elements.size()));
    mesh_.elements.push_back(
        {kind_of(point_type), static_cast<int>(mesh_.element_nodes.size()), tag});
    mesh_.element_nodes.push_back(node_of(tag));
  }
  mesh_.groups.push_back(std::move(group));
}

int PartCollector::kind_of(int type) {
  const auto [entry, is_new] =
      kind_of_type_.try_emplace(type, static_cast<int>(mesh_.kinds.size()));
  if (is_new) mesh_.kinds.push_back(tabulate_element(type));
  return entry->second;
}

void PartCollector::read_physical_groups() {
  mesh_.nodes = Eigen::Map<const Eigen::Matrix3Xd>(places_.data(), 3,
                                                   static_cast<Eigen::Index>(places_.size() / 3));
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  std::vector<PartGroup> named;
  for (const auto& [dimension, number] : groups) {
    PartGroup group{{}, dimension, {}};
    gmsh::model::getPhysicalName(dimension, number, group.name);
    if (group.name.empty())
      group.name = fmt::format("{} group {}", entity_nouns[dimension], number);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, number, entities);
    for (const int entity : entities) {
      const auto found = elements_of_entity_.find({dimension, entity});
      if (found == elements_of_entity_.end()) continue;
      group.elements.insert(group.elements.end(), found->second.begin(), found->second.end());
    }
    named.push_back(std::move(group));
  }
  mesh_.groups.insert(mesh_.groups.begin(), named.begin(), named.end());
}

void PartCollector::require_new(const std::string& name) const {
  if (mesh_.find_group(name))
    throw ModelError(
        fmt::format("it has a group \"{}\" already; call the chosen one otherwise", name));
}

void PartCollector::add_faces(const FaceChoice& choice) {
  require_new(choice.name);
  const double slack =
      1e-6 * (mesh_.nodes.rowwise().maxCoeff() - mesh_.nodes.rowwise().minCoeff()).norm();
  const auto is_within = [&](int node) {
    const Vector3 place = mesh_.nodes.col(node);
    return (place - choice.from).minCoeff() > -slack && (choice.to - place).minCoeff() > -slack;
  };
  struct Face {
    int type = 0, times = 0;
    std::vector<int> nodes;
  };
  std::map<std::vector<int>, Face> found;  // by corners
  std::map<int, std::vector<ElementFace>> faces_of_kind;
  for (const int solid : mesh_.solids) {
    auto& faces = faces_of_kind[mesh_.elements[solid].kind];
    if (faces.empty()) faces = element_faces(mesh_.kind(solid));
    for (const ElementFace& face : faces) {
      std::vector<int> nodes;
      for (const int local : face.nodes) nodes.push_back(mesh_.node(solid, local));
      if (!std::all_of(nodes.begin(), nodes.end(), is_within)) continue;
      std::vector<int> corners(nodes.begin(), nodes.begin() + face.corners);
      std::sort(corners.begin(), corners.end());
      Face& entry = found[corners];
      entry = {face.gmsh_type, entry.times + 1, std::move(nodes)};
    }
  }
  PartGroup group{choice.name, 2, {}};
  for (const auto& [corners, face] : found) {
    if (face.times != 1) continue;  // inside
    group.elements.push_back(static_cast<int>(mesh_.elements.size()));
    mesh_.elements.push_back({kind_of(face.type), static_cast<int>(mesh_.element_nodes.size()),
                              mesh_.elements.size() + 1});
    mesh_.element_nodes.insert(mesh_.element_nodes.end(), face.nodes.begin(), face.nodes.end());
  }
  mesh_.groups.push_back(std::move(group));
}

void PartCollector::add_nearest(const PointChoice& choice) {
  require_new(choice.name);
  constexpr double reach = 0.01;  // of the part's size
  const double size = (mesh_.nodes.rowwise().maxCoeff() - mesh_.nodes.rowwise().minCoeff()).norm();
  PartGroup group{choice.name, 0, {}};
  Eigen::Index nearest = 0;
  const double distance = (mesh_.nodes.colwise() - choice.at).colwise().norm().minCoeff(&nearest);
  if (distance <= reach * size) {
    constexpr int point_type = 15;
    group.elements.push_back(static_cast<int>(mesh_.elements.size()));
    mesh_.elements.push_back({kind_of(point_type), static_cast<int>(mesh_.element_nodes.size()),
                              mesh_.elements.size() + 1});
    mesh_.element_nodes.push_back(static_cast<int>(nearest));
  }
  mesh_.groups.push_back(std::move(group));
}

}  // namespace blocklift::structure
