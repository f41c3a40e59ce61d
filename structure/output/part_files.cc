#include "structure/output/part_files.h"

#include <cctype>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "structure/error.h"
#include "structure/output/vtk_grid.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

std::vector<int> shared_order(const ElementKind& kind) {
  std::vector<int> order = kind.corner_order;
  order.insert(order.end(), kind.edge_order.begin(), kind.edge_order.end());
  return order;
}

VtkCell vtk_type(const ElementKind& kind) {
  const bool quadratic = kind.order > 1;
  if (kind.corners == 4) return quadratic ? VtkCell::quadratic_tetrahedron : VtkCell::tetrahedron;
  if (kind.corners == 6) return quadratic ? VtkCell::quadratic_wedge : VtkCell::wedge;
  return quadratic ? VtkCell::quadratic_hexahedron : VtkCell::hexahedron;
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

// The solids of a part with their data, on points of which each is at a node.
// @param point_of the point of a node of a solid.
template <typename PointOf>
VtkGrid grid_of(const PartModel& model, const std::vector<int>& node_of_point,
                const PointOf& point_of) {
  const PartMesh& mesh = model.mesh;
  VtkGrid grid;
  VtkGrid::Texts materials{"material_names", {}};
  std::vector<std::int64_t> tags;
  for (const Material& one : model.materials) materials.values.push_back(one.name);
  for (const int node : node_of_point) grid.add_point(mesh.nodes.col(node));
  for (std::size_t solid = 0; solid < mesh.solids.size(); ++solid) {
    const int element = mesh.solids[solid];
    for (const int i : shared_order(mesh.kind(element)))
      grid.connectivity.push_back(point_of(solid, i));
    grid.end_cell(vtk_type(mesh.kind(element)));
    tags.push_back(static_cast<std::int64_t>(mesh.elements[element].tag));
  }
  grid.texts = {std::move(materials)};
  grid.cell_data = {{"material", std::vector<std::int32_t>(model.material_of_solid.begin(),
                                                           model.material_of_solid.end())},
                    {"element", std::move(tags)}};
  return grid;
}

// Values of a displacement (3 a node) at points.
VtkField field_of(std::string name, const std::vector<int>& node_of_point,
                  const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::vector<float> at_points;
  for (const int node : node_of_point)
    for (int a = 0; a < 3; ++a) at_points.push_back(static_cast<float>(values[3 * node + a]));
  return {std::move(name), std::move(at_points), 3};
}

// *EQUATION: u_freedom - sum shares u_followed = 0. Four terms a line.
void write_ties(std::ofstream& file, const PartModel& model) {
  for (const PartTie& tie : model.joints.ties) {
    fmt::print(file, "*EQUATION\n{}\n{}, {}, -1", tie.followed.size() + 1, tie.freedom / 3 + 1,
               tie.freedom % 3 + 1);
    for (std::size_t i = 0; i < tie.followed.size(); ++i)
      fmt::print(file, "{}{}, {}, {:.12g}", (i + 1) % 4 == 0 ? "\n" : ", ", tie.followed[i] / 3 + 1,
                 tie.followed[i] % 3 + 1, tie.shares[i]);
    fmt::print(file, "\n");
  }
}

void write_static_step(std::ofstream& file, const PartModel& model) {
  std::vector<int> support_of;
  fmt::print(file, "*STEP\n*STATIC\n*BOUNDARY\n");
  for (const FixedUnknown& fixed : part_supports(model, support_of))
    fmt::print(file, "{}, {}, {}, {:.12g}\n", fixed.unknown / 3 + 1, fixed.unknown % 3 + 1,
               fixed.unknown % 3 + 1, fixed.value);
  fmt::print(file, "*CLOAD\n");
  const Eigen::VectorXd load = part_load(model);
  // CalculiX reads 20 characters of a field: with more digits a small load loses the end of its
  // exponent.
  for (Eigen::Index u = 0; u < load.size(); ++u)
    if (load[u] != 0) fmt::print(file, "{}, {}, {:.13g}\n", u / 3 + 1, u % 3 + 1, load[u]);
  fmt::print(file, "*NODE FILE\nU\n*EL FILE\nS\n*NODE PRINT, NSET=ALL_NODES\nU\n*END STEP\n");
}

// About the shape at rest: what supports move in the static step they hold here.
void write_frequency_step(std::ofstream& file, const PartModel& model, int modes) {
  std::vector<int> support_of;
  fmt::print(file, "*STEP\n*FREQUENCY\n{}\n", modes);
  const std::vector<FixedUnknown> supports = part_supports(model, support_of);
  if (!supports.empty()) fmt::print(file, "*BOUNDARY, OP=NEW\n");
  for (const FixedUnknown& fixed : supports)
    fmt::print(file, "{}, {}, {}\n", fixed.unknown / 3 + 1, fixed.unknown % 3 + 1,
               fixed.unknown % 3 + 1);
  fmt::print(file, "*NODE FILE\nU\n*END STEP\n");
}

}  // namespace

void write_part_vtu(const std::string& path, const PartModel& model, const PartSolution& solution) {
  const PartStress& stress = solution.stress;
  // Points for each node and material, as the stress has them.
  VtkGrid grid = grid_of(model, stress.node, [&](std::size_t solid, int i) {
    return stress.point_of[stress.first_of[solid] + i];
  });
  std::vector<float> components, equivalent;
  for (const auto& s : stress.averaged.colwise()) {
    for (int c = 0; c < 6; ++c) components.push_back(static_cast<float>(s[c]));
    equivalent.push_back(static_cast<float>(von_mises(s)));
  }
  grid.scalars = "von_mises";
  grid.vectors = "displacement";
  grid.point_data = {field_of("displacement", stress.node, solution.displacement),
                     {"von_mises", std::move(equivalent)},
                     {"stress", std::move(components), 6}};
  write_vtk_grid(path, grid);
}

void write_part_modes_vtu(const std::string& path, const PartModel& model,
                          const NaturalModes& modes) {
  const PartMesh& mesh = model.mesh;
  // A point for each node that an element's drawing needs.
  std::vector<int> node_of_point, point_of(static_cast<std::size_t>(mesh.nodes.cols()), -1);
  for (const int element : mesh.solids)
    for (const int i : shared_order(mesh.kind(element))) {
      int& point = point_of[mesh.node(element, i)];
      if (point >= 0) continue;
      point = static_cast<int>(node_of_point.size());
      node_of_point.push_back(mesh.node(element, i));
    }
  VtkGrid grid = grid_of(model, node_of_point, [&](std::size_t solid, int i) {
    return point_of[mesh.node(mesh.solids[solid], i)];
  });
  grid.vectors = "mode_1";
  for (Eigen::Index m = 0; m < modes.shapes.cols(); ++m)
    grid.point_data.push_back(
        field_of(fmt::format("mode_{}", m + 1), node_of_point, modes.shapes.col(m)));
  write_vtk_grid(path, grid);
}

void write_calculix(const std::string& path, const PartModel& model, const PartAnalyses& analyses) {
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
  write_ties(file, model);
  if (analyses.has_loads) write_static_step(file, model);
  if (analyses.modes > 0) write_frequency_step(file, model, analyses.modes);
  file.close();
  if (!file) throw ModelError("cannot write \"" + path + "\"");
}

}  // namespace blocklift::structure
