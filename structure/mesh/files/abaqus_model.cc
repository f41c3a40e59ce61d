#include "structure/mesh/files/abaqus_model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmsh.h>

#include "structure/letter_case.h"

namespace blocklift::structure {

namespace {

using Tags = std::vector<std::size_t>;

// Gmsh's element type, and where it has each of Abaqus' nodes. Source: Gmsh's manual, node
// ordering.
struct GmshOrder {
  int type = 0;
  std::vector<std::size_t> place;
};

const GmshOrder& gmsh_order_of(std::size_t nodes) {
  static const std::map<std::size_t, GmshOrder> orders = {
      {4, {4, {0, 1, 2, 3}}},
      {6, {6, {0, 1, 2, 3, 4, 5}}},
      {8, {5, {0, 1, 2, 3, 4, 5, 6, 7}}},
      {10, {11, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}}},
      {15, {18, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}}},
      {20, {17, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}}},
  };
  return orders.at(nodes);
}

// Triangles and quadrangles, linear and quadratic: their nodes are in the same order in both.
int face_type(std::size_t nodes) {
  static const std::map<std::size_t, int> types = {{3, 2}, {4, 3}, {6, 9}, {8, 16}};
  return types.at(nodes);
}

/// Names that are free, whatever the capitals.
class Names {
 public:
  std::string take(const std::string& name, const std::string& kind) {
    std::string chosen = name;
    while (!taken_.insert(upper(chosen)).second) chosen += " " + kind;
    return chosen;
  }

 private:
  std::set<std::string> taken_;
};

/// Items (elements or faces) by the sets that they are in: each combination is an entity.
class Entities {
 public:
  Entities(int dimension, std::size_t items) : dimension_(dimension), sets_of_(items) {}

  void add_set(const std::string& name, const Tags& items) {
    names_.push_back(name);
    for (const std::size_t item : items) sets_of_[item].insert(names_.size() - 1);
  }

  /// @param add puts items into an entity.
  template <typename Add>
  void make(const Add& add) const {
    std::map<std::set<std::size_t>, Tags> alike;
    for (std::size_t item = 0; item < sets_of_.size(); ++item)
      alike[sets_of_[item]].push_back(item);
    std::vector<std::vector<int>> entities(names_.size());
    for (const auto& [sets, items] : alike) {
      const int entity = gmsh::model::addDiscreteEntity(dimension_);
      add(entity, items);
      for (const std::size_t set : sets) entities[set].push_back(entity);
    }
    for (std::size_t set = 0; set < names_.size(); ++set) {
      const int group = gmsh::model::addPhysicalGroup(dimension_, entities[set]);
      gmsh::model::setPhysicalName(dimension_, group, names_[set]);
    }
  }

 private:
  int dimension_;
  std::vector<std::string> names_;
  std::vector<std::set<std::size_t>> sets_of_;
};

/// Faces once each, by their corners.
class Faces {
 public:
  explicit Faces(const AbaqusMesh& mesh) : mesh_(mesh) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      place_of_[mesh.elements[e].tag] = e;
      const auto count = static_cast<int>(abaqus_faces(mesh.elements[e].nodes.size()).size());
      for (int face = 1; face <= count; ++face) ++uses_[corners({mesh.elements[e].tag, face})];
    }
  }

  std::size_t add(const AbaqusFace& face) {
    const auto [entry, is_new] = number_of_.try_emplace(corners(face), nodes_.size());
    if (is_new) nodes_.push_back(face_nodes(mesh_.elements[place_of_.at(face.element)], face.face));
    return entry->second;
  }

  /// Outer faces all of whose nodes are in the set; none unless they have all of its nodes.
  std::vector<AbaqusFace> made_of(const std::set<std::size_t>& set) const {
    std::vector<AbaqusFace> faces;
    std::set<std::size_t> met;
    for (const AbaqusElement& element : mesh_.elements) {
      const auto count = static_cast<int>(abaqus_faces(element.nodes.size()).size());
      for (int face = 1; face <= count; ++face) {
        const Tags nodes = face_nodes(element, face);
        if (!std::all_of(nodes.begin(), nodes.end(),
                         [&](std::size_t node) { return set.count(node) > 0; }))
          continue;
        if (uses_.at(corners({element.tag, face})) != 1) continue;
        faces.push_back({element.tag, face});
        met.insert(nodes.begin(), nodes.end());
      }
    }
    return met.size() == set.size() ? faces : std::vector<AbaqusFace>{};
  }

  /// A plate, which may be the face of a solid.
  std::size_t add(const AbaqusElement& plate) {
    Tags key(plate.nodes.begin(), plate.nodes.begin() + (plate.nodes.size() % 3 == 0 ? 3 : 4));
    std::sort(key.begin(), key.end());
    const auto [entry, is_new] = number_of_.try_emplace(key, nodes_.size());
    if (is_new) nodes_.push_back(plate.nodes);
    return entry->second;
  }

  const std::vector<Tags>& nodes() const { return nodes_; }

 private:
  Tags corners(const AbaqusFace& face) const {
    const AbaqusElement& element = mesh_.elements[place_of_.at(face.element)];
    Tags tags;
    for (const int corner : abaqus_faces(element.nodes.size())[face.face - 1])
      tags.push_back(element.nodes[corner]);
    std::sort(tags.begin(), tags.end());
    return tags;
  }

  const AbaqusMesh& mesh_;
  std::map<std::size_t, std::size_t> place_of_;
  std::map<Tags, int> uses_;
  std::map<Tags, std::size_t> number_of_;
  std::vector<Tags> nodes_;
};

