// The structural stage against references: manufactured solution, Kirchhoff's plate, NAFEMS LE10.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gmsh.h>
#include <gtest/gtest.h>

#include "pipeline/verification/models/box_mesh.h"
#include "structure/elasticity/discretisation.h"
#include "structure/elasticity/load.h"
#include "structure/mesh/gmsh_file.h"
#include "structure/response/cell_stress.h"
#include "structure/response/stress.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

// Sum of two plane waves, u = d sin(k . x): div sigma = -((lambda + mu) k (k . d) + mu |k|^2 d) sin.
struct PlaneWaves {
  Material material{"made up", 1.0, 0.3, 0, 1};
  std::array<Vector3, 2> direction{Vector3(1, -0.5, 0.3), Vector3(0.2, 0.7, -1)};
  std::array<Vector3, 2> number{Vector3(1.9, 1.1, -0.7), Vector3(-0.6, 2.1, 1.3)};

  Vector3 displacement(const Vector3& x) const {
    Vector3 u = Vector3::Zero();
    for (std::size_t w = 0; w < 2; ++w) u += direction[w] * std::sin(number[w].dot(x));
    return u;
  }
  Eigen::Matrix3d gradient(const Vector3& x) const {
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
    for (std::size_t w = 0; w < 2; ++w)
      g += direction[w] * number[w].transpose() * std::cos(number[w].dot(x));
    return g;
  }
  Vector3 body_force(const Vector3& x) const {
    const double lambda = material.lame_lambda(), mu = material.shear_modulus();
    Vector3 force = Vector3::Zero();
    for (std::size_t w = 0; w < 2; ++w)
      force += ((lambda + mu) * number[w] * number[w].dot(direction[w]) +
                mu * number[w].squaredNorm() * direction[w]) *
               std::sin(number[w].dot(x));
    return force;
  }
};

struct Errors {
  double l2 = 0;
  double h1 = 0;
};

Errors solve_plane_waves(int cells, int degree) {
  const PlaneWaves waves;
  // Smoothly distorted cube: its cells are general hexahedra.
  const BlockMesh mesh = testing::box_mesh(
      {cells, cells, cells}, Vector3::Ones(), waves.material, [](const Vector3& x) -> Vector3 {
        const double bulge =
            std::sin(M_PI * x.x()) * std::sin(M_PI * x.y()) * std::sin(M_PI * x.z());
        return x + 0.12 * bulge * Vector3(1, -0.7, 0.5);
      });
  const Discretisation space(mesh, degree);
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space,
      [](const Vector3& x) { return (x.array() < 1e-9).any() || (x.array() > 1 - 1e-9).any(); },
      [&](const Vector3& x) { return waves.displacement(x); }, {true, true, true}, fixed);
  const Eigen::VectorXd u =
      testing::solve(mesh, space, fixed,
                     body_load(mesh, space, [&](const Vector3& x) { return waves.body_force(x); }));

  const auto line = gauss_points(degree + 3);
  const auto rule = tensor_rule(line, line, line);
  const Eigen::MatrixXd values = space.element.values(rule.topRows<3>());
  const Eigen::MatrixXd gradients = space.element.gradients(rule.topRows<3>());
  Errors errors;
  for (int cell = 0; cell < space.cell_count(); ++cell) {
    Eigen::MatrixX3d local(space.nodes_per_cell, 3);
    for (int i = 0; i < space.nodes_per_cell; ++i)
      local.row(i) = u.segment<3>(3 * space.node(cell, i)).transpose();
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      const Vector3 xi = rule.col(q).head<3>(), x = position(mesh, cell, xi);
      const Eigen::Matrix3d edges = jacobian(mesh, cell, xi);
      const double weight = rule(3, q) * edges.determinant();
      const Vector3 value = (values.row(q) * local).transpose();
      const Eigen::Matrix3d slope =
          (gradients.middleRows<3>(3 * q) * local).transpose() * edges.inverse();
      errors.l2 += weight * (value - waves.displacement(x)).squaredNorm();
      errors.h1 += weight * (slope - waves.gradient(x)).squaredNorm();
    }
  }
  return {std::sqrt(errors.l2), std::sqrt(errors.h1)};
}

