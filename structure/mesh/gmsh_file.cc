#include "structure/mesh/gmsh_file.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <gmsh.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr int linear_hexahedron = 5;  // Gmsh's element type
constexpr std::array<std::size_t, 8> gmsh_order = {0, 1, 3, 2, 4, 5, 7, 6};

// Gmsh keeps one global session; this opens it for a scope, quietly.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("blocklift");
  }
  ~GmshSession() {
    try {
      gmsh::finalize();
    } catch (...) {  // a destructor must not throw; the session is lost anyhow
    }
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

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

HexMesh take_from_session(const std::string& path,
                          const std::map<std::string, Material>& materials) {
  HexMesh mesh;
  std::unordered_map<std::size_t, int> vertex_of_tag;
  std::map<int, int> group_of_number;
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  for (const auto& [dimension, volume] : volumes) {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, dimension, volume);
    for (const int type : types)
      if (type != linear_hexahedron)
        throw ModelError("\"" + path +
                         "\" holds volume elements other than hexahedra with eight nodes");
    std::vector<std::size_t> elements, corners;
    gmsh::model::mesh::getElementsByType(linear_hexahedron, elements, corners, volume);
    if (elements.empty()) continue;
    std::vector<int> numbers;
    gmsh::model::getPhysicalGroupsForEntity(dimension, volume, numbers);
    if (numbers.empty())
      throw ModelError("\"" + path + "\": volume " + std::to_string(volume) +
                       " is in no physical group");
    const auto [known, is_new] =
        group_of_number.try_emplace(numbers.front(), static_cast<int>(mesh.groups.size()));
    if (is_new) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, numbers.front(), name);
      if (name.empty()) name = std::to_string(numbers.front());
      auto material = materials.find(name);
      if (material == materials.end()) material = materials.find("");
      if (material == materials.end())
        throw ModelError("\"" + path + "\": group \"" + name + "\" has no material");
      mesh.groups.push_back({name, static_cast<int>(mesh.materials.size())});
      mesh.materials.push_back(material->second);
    }
    for (std::size_t e = 0; e < elements.size(); ++e) {
      std::array<int, 8> cell{};
      for (std::size_t v = 0; v < 8; ++v) {
        const std::size_t tag = corners[8 * e + v];
        const auto [entry, first] =
            vertex_of_tag.try_emplace(tag, static_cast<int>(mesh.vertices.size()));
        if (first) {
          std::vector<double> coordinates, parameters;
          gmsh::model::mesh::getNode(tag, coordinates, parameters);
          mesh.vertices.emplace_back(coordinates[0], coordinates[1], coordinates[2]);
        }
        cell[gmsh_order[v]] = entry->second;
      }
      mesh.cells.push_back(cell);
      mesh.cell_group.push_back(known->second);
    }
  }
  if (mesh.cells.empty()) throw ModelError("\"" + path + "\" holds no hexahedra");
  return mesh;
}

}  // namespace

HexMesh read_gmsh(const std::string& path, const std::map<std::string, Material>& materials) {
  const GmshSession session;
  try {
    gmsh::merge(path);
    return take_from_session(path, materials);
  } catch (const ModelError&) {
    throw;
  } catch (const std::string& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error);
  } catch (const std::exception& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error.what());
  }
}

}  // namespace blocklift::structure
