#include "structure/mesh/files/plate_collector.h"

#include <algorithm>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

constexpr int quadrangle_type = 3;

class Collector {
 public:
  explicit Collector(const std::map<std::string, double>& thickness) : thickness_(thickness) {}

  PlateMesh collect() {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 2);
    if (types.empty()) gmsh::model::mesh::generate(2);
    read_nodes();
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    for (const auto& [dimension, number] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, number, name);
      if (name.empty()) name = fmt::format("group {}", number);
      if (dimension == 2)
        read_plate(name, number);
      else if (dimension < 2)
        read_set(name, dimension, number);
    }
    for (const auto& [name, unused] : thickness_)
      if (met_.count(name) == 0)
        throw ModelError(fmt::format("there is no group of surfaces \"{}\"; the mesh has {}", name,
                                     fmt::join(names_, ", ")));
    require_all();
    return std::move(mesh_);
  }

 private:
  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> places, parameters;
    gmsh::model::mesh::getNodes(tags, places, parameters);
    for (std::size_t n = 0; n < tags.size(); ++n) {
      node_of_[tags[n]] = static_cast<int>(n);
      mesh_.nodes.emplace_back(places[3 * n], places[3 * n + 1], places[3 * n + 2]);
    }
  }

  void read_plate(const std::string& name, int number) {
    names_.push_back("\"" + name + "\"");
    const auto found = thickness_.find(name);
    if (found == thickness_.end()) return;
    met_.insert(name);
    const int plate = static_cast<int>(mesh_.plates.size());
    mesh_.plates.push_back({name, found->second});
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(2, number, entities);
    for (const int entity : entities) {
      if (!surfaces_.insert(entity).second)
        throw ModelError(fmt::format("surface {} is in two groups that have a thickness", entity));
      read_surface(entity, plate, name);
    }
    if (std::none_of(mesh_.quadrangles.begin(), mesh_.quadrangles.end(),
                     [&](const PlateMesh::Quadrangle& one) { return one.plate == plate; }))
      throw ModelError(fmt::format("group \"{}\" names no element", name));
  }

  void read_surface(int entity, int plate, const std::string& name) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, 2, entity);
    for (std::size_t t = 0; t < types.size(); ++t) {
      if (types[t] != quadrangle_type) {
        std::string kind;
        int dimension = 0, order = 0, count = 0, corners = 0;
        std::vector<double> local;
        gmsh::model::mesh::getElementProperties(types[t], kind, dimension, order, count, local,
                                                corners);
        throw ModelError(
            fmt::format("group \"{}\" holds elements of kind {} ({} of them); plates are meshed "
                        "with linear quadrangles alone (in Gmsh: Recombine Surface, and "
                        "transfinite surfaces)",
                        name, kind, tags[t].size()));
      }
      for (std::size_t first = 0; first < nodes[t].size(); first += 4) {
        PlateMesh::Quadrangle one;
        one.plate = plate;
        for (std::size_t i = 0; i < 4; ++i) one.nodes[i] = node_of_.at(nodes[t][first + i]);
        mesh_.quadrangles.push_back(one);
      }
    }
  }

  void read_set(const std::string& name, int dimension, int number) {
    std::vector<std::size_t> tags;
    std::vector<double> places;
    gmsh::model::mesh::getNodesForPhysicalGroup(dimension, number, tags, places);
    for (const std::size_t tag : tags) mesh_.node_sets[name].push_back(node_of_.at(tag));
  }

  // Every surface needs a thickness: one that was forgotten would leave a hole.
  void require_all() const {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 2);
    for (const auto& [dimension, entity] : entities) {
      if (surfaces_.count(entity) > 0) continue;
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, 2, entity);
      if (types.empty()) continue;
      throw ModelError(fmt::format(
          "surface {} is in no group that has a thickness; the groups of surfaces are {}", entity,
          names_.empty() ? std::string("none") : fmt::format("{}", fmt::join(names_, ", "))));
    }
  }

  const std::map<std::string, double>& thickness_;
  PlateMesh mesh_;
  std::unordered_map<std::size_t, int> node_of_;
  std::set<std::string> met_;
  std::vector<std::string> names_;
  std::set<int> surfaces_;
};

}  // namespace

PlateMesh collect_plates(const std::map<std::string, double>& thickness) {
  return Collector(thickness).collect();
}

}  // namespace blocklift::structure
