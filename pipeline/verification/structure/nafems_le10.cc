#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmsh.h>

#include "pipeline/verification/models/box_mesh.h"
#include "pipeline/verification/structure/structure_cases.h"
#include "structure/elasticity/load.h"
#include "structure/mesh/files/gmsh_file.h"
#include "structure/response/cell_stress.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

// Quarter of the elliptic plate of LE10, made and meshed with Gmsh, written as .msh.
void write_elliptic_plate(const std::string& path, int radial, int around, int layers) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("le10");
  namespace geo = gmsh::model::geo;
  const int centre = geo::addPoint(0, 0, 0);
  const int inner_x = geo::addPoint(2, 0, 0), inner_y = geo::addPoint(0, 1, 0);
  const int outer_x = geo::addPoint(3.25, 0, 0), outer_y = geo::addPoint(0, 2.75, 0);
  const int inner = geo::addEllipseArc(inner_x, centre, inner_x, inner_y);
  const int outer = geo::addEllipseArc(outer_x, centre, outer_x, outer_y);
  const int along_x = geo::addLine(inner_x, outer_x), along_y = geo::addLine(inner_y, outer_y);
  const int loop = geo::addCurveLoop({along_x, outer, -along_y, -inner});
  const int face = geo::addPlaneSurface({loop});
  for (const int arc : {inner, outer}) geo::mesh::setTransfiniteCurve(arc, around + 1);
  for (const int line : {along_x, along_y})  // finer towards the inner edge
    geo::mesh::setTransfiniteCurve(line, radial + 1, "Progression", 1.25);
  geo::mesh::setTransfiniteSurface(face);
  geo::mesh::setRecombine(2, face);
  gmsh::vectorpair extruded;
  geo::extrude({{2, face}}, 0, 0, 0.6, extruded, {layers}, {}, true);
  geo::synchronize();
  for (const auto& [dimension, tag] : extruded)
    if (dimension == 3) {
      gmsh::model::addPhysicalGroup(3, {tag}, 1);
      gmsh::model::setPhysicalName(3, 1, "plate");
    }
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(2);
  gmsh::write(path);
  gmsh::finalize();
}

/// Nodes on boundary faces whose vertices all lie on the outer ellipse.
std::vector<char> nodes_on_outer_face(const HexMesh& mesh, const Discretisation& space) {
  std::vector<char> outer(static_cast<std::size_t>(space.node_count()), 0);
  const auto on_outer = [](const Vector3& x) {
    return std::abs(std::pow(x.x() / 3.25, 2) + std::pow(x.y() / 2.75, 2) - 1) < 1e-6;
  };
  for (const auto& [cell, face] : boundary_faces(mesh)) {
    bool all = true;
    for (const int v : cell_faces[static_cast<std::size_t>(face)])
      all = all && on_outer(mesh.vertices[static_cast<std::size_t>(
                       mesh.cells[static_cast<std::size_t>(cell)][static_cast<std::size_t>(v)])]);
    if (!all) continue;
    for (int i = 0; i < space.nodes_per_cell; ++i)
      if (std::abs(space.element.nodes()(face / 2, i) - face % 2) < 1e-9)
        outer[static_cast<std::size_t>(space.node(cell, i))] = 1;
  }
  return outer;
}

/// Symmetry on the straight edges' faces; the outer face held in the plane, its middle line vertically.
std::vector<FixedUnknown> supports(const HexMesh& mesh, const Discretisation& space) {
  const std::vector<char> outer = nodes_on_outer_face(mesh, space);
  const auto zero = [](const Vector3&) -> Vector3 { return Vector3::Zero(); };
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space, [](const Vector3& x) { return x.x() < 1e-9; }, zero, {true, false, false}, fixed);
  testing::hold(
      space, [](const Vector3& x) { return x.y() < 1e-9; }, zero, {false, true, false}, fixed);
  std::vector<char> held(static_cast<std::size_t>(space.unknowns()), 0);
  for (const FixedUnknown& known : fixed) held[static_cast<std::size_t>(known.unknown)] = 1;
  for (int n = 0; n < space.node_count(); ++n) {
    if (!outer[static_cast<std::size_t>(n)]) continue;
    for (int a = 0; a < 2; ++a) {
      const int unknown = 3 * n + a;
      if (!held[static_cast<std::size_t>(unknown)]) fixed.push_back({unknown, 0});
    }
    if (std::abs(space.nodes(2, n) - 0.3) < 1e-9) fixed.push_back({3 * n + 2, 0});
  }
  return fixed;
}

/// sigma_yy at D = (2, 0) on top, Pa, from a mesh of so many cells.
double le10_stress(int radial, int around, int layers) {
  // A name of the process's own: several may run side by side.
  const auto path = std::filesystem::temp_directory_path() /
                    ("blocklift-le10-" + std::to_string(getpid()) + ".msh");
  write_elliptic_plate(path.string(), radial, around, layers);
  const HexMesh mesh = read_gmsh(path.string(), {{"plate", {"steel", 210e9, 0.3, 0, 1}}});
  std::filesystem::remove(path);
  const Discretisation space(mesh, 3);

  const Eigen::VectorXd load = traction_load(
      mesh, space, [](const Vector3&, const Vector3& n) { return n.z() > 0.9; },
      [](const Vector3&, const Vector3& n) -> Vector3 { return -1e6 * n; });
  const Eigen::VectorXd u = testing::solve(mesh, space, supports(mesh, space), load);

  const CellStress stress(mesh, space, space.element.nodes());
  double sum = 0;
  int count = 0;
  for (int cell = 0; cell < space.cell_count(); ++cell) {
    const auto values = stress(cell, u);
    for (int i = 0; i < space.nodes_per_cell; ++i)
      if ((space.nodes.col(space.node(cell, i)) - Vector3(2, 0, 0.6)).norm() < 1e-9) {
        sum += values(1, i);
        ++count;
      }
  }
  if (count == 0) throw std::logic_error("no node lies at point D");
  return sum / count;
}

}  // namespace

// Cells are curved (quadratic): straight ones would leave a notch at D. Measured with cubic elements:
// 4 x 8 x 2 -5.464, 8 x 16 x 4 -5.402, 12 x 24 x 6 -5.400 MPa, so that the published figure is 0.4 % off
// the limit; 1 % covers that and the finer mesh, 2 % the coarser one.
VerificationCase nafems_le10() {
  return {.name = "nafems-le10",
          .stage = "structure",
          .source = "NAFEMS (1990), The standard NAFEMS benchmarks, test LE10",
          .compute = [] {
            constexpr double reference = -5.38;
            return std::vector<VerificationRow>{
                compare("sigma_yy at D, 4 x 8 x 2 cubic cells", "MPa", reference,
                        1e-6 * le10_stress(4, 8, 2), 0.02 * 5.38),
                compare("sigma_yy at D, 8 x 16 x 4 cubic cells", "MPa", reference,
                        1e-6 * le10_stress(8, 16, 4), 0.01 * 5.38)};
          }};
}

}  // namespace blocklift::pipeline
