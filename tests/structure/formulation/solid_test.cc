// Solids among plates and beams: shapes, stiffness, mass, stresses, joints with plates.
#include "structure/formulation/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/solid_shape.h"
#include "structure/stress/solid_error.h"
#include "structure/system/assembly.h"
#include "structure/system/matter.h"

namespace blocklift::structure {
namespace {

const Material metal{"metal", 200e9, 0.3, 8000, 235e6};

Mesh empty_mesh() {
  Mesh mesh;
  mesh.materials = {metal};
  mesh.groups = {{"solids"}};
  mesh.regions = {{.name = "solids"}};
  return mesh;
}

/// The corners of a box's grid, x fastest, the inner ones moved at random.
void add_grid(Mesh& mesh, const Vector3& size, const std::array<int, 3>& cells, double disorder) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-disorder, disorder);
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) {
        const bool is_inner =
            i > 0 && i < cells[0] && j > 0 && j < cells[1] && k > 0 && k < cells[2];
        Vector3 place(i, j, k);
        if (is_inner) place += Vector3(share(random), share(random), share(random));
        mesh.vertices.push_back(
            place.cwiseQuotient(Vector3(cells[0], cells[1], cells[2])).cwiseProduct(size));
      }
}

/// Corners of the solids of one shape that make up a hexahedron with corners 0 to 7 and its middle
/// 8: itself, two wedges, six tetrahedra or six pyramids.
std::vector<std::vector<int>> parts_of(SolidShape shape) {
  switch (shape) {
    case SolidShape::tetrahedron:
      return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    case SolidShape::wedge:
      return {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
    case SolidShape::pyramid:
      return {{0, 1, 2, 3, 8}, {4, 5, 6, 7, 8}, {0, 1, 5, 4, 8},
              {1, 2, 6, 5, 8}, {2, 3, 7, 6, 8}, {3, 0, 4, 7, 8}};
    case SolidShape::hexahedron:
      break;
  }
  return {{0, 1, 2, 3, 4, 5, 6, 7}};
}

/// A box of solids, the cells of which are in turn of either shape.
Mesh box(const std::array<SolidShape, 2>& shapes, const Vector3& size,
         const std::array<int, 3>& cells, double disorder = 0) {
  Mesh mesh = empty_mesh();
  add_grid(mesh, size, cells, disorder);
  const auto vertex = [&](int i, int j, int k) {
    return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i;
  };
  SolidEdgeMiddles middles(mesh);
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        std::vector<int> corners{vertex(i, j, k),
                                 vertex(i + 1, j, k),
                                 vertex(i + 1, j + 1, k),
                                 vertex(i, j + 1, k),
                                 vertex(i, j, k + 1),
                                 vertex(i + 1, j, k + 1),
                                 vertex(i + 1, j + 1, k + 1),
                                 vertex(i, j + 1, k + 1)};
        const SolidShape shape = shapes[(i + j + k) % 2];
        if (shape == SolidShape::pyramid) {
          Vector3 middle = Vector3::Zero();
          for (const int corner : corners) middle += mesh.vertices[corner] / 8;
          corners.push_back(static_cast<int>(mesh.vertices.size()));
          mesh.vertices.push_back(middle);
        }
        for (const std::vector<int>& part : parts_of(shape)) {
          Solid solid;
          solid.shape = shape;
          for (const int corner : part) solid.vertices.push_back(corners[corner]);
          complete_solid(mesh, solid, middles);
          mesh.solids.push_back(std::move(solid));
        }
      }
  return mesh;
}

/// A box of solids of one shape.
Mesh box(SolidShape shape, const Vector3& size, const std::array<int, 3>& cells,
         double disorder = 0) {
  return box(std::array<SolidShape, 2>{shape, shape}, size, cells, disorder);
}

Eigen::SparseMatrix<double> whole(const SparseLower& lower) {
  Eigen::SparseMatrix<double> matrix = lower.cast<double>();
  return matrix.selfadjointView<Eigen::Lower>();
}

