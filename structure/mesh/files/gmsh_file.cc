#include "structure/mesh/files/gmsh_file.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <gmsh.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/files/gmsh_session.h"

namespace blocklift::structure {

namespace {

constexpr int linear_hexahedron = 5;  // Gmsh's element types
constexpr int quadratic_hexahedron = 12;
constexpr std::array<std::size_t, 8> gmsh_order = {0, 1, 3, 2, 4, 5, 7, 6};

void fill_session(const BlockMesh& mesh) {
  // One volume for the plates' cells of a group, one for its crossings.
  std::map<std::pair<int, bool>, std::vector<int>> cells_of;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    cells_of[{mesh.cell_group[cell], mesh.cell_normal[cell] < 0}].push_back(static_cast<int>(cell));
  std::map<int, std::vector<int>> volumes_of_group;
  std::vector<int> crossings;
  std::vector<char> placed(mesh.vertices.size(), 0);
  for (const auto& [kind, cells] : cells_of) {
    const int volume = gmsh::model::addDiscreteEntity(3);
    std::vector<std::size_t> tags, elements, corners;
    std::vector<double> coordinates;
    for (const int cell : cells) {
      elements.push_back(at(cell) + 1);
      for (const std::size_t v : gmsh_order) {
        const int vertex = mesh.cells[at(cell)][v];
        corners.push_back(at(vertex) + 1);
        if (placed[at(vertex)]) continue;
        placed[at(vertex)] = 1;
        tags.push_back(at(vertex) + 1);
        for (int a = 0; a < 3; ++a) coordinates.push_back(mesh.vertices[at(vertex)][a]);
      }
    }
    gmsh::model::mesh::addNodes(3, volume, tags, coordinates);
    gmsh::model::mesh::addElementsByType(volume, linear_hexahedron, elements, corners);
    volumes_of_group[kind.first].push_back(volume);
    if (kind.second) crossings.push_back(volume);
  }
  for (const auto& [group, volumes] : volumes_of_group) {
    gmsh::model::addPhysicalGroup(3, volumes, group + 1);
    gmsh::model::setPhysicalName(3, group + 1, mesh.groups[at(group)].name);
  }
  if (crossings.empty()) return;
  const int number = static_cast<int>(mesh.groups.size()) + 1;
  gmsh::model::addPhysicalGroup(3, crossings, number);
  gmsh::model::setPhysicalName(3, number, "crossings");
}

}  // namespace

void write_gmsh(const BlockMesh& mesh, const std::string& path) {
  const GmshSession session;
  try {
    fill_session(mesh);
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    gmsh::option::setNumber("Mesh.Binary", 1);
    gmsh::write(path);
  } catch (const std::string& error) {
    throw ModelError("Gmsh cannot write \"" + path + "\": " + error);
  } catch (const std::exception& error) {
    throw ModelError("Gmsh cannot write \"" + path + "\": " + error.what());
  }
}

namespace {

// Collects hexahedra volume after volume.
class GmshReader {
 public:
  GmshReader(const std::string& path, const std::map<std::string, Material>& materials)
      : path_(path), materials_(materials) {}

  HexMesh read() {
    std::vector<std::size_t> tags;
    std::vector<double> places, parameters;
    gmsh::model::mesh::getNodes(tags, places, parameters);
    for (std::size_t n = 0; n < tags.size(); ++n)
      place_of_tag_[tags[n]] = Vector3(places[3 * n], places[3 * n + 1], places[3 * n + 2]);
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    for (const auto& entity : volumes) read_volume(entity.second);
    if (mesh_.cells.empty()) throw ModelError("\"" + path_ + "\" holds no hexahedra");
    if (!mesh_.curved_cells.empty() && mesh_.curved_cells.size() != mesh_.cells.size())
      throw ModelError("\"" + path_ + "\" mixes hexahedra with 8 and with 27 nodes");
    return mesh_;
  }

