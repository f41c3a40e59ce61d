#include "structure/mesh/part_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/abaqus_model.h"
#include "structure/mesh/gmsh_session.h"
#include "structure/mesh/plate_collector.h"

namespace blocklift::structure {

namespace {

const std::array<const char*, 4> entity_nouns = {"point", "curve", "surface", "volume"};

using Pairs = std::vector<std::array<int, 2>>;

// Corner pairs of the mid-edge nodes in the order that VTK and Abaqus share.
Pairs edges_of(int dimension, int corners) {
  if (dimension == 3 && corners == 8)
    return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
            {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  if (dimension == 3 && corners == 4) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  if (dimension == 3 && corners == 6)
    return {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  return {};
}

void find_orders(ElementKind& kind) {
  for (int corner = 0; corner < kind.corners; ++corner) kind.corner_order.push_back(corner);
  if (kind.order < 2) return;
  for (const auto& [a, b] : edges_of(kind.dimension, kind.corners)) {
    const Vector3 middle = (kind.local.col(a) + kind.local.col(b)) / 2;
    Eigen::Index node = 0;
    (kind.local.colwise() - middle).colwise().squaredNorm().minCoeff(&node);
    kind.edge_order.push_back(static_cast<int>(node));
  }
}

Eigen::MatrixXd basis(int type, const std::vector<double>& points, const char* function, int rows,
                      int nodes) {
  int components = 0, orientations = 0;
  std::vector<double> values;
  gmsh::model::mesh::getBasisFunctions(type, points, function, components, values, orientations);
  // A point after another; for each, a node after another; for each, its components.
  const auto count = static_cast<Eigen::Index>(points.size() / 3);
  Eigen::MatrixXd table(rows * count, nodes);
  for (Eigen::Index q = 0; q < count; ++q)
    for (int n = 0; n < nodes; ++n)
      for (int c = 0; c < rows; ++c)
        table(rows * q + c, n) = values[static_cast<std::size_t>((q * nodes + n) * components + c)];
  return table;
}

struct Rule {
  Eigen::Matrix3Xd points;
  Eigen::VectorXd weights;
};

Rule rule_of(int type, int degree) {
  std::vector<double> points, weights;
  gmsh::model::mesh::getIntegrationPoints(type, fmt::format("Gauss{}", degree), points, weights);
  const auto count = static_cast<Eigen::Index>(weights.size());
  return {Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, count),
          Eigen::Map<const Eigen::VectorXd>(weights.data(), count)};
}

// The product of a rule in the first local coordinates with one on a line in the next.
Rule product(const Rule& base, const Rule& line, int axis) {
  Rule rule{Eigen::Matrix3Xd::Zero(3, base.weights.size() * line.weights.size()),
            Eigen::VectorXd(base.weights.size() * line.weights.size())};
  Eigen::Index q = 0;
  for (Eigen::Index j = 0; j < line.weights.size(); ++j)
    for (Eigen::Index i = 0; i < base.weights.size(); ++i, ++q) {
      rule.points.col(q) = base.points.col(i);
      rule.points(axis, q) = line.points(0, j);
      rule.weights[q] = base.weights[i] * line.weights[j];
    }
  return rule;
}

// Exact for polynomials of twice the element's order: in all coordinates together for simplices, in
// each for products.
void find_rule(int type, ElementKind& kind) {
  constexpr int line_type = 1, triangle_type = 2;
  const int degree = 2 * kind.order;
  const Rule line = rule_of(line_type, degree);
  Rule rule;
  if (kind.corners == kind.dimension + 1)
    rule = rule_of(type, degree);
  else if (kind.dimension == 2)
    rule = product(line, line, 1);
  else if (kind.corners == 6)
    rule = product(rule_of(triangle_type, degree), line, 2);
  else
    rule = product(product(line, line, 1), line, 2);
  kind.rule = rule.points;
  kind.weights = rule.weights;
}

ElementKind tabulate(int type) {
  ElementKind kind;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, kind.name, kind.dimension, kind.order, kind.nodes,
                                          local, kind.corners);
  kind.local.setZero(3, kind.nodes);
  for (int n = 0; n < kind.nodes; ++n)
    for (int a = 0; a < kind.dimension; ++a) kind.local(a, n) = local[at(n * kind.dimension + a)];
  find_orders(kind);
  if (kind.dimension == 0) return kind;
  find_rule(type, kind);
  const std::vector<double> points(kind.rule.data(), kind.rule.data() + kind.rule.size());
  kind.values = basis(type, points, "Lagrange", 1, kind.nodes);
  kind.gradients = basis(type, points, "GradLagrange", 3, kind.nodes);
  const std::vector<double> nodes(kind.local.data(), kind.local.data() + kind.local.size());
  kind.gradients_at_nodes = basis(type, nodes, "GradLagrange", 3, kind.nodes);
  return kind;
}

bool is_known_solid(int type) {
  // Tetrahedra, hexahedra and wedges, linear and quadratic, full and serendipity.
  static const std::array<int, 8> known = {4, 11, 5, 17, 12, 6, 18, 13};
  return std::find(known.begin(), known.end(), type) != known.end();
}

/// Collects the elements of Gmsh's current model.
class Collector {
 public:
  explicit Collector(double length_unit) : length_unit_(length_unit) {}