const std::array<SolidShape, 4> all_shapes{SolidShape::tetrahedron, SolidShape::wedge,
                                           SolidShape::hexahedron, SolidShape::pyramid};

using SixStresses = Eigen::Matrix<double, 6, 1>;  // xx, yy, zz, xy, yz, zx

/// Patch test (Irons): under a linear displacement disordered solids of a box have one stress, and
/// no force is left within.
void expect_patch(const Mesh& mesh, const Vector3& size, const Eigen::Matrix3d& slope,
                  const SixStresses& exact) {
  const Space space(mesh, {.degree = 2, .largest_edge = {}});
  EXPECT_EQ(space.unknowns(), 3 * space.node_count());
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(space.freedoms());
  for (Eigen::Index n = 0; n < space.node_count(); ++n)
    motion.segment<3>(6 * n) = slope * space.nodes().col(n);
  double worst = 0;
  for (int s = 0; s < static_cast<int>(mesh.solids.size()); ++s) {
    const Eigen::MatrixXd stress = solid_corner_stresses(space, s, motion);
    for (Eigen::Index c = 0; c < stress.rows() / 6; ++c)
      worst = std::max(worst, (stress.col(0).segment<6>(6 * c) - exact).norm());
  }
  EXPECT_LT(worst, 1e-10 * exact.norm());
  Eigen::VectorXd unknowns(space.unknowns());
  for (int f = 0; f < space.freedoms(); ++f)
    for (const Space::Term* term = space.begin_of(f); term != space.end_of(f); ++term)
      unknowns[term->unknown] = motion[f];
  const Eigen::VectorXd forces = whole(assemble_stiffness(space)) * unknowns;
  double inner = 0;
  Vector3 pull = Vector3::Zero();  // on the face at the end of x, and its edges
  for (Eigen::Index n = 0; n < space.node_count(); ++n) {
    const Vector3 place = space.nodes().col(n);
    const double wall = std::min(place.minCoeff(), (size - place).minCoeff());
    for (int c = 0; c < 3; ++c) {
      const double force = forces[space.begin_of(static_cast<int>(6 * n) + c)->unknown];
      if (wall > 1e-9) inner = std::max(inner, std::abs(force));
      if (place.x() > size.x() - 1e-9) pull[c] += force;
    }
  }
  EXPECT_LT(inner, 1e-10 * forces.cwiseAbs().maxCoeff());
  if (exact.tail<5>().isZero(0)) {
    EXPECT_NEAR(pull.x(), exact[0] * size.y() * size.z(), 1e-9 * pull.x());
  }
}

TEST(Solids, PatchOfEachShape) {
  Eigen::Matrix3d slope;
  slope << 1e-4, 2e-4, -1e-4, 3e-4, -2e-4, 1e-4, 2e-4, 1e-4, 3e-4;
  const Eigen::Matrix3d strain = 0.5 * (slope + slope.transpose());
  const Eigen::Matrix3d t = metal.lame_lambda() * strain.trace() * Eigen::Matrix3d::Identity() +
                            2 * metal.shear_modulus() * strain;
  SixStresses exact;
  exact << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0);
  const Vector3 size(3, 2, 2);
  for (const SolidShape shape : all_shapes)
    expect_patch(box(shape, size, {3, 2, 2}, 0.2), size, slope, exact);
  // Faces of pyramids are those of their neighbours.
  expect_patch(box({SolidShape::hexahedron, SolidShape::pyramid}, size, {3, 2, 2}, 0.2), size,
               slope, exact);
}

