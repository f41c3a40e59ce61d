#include "structure/output/part_files.h"

#include <cctype>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "structure/error.h"
#include "structure/output/vtk_array.h"
#include "structure/output/vtk_grid.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

std::vector<int> shared_order(const ElementKind& kind) {
  std::vector<int> order = kind.corner_order;
  order.insert(order.end(), kind.edge_order.begin(), kind.edge_order.end());
  return order;
}

std::uint8_t vtk_type(const ElementKind& kind) {
  const bool quadratic = kind.order > 1;
  if (kind.corners == 4) return quadratic ? 24 : 10;  // tetrahedron
  if (kind.corners == 6) return quadratic ? 26 : 13;  // wedge
  return quadratic ? 25 : 12;                         // hexahedron
}

const char* calculix_type(const ElementKind& kind) {
  switch (kind.nodes) {
    case 4:
      return "C3D4";
    case 10:
      return "C3D10";
    case 6:
      return "C3D6";
    case 15:
      return "C3D15";
    case 8:
      return "C3D8";
    case 20:
      return "C3D20";
    default:
      throw ModelError("CalculiX has no elements of kind " + kind.name);
  }
}

std::string name_of(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return text;
}

/// The solids of a part on points of which each is at a node.
struct Grid {
  std::vector<int> node;  ///< of each point
  std::vector<std::int32_t> connectivity, offsets;
};

// Points for each node and material, as the stress has them.
Grid grid_of_stress(const PartModel& model, const PartStress& stress) {
  Grid grid{stress.node, {}, {}};
  for (std::size_t solid = 0; solid < model.mesh.solids.size(); ++solid) {
    for (const int i : shared_order(model.mesh.kind(model.mesh.solids[solid])))
      grid.connectivity.push_back(stress.point_of[stress.first_of[solid] + i]);
    grid.offsets.push_back(static_cast<std::int32_t>(grid.connectivity.size()));
  }
  return grid;
}

// A point for each node that an element's drawing needs.
Grid grid_of_nodes(const PartMesh& mesh) {
  Grid grid;
  std::vector<int> point_of(static_cast<std::size_t>(mesh.nodes.cols()), -1);
  for (const int element : mesh.solids) {
    for (const int i : shared_order(mesh.kind(element))) {
      int& point = point_of[mesh.node(element, i)];
      if (point < 0) {
        point = static_cast<int>(grid.node.size());
        grid.node.push_back(mesh.node(element, i));
      }
      grid.connectivity.push_back(point);
    }
    grid.offsets.push_back(static_cast<std::int32_t>(grid.connectivity.size()));
  }
  return grid;
}

// Values of a displacement (3 a node) at the points.
std::vector<float> at_points(const Grid& grid, const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::vector<float> result;
  for (const int node : grid.node)
    for (int a = 0; a < 3; ++a) result.push_back(static_cast<float>(values[3 * node + a]));
  return result;
}

// Everything up to the point data.
void write_grid(std::ofstream& file, const PartModel& model, const Grid& grid) {
  std::vector<std::uint8_t> types;
  std::vector<std::string> materials;
  for (const int element : model.mesh.solids) types.push_back(vtk_type(model.mesh.kind(element)));
  for (const Material& one : model.materials) materials.push_back(one.name);
  const Eigen::Map<const Eigen::VectorXd> places(model.mesh.nodes.data(), model.mesh.nodes.size());
  file << vtk_head("UnstructuredGrid");
  file << "<UnstructuredGrid>\n<FieldData>\n";
  write_names(file, "material_names", materials);
  file << "</FieldData>\n<Piece NumberOfPoints=\"" << grid.node.size() << "\" NumberOfCells=\""
       << types.size() << "\">\n<Points>\n";
  write_array(file, "Float32", "points", 3, at_points(grid, places));
  file << "</Points>\n<Cells>\n";
  write_array(file, "Int32", "connectivity", 1, grid.connectivity);
  write_array(file, "Int32", "offsets", 1, grid.offsets);
  write_array(file, "UInt8", "types", 1, types);
  file << "</Cells>\n";
}

// The data of the solids and the end of the file.
void write_cells(std::ofstream& file, const PartModel& model, const std::string& path) {
  std::vector<std::int64_t> tags;
  for (const int element : model.mesh.solids)
    tags.push_back(static_cast<std::int64_t>(model.mesh.elements[element].tag));
  file << "<CellData>\n";
  write_array(
      file, "Int32", "material", 1,
      std::vector<std::int32_t>(model.material_of_solid.begin(), model.material_of_solid.end()));
  write_array(file, "Int64", "element", 1, tags);
  file << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  file.flush();
  if (!file) throw ModelError("cannot write \"" + path + "\"");
}

}  // namespace