void add_nodes(const AbaqusMesh& mesh, int dimension, int entity) {
  Tags tags;
  std::vector<double> places;
  for (const auto& [tag, place] : mesh.nodes) {
    tags.push_back(tag);
    places.insert(places.end(), place.begin(), place.end());
  }
  gmsh::model::mesh::addNodes(dimension, entity, tags, places);
}

/// Sets of plates, by names that are free; plates in none are one more where there are no solids.
void add_plates(const AbaqusMesh& mesh, Names& names, Faces& faces,
                std::vector<std::pair<std::string, Tags>>& sets) {
  std::map<std::size_t, const AbaqusElement*> plate_of;
  for (const AbaqusElement& plate : mesh.plates) {
    plate_of[plate.tag] = &plate;
    if (mesh.elements.empty()) faces.add(plate);
  }
  for (const auto& [name, tags] : mesh.plate_sets) {
    sets.emplace_back(names.take(name, "plates"), Tags());
    for (const std::size_t tag : tags) sets.back().second.push_back(faces.add(*plate_of.at(tag)));
  }
}

void add_volumes(const AbaqusMesh& mesh, Names& names) {
  std::map<std::size_t, std::size_t> place_of;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) place_of[mesh.elements[e].tag] = e;
  Entities volumes(3, mesh.elements.size());
  for (const auto& [name, set] : mesh.element_sets) {
    Tags items;
    for (const std::size_t tag : set) items.push_back(place_of.at(tag));
    volumes.add_set(names.take(name, "elements"), items);
  }
  bool has_nodes = false;
  volumes.make([&](int volume, const Tags& items) {
    if (!std::exchange(has_nodes, true)) add_nodes(mesh, 3, volume);
    std::map<int, std::pair<Tags, Tags>> by_type;  // elements and their nodes
    for (const std::size_t item : items) {
      const AbaqusElement& element = mesh.elements[item];
      const GmshOrder& order = gmsh_order_of(element.nodes.size());
      auto& [tags, nodes] = by_type[order.type];
      tags.push_back(element.tag);
      const std::size_t first = nodes.size();
      nodes.resize(first + element.nodes.size());
      for (std::size_t n = 0; n < element.nodes.size(); ++n)
        nodes[first + order.place[n]] = element.nodes[n];
    }
    for (const auto& [type, lists] : by_type)
      gmsh::model::mesh::addElementsByType(volume, type, lists.first, lists.second);
  });
}

}  // namespace

std::map<std::string, std::vector<std::size_t>> add_to_gmsh(const AbaqusMesh& mesh) {
  Names names;
  add_volumes(mesh, names);
  Faces faces(mesh);
  std::vector<std::pair<std::string, Tags>> sets;  // of faces
  std::map<std::string, Tags> points;
  add_plates(mesh, names, faces, sets);
  for (const auto& [name, nodes] : mesh.node_sets) {
    const std::string chosen = names.take(name, "nodes");
    const auto made = faces.made_of({nodes.begin(), nodes.end()});
    if (made.empty()) {
      points[chosen] = nodes;
      continue;
    }
    sets.emplace_back(chosen, Tags());
    for (const AbaqusFace& face : made) sets.back().second.push_back(faces.add(face));
  }
  for (const auto& [name, surface] : mesh.surfaces) {
    sets.emplace_back(names.take(name, "surface"), Tags());
    for (const AbaqusFace& face : surface) sets.back().second.push_back(faces.add(face));
  }
  if (faces.nodes().empty()) return points;
  Entities surfaces(2, faces.nodes().size());
  for (const auto& [name, items] : sets) surfaces.add_set(name, items);
  std::size_t next = 1;
  for (const AbaqusElement& element : mesh.elements) next = std::max(next, element.tag + 1);
  bool has_nodes = !mesh.elements.empty();
  surfaces.make([&](int surface, const Tags& items) {
    if (!std::exchange(has_nodes, true)) add_nodes(mesh, 2, surface);
    for (const std::size_t item : items) {
      const Tags& nodes = faces.nodes()[item];
      gmsh::model::mesh::addElementsByType(surface, face_type(nodes.size()), {next++}, nodes);
    }
  });
  return points;
}

std::vector<AbaqusFace> outer_faces_made_of(const AbaqusMesh& mesh,
                                            const std::set<std::size_t>& nodes) {
  return Faces(mesh).made_of(nodes);
}

}  // namespace blocklift::structure