// A block of an orthotropic material whose axis 1 stands 30 degrees from x towards y, pulled along
// x: it grows longer by 1 / E_x, and shears. Closed form: Jones (1999), equations 2.88 and 2.97;
// across the plane the contraction is that of both axes' shares.
TEST(Solids, OrthotropicBlockPulledOffItsAxes) {
  const OrthotropicConstants wood{{12e9, 0.9e9, 0.5e9}, {0.4, 0.45, 0.35}, {0.8e9, 0.7e9, 0.05e9}};
  const Vector3 &e = wood.youngs_moduli, &nu = wood.poisson_ratios;
  const double angle = std::acos(-1.0) / 6, c = std::cos(angle), s = std::sin(angle);
  const double s11 = 1 / e[0], s12 = -nu[0] / e[0], s22 = 1 / e[1], s66 = 1 / wood.shear_moduli[0];
  const double pull = 1e6;
  const double along = s11 * c * c * c * c + (2 * s12 + s66) * c * c * s * s + s22 * s * s * s * s;
  const double across = s12 * (c * c * c * c + s * s * s * s) + (s11 + s22 - s66) * c * c * s * s;
  const double shear =
      (2 * s11 - 2 * s12 - s66) * s * c * c * c - (2 * s22 - 2 * s12 - s66) * s * s * s * c;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
  slope(0, 0) = pull * along;
  slope(1, 1) = pull * across;
  slope(2, 2) = -pull * (nu[1] / e[0] * c * c + nu[2] / e[1] * s * s);
  slope(0, 1) = pull * shear;
  SixStresses exact = SixStresses::Zero();
  exact[0] = pull;
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
  const Vector3 size(3, 2, 2);
  for (const SolidShape shape : all_shapes) {
    Mesh mesh = box(shape, size, {3, 2, 2}, 0.2);
    mesh.elasticities = {turned(orthotropic_elasticity(wood), axes)};
    for (Solid& solid : mesh.solids) solid.elasticity = 0;
    expect_patch(mesh, size, slope, exact);
    EXPECT_NEAR(mass_properties(mesh).mass, 12 * metal.density, 1e-6);
  }
  EXPECT_TRUE(is_positive(orthotropic_elasticity(wood)));
  EXPECT_FALSE(is_isotropic(orthotropic_elasticity(wood)));
}

// The elasticity of an isotropic material, by its nine constants and however it is turned, is that
// of the formulation for such materials.
TEST(Solids, IsotropicElasticityByItsConstants) {
  const double e = metal.youngs_modulus, nu = metal.poisson_ratio, g = metal.shear_modulus();
  const Elasticity law = turned(orthotropic_elasticity({{e, e, e}, {nu, nu, nu}, {g, g, g}}),
                                Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).matrix());
  EXPECT_TRUE(is_isotropic(law));
  const Material nearest = nearest_isotropic(law);
  EXPECT_NEAR(nearest.youngs_modulus, e, 1e-9 * e);
  EXPECT_NEAR(nearest.poisson_ratio, nu, 1e-9);
  for (const SolidShape shape : all_shapes) {
    const Mesh mesh = box(shape, {1, 1.2, 0.8}, {1, 1, 1});
    const Eigen::MatrixXd own = solid_stiffness(mesh, mesh.solids.front());
    const Eigen::MatrixXd other =
        solid_stiffness(topology_of(shape).kind, places_of(mesh, mesh.solids.front()), law);
    EXPECT_LT((own - other).norm(), 1e-10 * own.norm());
  }
}

TEST(Solids, MassCentreAndInertiaOfABox) {
  for (const SolidShape shape : all_shapes) {
    const Mesh mesh = box(shape, {3, 2, 1}, {2, 2, 2}, 0.2);
    const MeshMass mass = mass_properties(mesh);
    EXPECT_NEAR(mass.mass, 6 * 8000, 1e-6);
    EXPECT_NEAR((mass.centre - Vector3(1.5, 1, 0.5)).norm(), 0, 1e-10);
    const Vector3 exact = 48000 / 12.0 * Vector3(4 + 1, 9 + 1, 9 + 4);
    EXPECT_NEAR((mass.inertia.diagonal() - exact).norm(), 0, 1e-8 * exact.norm());
    // The finite elements' own: a rigid motion's energy.
    const Space space(mesh, {.degree = 2, .largest_edge = {}});
    const MassProperties properties = find_mass_properties(space, nullptr, nullptr);
    EXPECT_NEAR(properties.mass, 48000, 1e-6);
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(space.freedoms());
    for (Eigen::Index n = 0; n < space.node_count(); ++n)
      turn.segment<3>(6 * n) = Vector3::UnitZ().cross(space.nodes().col(n) - Vector3(1.5, 1, 0.5));
    EXPECT_NEAR(turn.dot(mass_matrix(space, properties) * turn), exact.z(), 1e-7 * exact.z());
  }
}

