#include "structure/mesh/files/part_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/child_process.h"
#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/mesh/files/abaqus_model.h"
#include "structure/mesh/files/cad_unit.h"
#include "structure/mesh/files/geometry_script.h"
#include "structure/mesh/files/gmsh_session.h"
#include "structure/mesh/files/msh_check.h"
#include "structure/mesh/files/nastran_file.h"
#include "structure/mesh/files/part_collector.h"
#include "structure/mesh/files/plate_collector.h"
#include "structure/mesh/files/universal_file.h"
#include "structure/mesh/part_mesh_packet.h"

namespace blocklift::structure {

namespace {

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

// Quadratic tetrahedra, the lightest elements, have some 4 unknowns each, coupled with half of 80
// others.
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

// Abaqus' and Nastran's solids and universal files by readers of our own, all else by Gmsh.
void open_file(const std::string& path, std::map<std::string, std::vector<std::size_t>>& points) {
  const std::string extension = ending_of(path);
  if (extension == ".inp") {
    points = add_to_gmsh(read_abaqus(path));
    return;
  }
  if (extension == ".bdf" || extension == ".nas" || extension == ".dat") {
    const AbaqusMesh solids = read_nastran(path);
    if (!solids.elements.empty()) {
      points = add_to_gmsh(solids);
      return;
    }
  }
  if (is_universal_file(path)) {
    points = open_universal_file(path);
    return;
  }
  require_known_nodes(path);
  require_closed_script(path);
  gmsh::open(path);
}

// Gmsh's own sizes hold besides where they are smaller.
void take_sizes(const PartReading& reading) {
  const SizeField& field = *reading.sizes;
  const double share = std::pow(2.0, reading.refinements);  // elements are halved later
  std::vector<double> data;
  for (Eigen::Index t = 0; t + 3 < field.sizes.size(); t += 4) {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 4; ++i) data.push_back(field.places(axis, t + i) / reading.length_unit);
    for (int i = 0; i < 4; ++i) data.push_back(share * field.sizes[t + i] / reading.length_unit);
  }
  const int view = gmsh::view::add("sizes");
  gmsh::view::addListData(view, "SS", static_cast<int>(field.sizes.size() / 4), data);
  const int background = gmsh::model::mesh::field::add("PostView");
  gmsh::model::mesh::field::setNumber(background, "ViewTag", view);
  gmsh::model::mesh::field::setAsBackgroundMesh(background);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
}

/// What opening and meshing leaves besides Gmsh's model.
struct Opened {
  std::map<std::string, std::vector<std::size_t>> points;  ///< sets of nodes, groups of points
  bool is_geometry = false;
};

// Sound files take a hundredth of this.
constexpr double seconds_to_open_a_megabyte = 10, seconds_to_mesh = 7200;

/// Keeps sets of nodes while raising the order or halving gives the nodes other numbers: their
/// places stay to the digit.
class KeptPoints {
 public:
  explicit KeptPoints(std::map<std::string, std::vector<std::size_t>>& sets) : sets_(sets) {
    for (const auto& [name, nodes] : sets_)
      for (const std::size_t node : nodes) {
        std::vector<double> place, parameters;
        gmsh::model::mesh::getNode(node, place, parameters);
        places_[name].push_back({place[0], place[1], place[2]});
      }
  }
  /// Gives the sets the numbers that their nodes have now.
  /// @throws ModelError if two nodes lie at one place, of which either may be meant.
  void put_back() {
    std::vector<std::size_t> tags;
    std::vector<double> places, parameters;
    gmsh::model::mesh::getNodes(tags, places, parameters);
    std::map<Place, std::vector<std::size_t>> nodes_at;
    for (std::size_t n = 0; n < tags.size(); ++n)
      nodes_at[{places[3 * n], places[3 * n + 1], places[3 * n + 2]}].push_back(tags[n]);
    for (auto& [name, nodes] : sets_)
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Place& place = places_[name][i];
        const auto found = nodes_at.find(place);
        if (found == nodes_at.end() || found->second.size() > 1)
          throw ModelError(fmt::format(
              "set \"{}\" names node {}, and {} at its place ({:.6g}, {:.6g}, {:.6g}) once the "
              "mesh "
              "is raised or halved; give it elements of the order in the file, or join the nodes",
              name, nodes[i], found == nodes_at.end() ? "there is none" : "there are several",
              place[0], place[1], place[2]));
        nodes[i] = found->second.front();
      }
  }

 private:
  using Place = std::array<double, 3>;
  std::map<std::string, std::vector<std::size_t>>& sets_;
  std::map<std::string, std::vector<Place>> places_;
};