// A priori estimates (Ciarlet 1978, theorem 3.2.2 with Nitsche's duality): |u - u_h| falls with
// h^(p+1) in L2 and h^p in H1. From n to 2 n cells the observed order lies within 0.25 of that.
TEST(ManufacturedSolution, OrdersOfConvergence) {
  std::printf("degree  cells        L2   order        H1   order\n");
  for (const int degree : {1, 2, 3}) {
    const int coarse = degree == 1 ? 8 : (degree == 2 ? 4 : 3);
    const Errors a = solve_plane_waves(coarse, degree);
    const Errors b = solve_plane_waves(2 * coarse, degree);
    const double l2 = std::log2(a.l2 / b.l2), h1 = std::log2(a.h1 / b.h1);
    std::printf("%6d %6d %9.2e %7s %9.2e\n%6d %6d %9.2e %7.2f %9.2e %7.2f\n", degree, coarse, a.l2,
                "", a.h1, degree, 2 * coarse, b.l2, l2, b.h1, h1);
    EXPECT_NEAR(l2, degree + 1, 0.25) << "degree " << degree;
    EXPECT_NEAR(h1, degree, 0.25) << "degree " << degree;
  }
}

double clamped_plate_deflection(int cells, double thickness) {
  const Material material{"plate", 206e9, 0.3, 0, 1};
  const BlockMesh mesh = testing::box_mesh({cells, cells, 1}, Vector3(1, 1, thickness), material);
  const Discretisation space(mesh, 3);
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space,
      [](const Vector3& x) {
        return std::min({x.x(), x.y(), 1 - x.x(), 1 - x.y()}) < 1e-9;
      },
      [](const Vector3&) -> Vector3 { return Vector3::Zero(); }, {true, true, true}, fixed);
  const double pressure = 1000;
  const Eigen::VectorXd load = traction_load(
      mesh, space, [](const Vector3&, const Vector3& n) { return n.z() > 0.5; },
      [&](const Vector3&, const Vector3& n) -> Vector3 { return -pressure * n; });
  const Eigen::VectorXd u = testing::solve(mesh, space, fixed, load);
  double deflection = 0;
  for (int n = 0; n < space.node_count(); ++n) deflection = std::max(deflection, -u[3 * n + 2]);
  const double rigidity = 206e9 * std::pow(thickness, 3) / (12 * (1 - 0.09));
  return deflection * rigidity / pressure;
}

// Timoshenko and Woinowsky-Krieger (1959), table 35: w = 0.00126532 q a^4 / D for the thin plate
// clamped all round. One layer of cubic hexahedra, element aspect 125 at 4 x 4: measured 2.2 % too
// stiff at 4 x 4 and 1.3 % at 8 x 8; no locking as the plate gets thinner at the same elements.
TEST(ClampedPlate, CubicElementsReachKirchhoff) {
  const double reference = 0.00126532;
  for (const double thickness : {1.0 / 100, 1.0 / 500, 1.0 / 2000}) {
    const double coarse = clamped_plate_deflection(4, thickness) / reference;
    const double fine = clamped_plate_deflection(8, thickness) / reference;
    std::printf("a/t = %5.0f: 4 x 4 %.4f, 8 x 8 %.4f of Kirchhoff\n", 1 / thickness, coarse, fine);
    EXPECT_NEAR(coarse, 1, 0.030);
    EXPECT_NEAR(fine, 1, 0.016);
  }
}

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