  /// @param point_sets nodes that become groups of points.
  PartMesh collect(const std::map<std::string, std::vector<std::size_t>>& point_sets) {
    read_nodes();
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    for (const auto& [dimension, entity] : entities) read_entity(dimension, entity);
    for (const auto& [name, tags] : point_sets) add_points(name, tags);
    read_physical_groups();
    if (mesh_.solids.empty()) throw ModelError("it holds no solid elements");
    return std::move(mesh_);
  }

 private:
  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> places, parameters;
    gmsh::model::mesh::getNodes(tags, places, parameters);
    all_places_ = std::move(places);
    for (std::size_t n = 0; n < tags.size(); ++n) place_of_tag_[tags[n]] = n;
  }

  int node_of(std::size_t tag) {
    const auto found = place_of_tag_.find(tag);
    if (found == place_of_tag_.end())
      throw ModelError(fmt::format("an element names node {}, which does not exist", tag));
    const auto [entry, is_new] =
        node_of_tag_.try_emplace(tag, static_cast<int>(places_.size() / 3));
    if (is_new)
      for (std::size_t a = 0; a < 3; ++a)
        places_.push_back(length_unit_ * all_places_[3 * found->second + a]);
    return entry->second;
  }

  void read_entity(int dimension, int entity) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    PartGroup group{fmt::format("{} {}", entity_nouns[at(dimension)], entity), dimension, {}};
    for (std::size_t t = 0; t < types.size(); ++t) {
      const int kind = kind_of(types[t]);
      const std::size_t count = static_cast<std::size_t>(mesh_.kinds[at(kind)].nodes);
      if (dimension == 3 && !is_known_solid(types[t]))
        throw ModelError("it holds elements of kind " + mesh_.kinds[at(kind)].name +
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

  void add_points(const std::string& name, const std::vector<std::size_t>& tags) {
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

  int kind_of(int type) {
    const auto [entry, is_new] =
        kind_of_type_.try_emplace(type, static_cast<int>(mesh_.kinds.size()));
    if (is_new) mesh_.kinds.push_back(tabulate(type));
    return entry->second;
  }

  void read_physical_groups() {
    mesh_.nodes = Eigen::Map<const Eigen::Matrix3Xd>(places_.data(), 3,
                                                     static_cast<Eigen::Index>(places_.size() / 3));
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    std::vector<PartGroup> named;
    for (const auto& [dimension, number] : groups) {
      PartGroup group{{}, dimension, {}};
      gmsh::model::getPhysicalName(dimension, number, group.name);
      if (group.name.empty())
        group.name = fmt::format("{} group {}", entity_nouns[at(dimension)], number);
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

  double length_unit_;
  PartMesh mesh_;
  std::vector<double> all_places_, places_;
  std::unordered_map<std::size_t, std::size_t> place_of_tag_;
  std::unordered_map<std::size_t, int> node_of_tag_;
  std::map<int, int> kind_of_type_;
  std::map<std::pair<int, int>, std::vector<int>> elements_of_entity_;
};

int largest_order() {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  int largest = 0;
  for (const int type : types) {
    std::string name;
    int dimension = 0, order = 0, nodes = 0, corners = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, local, corners);
    largest = std::max(largest, order);
  }
  return largest;
}

// Quadratic tetrahedra, the lightest elements, have some 4 unknowns each, coupled with half of 80 others.
void require_memory(double elements, double memory, const std::string& cause) {
  const double bytes = 2e3 * elements;
  if (memory <= 0 || bytes <= memory) return;
  throw ModelError(
      fmt::format("{} makes about {:.2g} elements, whose stiffness needs more than {:.3g} GB; "
                  "{:.3g} GB are free",
                  cause, elements, bytes / 1e9, memory / 1e9));
}

// Tetrahedra of an edge h fill h^3 / (6 sqrt 2) each. Volumes are known of OpenCASCADE's solids.
void require_memory_for_size(const PartReading& reading) {
  gmsh::vectorpair solids;
  gmsh::model::occ::getEntities(solids, 3);
  double volume = 0;
  for (const auto& [dimension, solid] : solids) {
    double own = 0;
    gmsh::model::occ::getMass(dimension, solid, own);
    volume += own;
  }
  const double size = reading.element_size / reading.length_unit;
  require_memory(6 * std::sqrt(2.0) * volume / std::pow(size, 3), reading.memory,
                 fmt::format("an element size of {:.3g} m", reading.element_size));
}

std::size_t solid_count() {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 3);
  std::size_t count = 0;
  for (const auto& of_type : tags) count += of_type.size();
  return count;
}

bool is_abaqus(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".inp";
}

/// @returns sets of nodes that are groups of points.
std::map<std::string, std::vector<std::size_t>> open_and_mesh(const std::string& path,
                                                              const PartReading& reading) {
  std::map<std::string, std::vector<std::size_t>> points;
  gmsh::option::setNumber("Mesh.SaveAll", 1);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
  // Geometries come with the unit of the file, never converted.
  gmsh::option::setString("Geometry.OCCTargetUnit", "");
  if (is_abaqus(path))
    points = add_to_gmsh(read_abaqus(path));
  else
    gmsh::open(path);
  if (reading.element_size > 0)
    gmsh::option::setNumber("Mesh.MeshSizeMax", reading.element_size / reading.length_unit);
  if (!reading.plates.empty()) {
    std::map<std::string, double> thickness;
    for (const auto& [name, value] : reading.plates) thickness[name] = value / reading.length_unit;
    const AbaqusMesh solid = thicken(collect_plates(thickness));
    gmsh::model::add("thickened");
    points = add_to_gmsh(solid);
  }
  int order = largest_order();
  if (order == 0) {
    if (reading.element_size > 0) require_memory_for_size(reading);
    gmsh::model::mesh::generate(3);
    order = largest_order();
  }
  if (reading.refinements > 0)
    require_memory(static_cast<double>(solid_count()) * std::pow(8, reading.refinements),
                   reading.memory, fmt::format("halving the mesh {} times", reading.refinements));
  for (int i = 0; i < reading.refinements; ++i) gmsh::model::mesh::refine();
  if (reading.refinements > 0) order = largest_order();
  if (order > 0 && order < reading.element_order)
    gmsh::model::mesh::setOrder(reading.element_order);
  return points;
}

}  // namespace

PartMesh read_part_mesh(const std::string& path, const PartReading& reading) {
  if (!std::filesystem::is_regular_file(path))
    throw ModelError("there is no file \"" + path + "\"");
  const GmshSession session;
  try {
    const auto points = open_and_mesh(path, reading);
    return Collector(reading.length_unit).collect(points);
  } catch (const ModelError& error) {
    throw ModelError("mesh \"" + path + "\": " + error.what());
  } catch (const std::string& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error);
  } catch (const std::exception& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error.what());
  }
}

PartMesh make_part_mesh(const AbaqusMesh& mesh) {
  const GmshSession session;
  try {
    const auto points = add_to_gmsh(mesh);
    return Collector(1).collect(points);
  } catch (const std::string& error) {
    throw ModelError("Gmsh cannot take the mesh: " + error);
  }
}

}  // namespace blocklift::structure