// Nodes counted the other way round describe the same solid.
TEST(Solids, TurnsWhatIsInsideOut) {
  for (const SolidShape shape : all_shapes) {
    Mesh mesh = box(shape, {1, 1, 1}, {1, 1, 1});
    for (Solid& solid : mesh.solids) {
      const std::vector<int> given = solid.vertices;
      for (std::size_t i = 0; i < given.size(); ++i)
        solid.vertices[i] = given[topology_of(shape).mirrored[i]];
      EXPECT_LT(least_jacobian_ratio(mesh, solid), 0);
    }
    EXPECT_THROW(check_mesh(mesh), ModelError);
    SolidEdgeMiddles middles(mesh);
    for (Solid& solid : mesh.solids) complete_solid(mesh, solid, middles);
    EXPECT_NO_THROW(check_mesh(mesh));
    EXPECT_NEAR(mass_properties(mesh).mass, 8000, 1e-6);
  }
}

/// Displacement of the end of a cantilever of solids, of length 10, 1 x 1 m, under a force across
/// spread over the end face, over that of Timoshenko (1921), shear coefficient 5/6.
double cantilever_ratio(SolidShape shape, const std::array<int, 3>& cells) {
  const Mesh mesh = box(shape, {10, 1, 1}, cells);
  const Space space(mesh, {.degree = 2, .largest_edge = {}});
  SparseLower stiffness = assemble_stiffness(space);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.unknowns());
  int at_end = 0;
  for (Eigen::Index n = 0; n < space.node_count(); ++n)
    if (space.nodes()(0, n) > 10 - 1e-9) ++at_end;
  double sum = 0;
  for (Eigen::Index n = 0; n < space.node_count(); ++n) {
    const int first = static_cast<int>(6 * n);
    if (space.nodes()(0, n) > 10 - 1e-9) load[space.begin_of(first + 2)->unknown] += 1e6 / at_end;
    if (space.nodes()(0, n) < 1e-9)
      for (int c = 0; c < 3; ++c) {
        const int unknown = space.begin_of(first + c)->unknown;
        stiffness.coeffRef(unknown, unknown) += 1e18;
      }
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(whole(stiffness));
  const Eigen::VectorXd moved = solver.solve(load);
  for (Eigen::Index n = 0; n < space.node_count(); ++n)
    if (space.nodes()(0, n) > 10 - 1e-9)
      sum += moved[space.begin_of(static_cast<int>(6 * n) + 2)->unknown] / at_end;
  const double inertia = 1 / 12.0;
  const double bending = 1e6 * 1000 / (3 * metal.youngs_modulus * inertia);
  const double shear = 1e6 * 10 / (5.0 / 6 * metal.shear_modulus());
  return sum / (bending + shear);
}

// The root is held against Poisson's contraction, which no beam knows: some parts in a thousand of
// the limit. The elements' own error falls with their size, from 2 % of one over the height.
TEST(Solids, CantileverOfTimoshenko) {
  const double coarse = cantilever_ratio(SolidShape::hexahedron, {10, 1, 1}),
               fine = cantilever_ratio(SolidShape::hexahedron, {20, 2, 2});
  EXPECT_NEAR(coarse, 1, 0.025);
  EXPECT_NEAR(fine, 1, 0.0125);
  EXPECT_GT(fine, coarse);
  EXPECT_NEAR(cantilever_ratio(SolidShape::wedge, {10, 2, 2}), 1, 0.02);
  EXPECT_NEAR(cantilever_ratio(SolidShape::tetrahedron, {10, 2, 2}), 1, 0.025);
  EXPECT_NEAR(cantilever_ratio(SolidShape::pyramid, {10, 1, 1}), 1, 0.025);
}