void write_part_vtu(const std::string& path, const PartModel& model, const PartSolution& solution) {
  const PartStress& stress = solution.stress;
  const Grid grid = grid_of_stress(model, stress);
  std::vector<float> components, equivalent;
  for (const auto& s : stress.averaged.colwise()) {
    for (int c = 0; c < 6; ++c) components.push_back(static_cast<float>(s[c]));
    equivalent.push_back(static_cast<float>(von_mises(s)));
  }
  std::ofstream file(path, std::ios::binary);
  write_grid(file, model, grid);
  file << "<PointData Scalars=\"von_mises\" Vectors=\"displacement\">\n";
  write_array(file, "Float32", "displacement", 3, at_points(grid, solution.displacement));
  write_array(file, "Float32", "von_mises", 1, equivalent);
  write_array(file, "Float32", "stress", 6, components);
  file << "</PointData>\n";
  write_cells(file, model, path);
}

void write_part_modes_vtu(const std::string& path, const PartModel& model,
                          const NaturalModes& modes) {
  const Grid grid = grid_of_nodes(model.mesh);
  std::ofstream file(path, std::ios::binary);
  write_grid(file, model, grid);
  file << "<PointData Vectors=\"mode_1\">\n";
  for (Eigen::Index m = 0; m < modes.shapes.cols(); ++m)
    write_array(file, "Float32", fmt::format("mode_{}", m + 1), 3,
                at_points(grid, modes.shapes.col(m)));
  file << "</PointData>\n";
  write_cells(file, model, path);
}

void write_calculix(const std::string& path, const PartModel& model) {
  std::ofstream file(path);
  fmt::print(file, "** Written by Blocklift. Units: m, kg, s, N, Pa.\n*NODE, NSET=ALL_NODES\n");
  for (Eigen::Index n = 0; n < model.mesh.nodes.cols(); ++n)
    fmt::print(file, "{}, {:.12g}, {:.12g}, {:.12g}\n", n + 1, model.mesh.nodes(0, n),
               model.mesh.nodes(1, n), model.mesh.nodes(2, n));
  std::map<std::pair<int, int>, std::vector<int>> sets;  // (material, kind): solids
  for (std::size_t s = 0; s < model.mesh.solids.size(); ++s)
    sets[{model.material_of_solid[s], model.mesh.elements[model.mesh.solids[s]].kind}].push_back(
        static_cast<int>(s));
  for (const auto& [set, solids] : sets) {
    const ElementKind& kind = model.mesh.kinds[set.second];
    fmt::print(file, "*ELEMENT, TYPE={}, ELSET={}\n", calculix_type(kind),
               name_of(model.materials[set.first].name));
    for (const int solid : solids) {
      fmt::print(file, "{}", solid + 1);
      int in_line = 1;
      for (const int i : shared_order(kind)) {
        // Sixteen numbers a line at most.
        fmt::print(file, ",{}{}", in_line++ == 15 ? "\n" : " ",
                   model.mesh.node(model.mesh.solids[solid], i) + 1);
      }
      fmt::print(file, "\n");
    }
  }
  std::set<int> used;  // CalculiX refuses a section of no elements
  for (const auto& [set, solids] : sets) used.insert(set.first);
  for (const int number : used) {
    const Material& material = model.materials[number];
    fmt::print(file,
               "*MATERIAL, NAME={0}\n*ELASTIC\n{1:.12g}, {2:.12g}\n*DENSITY\n{3:.12g}\n"
               "*SOLID SECTION, ELSET={0}, MATERIAL={0}\n",
               name_of(material.name), material.youngs_modulus, material.poisson_ratio,
               material.density);
  }
  std::vector<int> support_of;
  fmt::print(file, "*STEP\n*STATIC\n*BOUNDARY\n");
  for (const FixedUnknown& fixed : part_supports(model, support_of))
    fmt::print(file, "{}, {}, {}, {:.12g}\n", fixed.unknown / 3 + 1, fixed.unknown % 3 + 1,
               fixed.unknown % 3 + 1, fixed.value);
  fmt::print(file, "*CLOAD\n");
  const Eigen::VectorXd load = part_load(model);
  for (Eigen::Index u = 0; u < load.size(); ++u)
    if (load[u] != 0) fmt::print(file, "{}, {}, {:.15g}\n", u / 3 + 1, u % 3 + 1, load[u]);
  fmt::print(file, "*NODE FILE\nU\n*EL FILE\nS\n*NODE PRINT, NSET=ALL_NODES\nU\n*END STEP\n");
  file.close();
  if (!file) throw ModelError("cannot write \"" + path + "\"");
}

}  // namespace blocklift::structure
