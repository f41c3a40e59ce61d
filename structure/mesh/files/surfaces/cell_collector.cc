#include "structure/mesh/files/surfaces/cell_collector.h"

#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"
#include "structure/mesh/files/deck/shell_geometry.h"
#include "structure/mesh/files/deck/surface_points.h"

namespace blocklift::structure {

namespace {

/// Kinds of Gmsh's elements that are plates and bars, by its numbers of them.
struct CellKind {
  std::size_t nodes = 0, corners = 0;
};

CellKind kind_of_cell(int type) {
  switch (type) {
    case 1:
      return {2, 2};
    case 8:
      return {3, 2};
    case 2:
      return {3, 3};
    case 9:
      return {6, 3};
    case 3:
      return {4, 4};
    case 16:
      return {8, 4};
    case 10:
      return {9, 4};
    default:
      break;
  }
  std::string name;
  int dimension = 0, order = 0, nodes = 0, corners = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, local, corners);
  throw ModelError(
      fmt::format("elements \"{}\" of order {} are not taken: plates are triangles and "
                  "quadrangles, bars lines, "
                  "of first or second order",
                  name, order));
}

class Collector {
 public:
  Collector(double length, Deck& deck) : length_(length), deck_(deck), mesh_(deck.mesh) {
    std::vector<std::size_t> tags;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(tags, places_, parameters);
    for (std::size_t i = 0; i < tags.size(); ++i) place_of_tag_[tags[i]] = i;
  }

  /// Tells the middles of a surface's edges, before its curves are added.
  void note_middles(int surface) {
    for_each_element(2, surface, [&](std::size_t, const std::size_t* nodes, CellKind kind) {
      if (kind.nodes > kind.corners)
        edge_middles_.insert(nodes + kind.corners, nodes + 2 * kind.corners);
    });
  }

  void add_curve(int curve, int region) {
    for_each_element(1, curve, [&](std::size_t tag, const std::size_t* nodes, CellKind kind) {
      const int first = vertex(nodes[0]), last = vertex(nodes[1]);
      // Along the edge of a shell a beam bends with all of it (BeamLines), and not at three nodes
      // alone.
      const bool is_whole = kind.nodes == 2 || edge_middles_.contains(nodes[2]);
      const int middle = is_whole ? last : vertex(nodes[2]);
      add_beam(tag, first, middle, region, curve);
      if (middle != last) add_beam(tag, middle, last, region, curve);
    });
  }

  void add_surface(int surface, int region) {
    for_each_element(2, surface, [&](std::size_t tag, const std::size_t* nodes, CellKind kind) {
      Shell shell;
      shell.section = -1;
      shell.region = region;
      shell.label = static_cast<long>(tag);
      std::vector<int> corners;
      for (std::size_t i = 0; i < kind.corners; ++i) corners.push_back(vertex(nodes[i]));
      shell.vertices = lexicographic(corners);
      if (kind.nodes > kind.corners) bend(shell, corners, nodes + kind.corners, kind);
      cells_of_[{2, surface}].push_back(static_cast<int>(mesh_.shells.size()));
      mesh_.shells.push_back(shell);
    });
  }

  void add_sets() {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    for (const auto& [dimension, group] : groups) {
      NamedSet set;
      gmsh::model::getPhysicalName(dimension, group, set.name);
      if (set.name.empty() || dimension > 2) continue;
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
      for (const int entity : entities) {
        const std::vector<int>& cells = cells_of_[{dimension, entity}];
        auto& into = dimension == 2 ? set.shells : set.beams;
        into.insert(into.end(), cells.begin(), cells.end());
        if (cells.empty()) add_vertices(dimension, entity, set.vertices);
      }
      if (!set.shells.empty() || !set.beams.empty() || !set.vertices.empty())
        deck_.sets.push_back(std::move(set));
    }
  }

  /// The middles of curved edges that have become vertices for something else.
  void fasten_middles() {
    std::vector<SurfacePoint> used;
    for (const auto& [tag, point] : middles_) {
      const auto known = vertex_of_tag_.find(tag);
      if (known == vertex_of_tag_.end()) continue;
      used.push_back(point);
      used.back().vertex = known->second;
    }
    fasten_used_middles(deck_, used);
  }