// A plate of shells that goes on along the top of solids follows them: under a linear motion of
// the solids its nodes along their edges do not gape, whatever its own degree and division.
TEST(Solids, PlatesFollowTheEdgesTheyLieOn) {
  Mesh mesh = box(SolidShape::hexahedron, {1, 1, 1}, {1, 1, 1});
  mesh.shell_sections = {{.thickness = 0.02}};
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, 2);
  mesh.vertices.emplace_back(1, 0, 2);
  mesh.shells.push_back({.vertices = {4, 5, first, first + 1}});
  const Space space(mesh, {.degree = 3, .largest_edge = [](const Vector3&) { return 0.3; }});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-1, 1);
  const Eigen::MatrixXd motion = space.expand(
      Eigen::MatrixXd::NullaryExpr(space.unknowns(), 1, [&] { return share(random); }));
  // The edge from (0, 0, 1) to (1, 0, 1): the solid's parabola through its three nodes.
  const auto node_at = [&](const Vector3& place) {
    Eigen::Index node = 0;
    (space.nodes().colwise() - place).colwise().norm().minCoeff(&node);
    return node;
  };
  const Eigen::Index a = node_at({0, 0, 1}), m = node_at({0.5, 0, 1}), b = node_at({1, 0, 1});
  int along = 0;
  for (Eigen::Index n = 0; n < space.node_count(); ++n) {
    const Vector3 place = space.nodes().col(n);
    if (std::abs(place.y()) > 1e-9 || std::abs(place.z() - 1) > 1e-9) continue;
    ++along;
    const double x = place.x();
    const Vector3 expected = (1 - x) * (1 - 2 * x) * motion.col(0).segment<3>(6 * a) +
                             4 * x * (1 - x) * motion.col(0).segment<3>(6 * m) +
                             x * (2 * x - 1) * motion.col(0).segment<3>(6 * b);
    EXPECT_LT((motion.col(0).segment<3>(6 * n) - expected).norm(), 1e-12);
  }
  EXPECT_GT(along, 12);
}

// Superconvergent patch recovery has polynomials of second order: of a quadratic motion, whose
// stress is linear, every shape finds both exactly, but for rounding, which grows by 1e6 as the fit
// scales terms of second degree by 1e-6. Of a smooth motion the estimate comes near the true error.
TEST(Solids, ErrorOfTheirStressIsEstimatedForAllShapes) {
  const Elasticity law = isotropic_elasticity(metal);
  const double k = 1.5;
  for (const SolidShape shape : all_shapes) {
    const Mesh mesh = box(shape, Vector3(2, 1, 1), {4, 2, 2});
    const Space space(mesh, {.degree = 2, .largest_edge = {}});
    const SolidSet solids = solids_of(space);
    const NodalPoints points = find_nodal_points(solids);
    Eigen::VectorXd quadratic(3 * solids.nodes.cols()), bent(quadratic.size());
    for (Eigen::Index n = 0; n < solids.nodes.cols(); ++n) {
      const Vector3 x = solids.nodes.col(n);
      quadratic.segment<3>(3 * n) << x.x() * x.y(), x.z() * x.z() - x.x() * x.x(), x.y() * x.z();
      bent.segment<3>(3 * n) << std::sin(k * x.x()) * x.z(), 0, std::cos(k * x.x()) / k;
    }
    std::vector<int> all(mesh.solids.size());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_LT(estimate_solid_error(solids, points, quadratic).relative(all), 1e-7);
    const double estimated = estimate_solid_error(solids, points, bent).relative(all);
    const double exact = true_solid_error(solids, bent, [&](const Vector3& x) -> Stress {
                           return law.col(0) * (k * std::cos(k * x.x()) * x.z());  // e_xx alone
                         }).relative(all);
    EXPECT_GT(estimated, 0.5 * exact) << static_cast<int>(shape);
    EXPECT_LT(estimated, 2 * exact) << static_cast<int>(shape);
  }
}

}  // namespace
}  // namespace blocklift::structure