 private:
  // Place in a lexicographic 2 x 2 x 2 or 3 x 3 x 3 grid of each node of an element type.
  static std::vector<std::size_t> lexicographic(int type) {
    std::string name;
    int dimension = 0, order = 0, nodes = 0, corner_nodes = 0;
    std::vector<double> places;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, places,
                                            corner_nodes);
    std::vector<std::size_t> grid(at(nodes));
    for (std::size_t n = 0; n < grid.size(); ++n) {
      std::size_t index = 0;
      for (std::size_t a = 3; a-- > 0;)
        index = index * (at(order) + 1) +
                static_cast<std::size_t>(std::lround((places[3 * n + a] + 1) / 2 * order));
      grid[n] = index;
    }
    return grid;
  }

  int group_of(int volume) {
    std::vector<int> numbers;
    gmsh::model::getPhysicalGroupsForEntity(3, volume, numbers);
    if (numbers.empty())
      throw ModelError("\"" + path_ + "\": volume " + std::to_string(volume) +
                       " is in no physical group");
    const auto [known, is_new] =
        group_of_number_.try_emplace(numbers.front(), static_cast<int>(mesh_.groups.size()));
    if (!is_new) return known->second;
    std::string name;
    gmsh::model::getPhysicalName(3, numbers.front(), name);
    if (name.empty()) name = std::to_string(numbers.front());
    auto material = materials_.find(name);
    if (material == materials_.end()) material = materials_.find("");
    if (material == materials_.end())
      throw ModelError("\"" + path_ + "\": group \"" + name + "\" has no material");
    mesh_.groups.push_back({name, static_cast<int>(mesh_.materials.size())});
    mesh_.materials.push_back(material->second);
    return known->second;
  }

  int vertex_of(std::size_t tag) {
    const auto [entry, is_new] =
        vertex_of_tag_.try_emplace(tag, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(place_of_tag_.at(tag));
    return entry->second;
  }

  void read_volume(int volume) {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 3, volume);
    for (const int type : types) {
      if (type != linear_hexahedron && type != quadratic_hexahedron)
        throw ModelError("\"" + path_ +
                         "\" holds volume elements other than hexahedra with 8 or 27 nodes");
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(type, elements, nodes, volume);
      if (!elements.empty()) add_cells(type, nodes, group_of(volume));
    }
  }

  void add_cells(int type, const std::vector<std::size_t>& nodes, int group) {
    const std::vector<std::size_t> grid = lexicographic(type);
    const bool curved = type == quadratic_hexahedron;
    for (std::size_t first = 0; first < nodes.size(); first += grid.size()) {
      std::array<int, 8> cell{};
      std::array<Vector3, 27> points;
      for (std::size_t n = 0; n < grid.size(); ++n) {
        const std::size_t g = grid[n];
        if (!curved) {
          cell[g] = vertex_of(nodes[first + n]);
          continue;
        }
        points[g] = place_of_tag_.at(nodes[first + n]);
        const std::size_t i = g % 3, j = g / 3 % 3, k = g / 9;
        if (i != 1 && j != 1 && k != 1)
          cell[i / 2 + 2 * (j / 2) + 4 * (k / 2)] = vertex_of(nodes[first + n]);
      }
      mesh_.cells.push_back(cell);
      mesh_.cell_group.push_back(group);
      if (curved) mesh_.curved_cells.push_back(points);
    }
  }

  const std::string& path_;
  const std::map<std::string, Material>& materials_;
  HexMesh mesh_;
  std::unordered_map<std::size_t, Vector3> place_of_tag_;
  std::unordered_map<std::size_t, int> vertex_of_tag_;
  std::map<int, int> group_of_number_;
};

}  // namespace

HexMesh read_gmsh(const std::string& path, const std::map<std::string, Material>& materials) {
  const GmshSession session;
  try {
    gmsh::merge(path);
    return GmshReader(path, materials).read();
  } catch (const ModelError&) {
    throw;
  } catch (const std::string& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error);
  } catch (const std::exception& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error.what());
  }
}

}  // namespace blocklift::structure