double le10_stress(int radial, int around, int layers) {
  const auto path = std::filesystem::temp_directory_path() / "blocklift_le10.msh";
  write_elliptic_plate(path.string(), radial, around, layers);
  const HexMesh mesh = read_gmsh(path.string(), {{"plate", {"steel", 210e9, 0.3, 0, 1}}});
  std::filesystem::remove(path);
  const Discretisation space(mesh, 3);

  // Outer face: nodes that lie on boundary faces whose vertices are all on the outer ellipse.
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
    for (int a = 0; a < 2; ++a)
      if (!held[static_cast<std::size_t>(3 * n + a)]) fixed.push_back({3 * n + a, 0});
    if (std::abs(space.nodes(2, n) - 0.3) < 1e-9) fixed.push_back({3 * n + 2, 0});
  }
  const Eigen::VectorXd load = traction_load(
      mesh, space, [](const Vector3&, const Vector3& n) { return n.z() > 0.9; },
      [](const Vector3&, const Vector3& n) -> Vector3 { return -1e6 * n; });
  const Eigen::VectorXd u = testing::solve(mesh, space, fixed, load);

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
  EXPECT_GT(count, 0);
  return sum / count;
}

// NAFEMS (1990), The standard NAFEMS benchmarks, test LE10: sigma_yy = -5.38 MPa at D = (2, 0) on
// top. Cells are curved (quadratic): straight ones would leave a notch at D. Measured with cubic
// elements: 4 x 8 x 2 -5.464, 8 x 16 x 4 -5.402, 12 x 24 x 6 -5.400 MPa, so that the published
// figure is 0.4 % off the limit; 1 % covers that and the mesh.
TEST(Le10, StressAtPointD) {
  const double coarse = le10_stress(4, 8, 2), fine = le10_stress(8, 16, 4);
  std::printf("sigma_yy at D: 4 x 8 x 2 %.4f MPa, 8 x 16 x 4 %.4f MPa, reference -5.38 MPa\n",
              coarse / 1e6, fine / 1e6);
  EXPECT_NEAR(fine / -5.38e6, 1, 0.01);
  EXPECT_LT(std::abs(fine + 5.38e6), std::abs(coarse + 5.38e6));
}

// The shipped size: more than 200,000 unknowns, balanced lift, reactions that vanish.
TEST(HullBlock, LiftAtFullSize) {
  const BlockDescription block = testing::hull_block();
  const ElasticModel model = make_elastic_model(block, 3);
  EXPECT_GT(model.unknowns(), 200000);
  const UnitResponses responses(model);
  LoadCase load_case{"lift", {}, {}};
  Wrench pull;
  for (const LugRegion& lug : model.mesh().lugs) {
    const Vector3 force(0, 0, model.mass_properties().mass * 9.80665 / 6);
    load_case.lug_forces_B.push_back(force);
    pull.force += force;
    pull.moment += lug.p_BPin.cross(force);
  }
  load_case.field = balancing_field(model.mass_properties(), pull);
  const LoadCaseResult result = StressRecovery(responses).evaluate(load_case);
  EXPECT_LT(result.balance.force_residual, 1e-8);
  EXPECT_LT(result.balance.moment_residual, 1e-8);
  EXPECT_LT(result.balance.reaction_over_weight, 1e-6);
  // Between the mean stress of the lugs' roots and yield: a sanity bracket, not a reference.
  EXPECT_GT(result.checked_von_mises.value, 860e3 * 9.8 / 6 / (2.0 * 0.05));
  EXPECT_LT(result.checked_von_mises.value, 355e6);
  EXPECT_LT(responses.timing().assembly_s, responses.timing().factorisation_s / 4);
  const Eigen::VectorXd direct =
      responses.without_rigid_motion(responses.solve_directly(load_case));
  const Eigen::VectorXd superposed =
      responses.without_rigid_motion(responses.displacement(load_case));
  EXPECT_LT((superposed - direct).norm(), 1e-9 * direct.norm());
}

}  // namespace
}  // namespace blocklift::structure