 private:
  template <class Use>
  void for_each_element(int dimension, int entity, const Use& use) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const CellKind kind = kind_of_cell(types[t]);
      for (std::size_t e = 0; e < tags[t].size(); ++e)
        use(tags[t][e], nodes[t].data() + e * kind.nodes, kind);
    }
  }

  Vector3 place(std::size_t tag) const {
    const auto known = place_of_tag_.find(tag);
    if (known == place_of_tag_.end())
      throw ModelError(fmt::format("an element names node {}, which does not exist", tag));
    const double* of_node = places_.data() + 3 * known->second;
    return length_ * Vector3(of_node[0], of_node[1], of_node[2]);
  }

  int vertex(std::size_t tag) {
    const auto [known, is_new] =
        vertex_of_tag_.try_emplace(tag, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      mesh_.vertices.push_back(place(tag));
      mesh_.vertex_labels.push_back(static_cast<long>(tag));
    }
    return known->second;
  }

  void add_beam(std::size_t tag, int first, int last, int region, int curve) {
    Beam beam;
    beam.vertices = {first, last};
    beam.section = -1;
    beam.region = region;
    beam.label = static_cast<long>(tag);
    cells_of_[{1, curve}].push_back(static_cast<int>(mesh_.beams.size()));
    mesh_.beams.push_back(beam);
  }

  /// Gives a second-order shell its middles unless all of them lie where a plain one has them.
  void bend(Shell& shell, const std::vector<int>& corners, const std::size_t* others,
            CellKind kind) {
    std::vector<Vector3> at_corners, at_middles;
    for (const int corner : corners) at_corners.push_back(mesh_.vertices[corner]);
    bool is_curved = false;
    for (std::size_t i = 0; i < kind.corners; ++i) {
      const Vector3& from = at_corners[i];
      const Vector3& to = at_corners[(i + 1) % kind.corners];
      at_middles.push_back(place(others[i]));
      is_curved =
          is_curved || (at_middles[i] - (from + to) / 2).norm() > straight * (to - from).norm();
      middles_.emplace_back(others[i], SurfacePoint{-1, static_cast<int>(mesh_.shells.size()),
                                                    place_of_middle(kind.corners, i)});
    }
    Eigen::Matrix3Xd points = quadratic_points(at_corners, at_middles);
    if (kind.nodes == 9) {
      const Vector3 centre = place(others[4]);
      is_curved = is_curved || (centre - points.col(4)).norm() >
                                   straight * (at_corners[2] - at_corners[0]).norm();
      points.col(4) = centre;
    }
    if (!is_curved) return;
    shell.curvature = static_cast<int>(mesh_.curved_shells.size());
    mesh_.curved_shells.push_back(std::move(points));
  }

  /// The nodes of an entity without cells that plates or bars have, too.
  void add_vertices(int dimension, int entity, std::vector<int>& vertices) const {
    std::vector<std::size_t> tags;
    std::vector<double> places, parameters;
    gmsh::model::mesh::getNodes(tags, places, parameters, dimension, entity, true, false);
    for (const std::size_t tag : tags)
      if (const auto known = vertex_of_tag_.find(tag); known != vertex_of_tag_.end())
        vertices.push_back(known->second);
  }

  static constexpr double straight = 1e-6;  // of an edge

  double length_;
  Deck& deck_;
  Mesh& mesh_;
  std::vector<double> places_;
  std::unordered_map<std::size_t, std::size_t> place_of_tag_;
  std::unordered_map<std::size_t, int> vertex_of_tag_;
  std::map<std::pair<int, int>, std::vector<int>> cells_of_;
  std::vector<std::pair<std::size_t, SurfacePoint>> middles_;
  std::unordered_set<std::size_t> edge_middles_;
};

}  // namespace

void collect_cells(const EntityRegions& entities, double length, Deck& deck) {
  Collector collector(length, deck);
  for (const auto& [surface, region] : entities.surfaces) collector.note_middles(surface);
  for (const auto& [curve, region] : entities.curves) collector.add_curve(curve, region);
  for (const auto& [surface, region] : entities.surfaces) collector.add_surface(surface, region);
  collector.fasten_middles();
  collector.add_sets();
}

}  // namespace blocklift::structure