Opened open_and_mesh(const std::string& path, const PartReading& reading) {
  Opened opened;
  gmsh::option::setNumber("Mesh.SaveAll", 1);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
  gmsh::option::setString("Geometry.OCCTargetUnit", "MM");
  const auto megabytes = 1e-6 * static_cast<double>(std::filesystem::file_size(path));
  allow_processor_time(reading.seconds_to_open + seconds_to_open_a_megabyte * megabytes);
  open_file(path, opened.points);
  allow_processor_time(seconds_to_mesh);
  if (reading.element_size > 0)
    gmsh::option::setNumber("Mesh.MeshSizeMax", reading.element_size / reading.length_unit);
  if (!reading.plates.empty()) {
    std::map<std::string, double> thickness;
    for (const auto& [name, value] : reading.plates) thickness[name] = value / reading.length_unit;
    const AbaqusMesh solid = thicken(collect_plates(thickness));
    gmsh::model::add("thickened");
    opened.points = add_to_gmsh(solid);
  }
  int order = largest_order();
  if (order == 0) {
    opened.is_geometry = reading.plates.empty();
    if (reading.element_size > 0) require_memory_for_size(reading);
    if (reading.sizes) take_sizes(reading);
    gmsh::model::mesh::generate(3);
    order = largest_order();
  }
  if (reading.refinements > 0)
    require_memory(static_cast<double>(solid_count()) * std::pow(8, reading.refinements),
                   reading.memory, fmt::format("halving the mesh {} times", reading.refinements));
  const bool is_raised = order > 0 && order < reading.element_order;
  if (reading.refinements == 0 && !is_raised) return opened;
  KeptPoints kept(opened.points);
  for (int i = 0; i < reading.refinements; ++i) gmsh::model::mesh::refine();
  if (reading.refinements > 0) order = largest_order();
  if (order > 0 && order < reading.element_order)
    gmsh::model::mesh::setOrder(reading.element_order);
  kept.put_back();
  return opened;
}

// OpenCASCADE turns what a file declares into millimetres; what it does not declare stays.
double unit_of_coordinates(const std::string& path, double said) {
  const double declared = is_cad_file(path) ? declared_length(path) : 0;
  if (!(declared > 0)) return said > 0 ? said : 1;
  if (said > 0 && std::abs(declared - said) > 1e-6 * said)
    throw ModelError(
        fmt::format("the file says that its lengths are in units of {:.4g} m, and length_unit that "
                    "they are in units of {:.4g} m",
                    declared, said));
  return 1e-3;
}

// In this process.
PartMesh read_here(const std::string& path, PartReading reading) {
  const GmshSession session;
  try {
    reading.length_unit = unit_of_coordinates(path, reading.length_unit);
    const Opened opened = open_and_mesh(path, reading);
    PartMesh mesh =
        PartCollector(reading.length_unit).collect(opened.points, reading.faces, reading.points);
    mesh.meshed_here = opened.is_geometry;
    return mesh;
  } catch (const ModelError& error) {
    throw ModelError("mesh \"" + path + "\": " + error.what());
  } catch (const std::string& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw ModelError("Gmsh cannot read \"" + path + "\": " + error.what());
  }
}

}  // namespace

PartMesh read_part_mesh(const std::string& path, const PartReading& reading) {
  if (!std::filesystem::is_regular_file(path))
    throw ModelError("there is no file \"" + path + "\"");
  // Damaged files make Gmsh and OpenCASCADE crash, search without end or ask for any memory.
  constexpr double most_memory = 16e9;  // bytes, where nobody has looked at what is free
  const ChildLimits limits{seconds_to_mesh, reading.memory > 0 ? reading.memory : most_memory};
  try {
    Packet packet = in_child_process(
        [&] {
          Packet result;
          put_part_mesh(read_here(path, reading), result);
          return result;
        },
        limits);
    return take_part_mesh(packet);
  } catch (const ChildDied& death) {
    throw ModelError(fmt::format(
        "mesh \"{}\": Gmsh {}; is the file damaged? Another program may repair it, or write "
        "another format",
        path, death.what()));
  }
}

PartMesh make_part_mesh(const AbaqusMesh& mesh) {
  const GmshSession session;
  try {
    const auto points = add_to_gmsh(mesh);
    return PartCollector(1).collect(points, {}, {});
  } catch (const std::string& error) {
    throw ModelError("Gmsh cannot take the mesh: " + error);
  }
}

}  // namespace blocklift::structure
