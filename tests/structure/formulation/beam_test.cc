#include "structure/formulation/beam.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/stress/beam_stress.h"
#include "tests/structure/formulation/rigid_motions.h"

namespace blocklift::structure {
namespace {

constexpr double length = 3, force = 1000;
constexpr double close = 1e-9;  // of the figure: some hundred unknowns, condition 1e6

BeamSection sample_section() {
  BeamSection section;
  section.area = 4e-3;
  section.second_moment_2 = 8e-6;
  section.second_moment_3 = 3e-6;
  section.torsion = 5e-6;
  section.shear_area_2 = 2e-3;
  section.shear_area_3 = 1.5e-3;
  return section;
}

// A line of beams along x, then along what comes next.
Mesh line_of_beams(const BeamSection& section, const std::vector<Vector3>& vertices,
                   const Vector3& axis_2 = Vector3::UnitY()) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  mesh.beam_sections = {section};
  mesh.vertices = vertices;
  for (int v = 0; v + 1 < static_cast<int>(vertices.size()); ++v) {
    Beam beam;
    beam.vertices = {v, v + 1};
    beam.axis_2 = axis_2;
    beam.label = v + 1;
    mesh.beams.push_back(beam);
  }
  return mesh;
}

void clamp(const Space& space, const Vector3& place, std::vector<FixedUnknown>& fixed) {
  examples::hold(
      space, [&](const Vector3& x) { return (x - place).norm() < 1e-9; }, {0, 1, 2, 3, 4, 5},
      fixed);
}

// Motion of a cantilever clamped at the first vertex, loaded at the last.
Eigen::Matrix<double, 6, 1> tip_motion(const Mesh& mesh, int degree,
                                       const Eigen::Matrix<double, 6, 1>& load) {
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  clamp(space, mesh.vertices.front(), fixed);
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(space.freedoms());
  const int tip = space.node_of_vertex(static_cast<int>(mesh.vertices.size()) - 1);
  loads.segment<6>(6 * tip) = load;
  return examples::solve(space, loads, fixed).segment<6>(6 * tip);
}

Eigen::Matrix<double, 6, 1> unit(int c, double value) {
  return value * Eigen::Matrix<double, 6, 1>::Unit(c);
}

// Pulled at its end, a bar whose area falls on a line from A_0 to A_1 grows by F l / (E (A_0 -
// A_1)) ln(A_0 / A_1), and its stress is F / A everywhere. Elements of degree p with p Gauss points
// have the growth with an error of order 2 p of the taper of one of them.
TEST(Beam, TaperedBar) {
  for (const int cells : {1, 2}) {
    std::vector<Vector3> vertices;
    for (int v = 0; v <= cells; ++v) vertices.emplace_back(length * v / cells, 0, 0);
    Mesh mesh = line_of_beams(sample_section(), vertices);
    const double narrow = 0.5, area = sample_section().area;
    mesh.beam_sections.clear();
    for (int v = 0; v <= cells; ++v) {
      BeamSection section = sample_section();
      section.area *= 1 - narrow * v / cells;
      mesh.beam_sections.push_back(section);
    }
    for (int b = 0; b < cells; ++b) {
      mesh.beams[b].section = b;
      mesh.beams[b].end_section = b + 1;
    }
    const Space space(mesh, {3, {}});
    std::vector<FixedUnknown> fixed;
    clamp(space, mesh.vertices.front(), fixed);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(space.freedoms());
    const int tip = space.node_of_vertex(cells);
    loads[6 * tip] = force;
    const Eigen::VectorXd motion = examples::solve(space, loads, fixed);
    const double modulus = examples::plain_steel().youngs_modulus;
    const double exact = force * length / (modulus * narrow * area) * std::log(1 / (1 - narrow));
    EXPECT_NEAR(motion[6 * tip], exact, (cells == 1 ? 5e-5 : 2e-6) * exact);
    for (const double xi : {0.0, 0.3, 1.0}) {
      const double there = area * (1 - narrow * (cells - 1 + xi) / cells);
      const Eigen::MatrixXd stress = beam_stresses(space, cells - 1, xi, motion);
      EXPECT_NEAR(stress(0, 0), force / there, 1e-8 * force / there) << xi;
    }
  }
}

// Timoshenko: w = P l^3 / 3 E I + P l / G A_s, slope P l^2 / 2 E I; exact at the end for any
// degree, as the reduced rule makes quadratic elements. Axis 1 = x, 2 = y, 3 = z.
TEST(Beam, TimoshenkosCantilever) {
  const BeamSection s = sample_section();
  const Material m = examples::plain_steel();
  const double e = m.youngs_modulus, g = m.shear_modulus();
  for (int degree = 1; degree <= 4; ++degree) {
    const Mesh mesh = line_of_beams(s, {{0, 0, 0}, {1, 0, 0}, {length, 0, 0}});
    const auto across_y = tip_motion(mesh, degree, unit(1, force));
    const double w_y = force * std::pow(length, 3) / (3 * e * s.second_moment_3) +
                       force * length / (g * s.shear_area_2);
    EXPECT_NEAR(across_y[1], w_y, close * w_y) << degree;
    const double slope = force * length * length / (2 * e * s.second_moment_3);
    EXPECT_NEAR(across_y[5], slope, close * slope) << degree;
    const auto across_z = tip_motion(mesh, degree, unit(2, force));
    const double w_z = force * std::pow(length, 3) / (3 * e * s.second_moment_2) +
                       force * length / (g * s.shear_area_3);
    EXPECT_NEAR(across_z[2], w_z, close * w_z) << degree;
    EXPECT_NEAR(tip_motion(mesh, degree, unit(0, force))[0], force * length / (e * s.area),
                close * w_z);
    EXPECT_NEAR(tip_motion(mesh, degree, unit(3, force))[3], force * length / (g * s.torsion),
                close * w_z);
  }
}

// A quarter of a ring of a metre, along the curved edges of four shells that are next to nothing,
// clamped at one end and pulled outwards at the other. By Castigliano, with the centroids on a
// radius r: w = pi / 4 F r (r^2 / E I + 1 / E A + 1 / G A_s). Turned as a rigid body the bar stores
// nothing, since its nodes lie on the curve, as those of the shells do that they move with. Four
// parabolas leave 7e-5 of w, and straight lines for the arms to their centroids 4e-3.
TEST(Beam, AQuarterOfARingAlongCurvedEdges) {
  constexpr int count = 4;
  const auto on_ring = [](double share, double z) {
    const double angle = share * std::numbers::pi / 2;
    return Vector3(std::cos(angle), std::sin(angle), z);
  };
  for (const auto& [inwards, tolerance] : {std::pair(0.0, 3e-4), std::pair(0.1, 8e-3)}) {
    Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
    mesh.materials.push_back(examples::plain_steel());
    mesh.materials.back().youngs_modulus *= 1e-9;
    mesh.shell_sections[0].material = 1;
    mesh.beam_sections = {sample_section()};
    for (int i = 0; i <= count; ++i)
      for (const double z : {1.0, 0.0}) mesh.vertices.push_back(on_ring(1.0 * i / count, z));
    for (int i = 0; i < count; ++i) {
      Shell shell;
      shell.vertices = {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 3};
      shell.curvature = i;
      mesh.shells.push_back(shell);
      Eigen::Matrix3Xd points(3, 9);
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
          points.col(3 * row + column) = on_ring((i + 0.5 * column) / count, 1 - 0.5 * row);
      mesh.curved_shells.push_back(points);
      Beam beam;
      beam.vertices = {2 * i + 1, 2 * i + 3};
      beam.axis_2 = Vector3::UnitZ();
      for (int end = 0; end < 2; ++end)
        beam.offset[static_cast<std::size_t>(end)] = -inwards * on_ring(1.0 * (i + end) / count, 0);
      mesh.beams.push_back(beam);
    }
    const Space space(mesh, {2, {}});
    const Vector3 turn(0.3, -0.2, 0.5);
    for (std::size_t cell = 0; cell < space.beams().size(); ++cell) {
      const Eigen::MatrixXd stiffness = beam_stiffness(space, static_cast<int>(cell));
      Eigen::VectorXd motion(stiffness.rows());
      for (std::size_t i = 0; i < space.beams()[cell].nodes.size(); ++i) {
        const Vector3 place = space.nodes().col(space.beams()[cell].nodes[i]);
        motion.segment<6>(6 * static_cast<Eigen::Index>(i)) << turn.cross(place), turn;
      }
      EXPECT_LT((stiffness * motion).norm(), 1e-12 * stiffness.norm());
    }
    std::vector<FixedUnknown> fixed;
    clamp(space, on_ring(0, 0), fixed);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(space.freedoms());
    const int tip = space.node_of_vertex(2 * count + 1);
    loads[6 * tip + 1] = force;
    const BeamSection s = sample_section();
    const Material m = examples::plain_steel();
    const double e = m.youngs_modulus, r = 1 - inwards;
    const double expected = std::numbers::pi / 4 * force * r *
                            (r * r / (e * s.second_moment_2) + 1 / (e * s.area) +
                             1 / (m.shear_modulus() * s.shear_area_3));
    EXPECT_NEAR(examples::solve(space, loads, fixed)[6 * tip + 1], expected, tolerance * expected);
  }
}

// A force across a cantilever is the same all along it, at any place of an element of any degree,
// however slender it is: away from the Gauss points the shear strain is no force's.
TEST(Beam, ForcesAcrossAreThoseOfStatics) {
  for (const double shear_area : {2e-3, std::numeric_limits<double>::infinity()})
    for (int degree = 1; degree <= 3; ++degree) {
      BeamSection s = sample_section();
      s.shear_area_2 = s.shear_area_3 = shear_area;
      const Mesh mesh = line_of_beams(s, {{0, 0, 0}, {1, 0, 0}, {length, 0, 0}});
      const Space space(mesh, {degree, {}});
      std::vector<FixedUnknown> fixed;
      clamp(space, mesh.vertices.front(), fixed);
      Eigen::VectorXd loads = Eigen::VectorXd::Zero(space.freedoms());
      const int tip = space.node_of_vertex(2);
      loads.segment<3>(6 * tip + 1) << force, -2 * force, 0.5 * force;
      const Eigen::VectorXd motion = examples::solve(space, loads, fixed);
      for (const int cell : {0, 1})
        for (const double xi : {0.0, 0.3, 1.0}) {
          const Eigen::VectorXd found = beam_forces(space, cell, xi, motion);
          EXPECT_NEAR(found[1], force, 1e-6 * force) << degree << ' ' << xi;
          EXPECT_NEAR(found[2], -2 * force, 1e-6 * force) << degree << ' ' << xi;
          EXPECT_NEAR(found[3], 0.5 * force, 1e-6 * force) << degree << ' ' << xi;
        }
    }
}

// With I_23 a force along one axis bends about both: the curvatures are those of the inverse of
// [I_2 -I_23; -I_23 I_3]. Without shear deformation.
TEST(Beam, SkewBendingOfAnUnsymmetricSection) {
  BeamSection s = sample_section();
  s.product_23 = 2e-6;
  s.shear_area_2 = s.shear_area_3 = std::numeric_limits<double>::infinity();
  const double e = examples::plain_steel().youngs_modulus;
  const Mesh mesh = line_of_beams(s, {{0, 0, 0}, {length, 0, 0}});
  const auto motion = tip_motion(mesh, 2, unit(2, force));
  const double determinant = s.second_moment_2 * s.second_moment_3 - s.product_23 * s.product_23;
  const double factor = force * std::pow(length, 3) / (3 * e * determinant);
  // Infinite shear areas are 1e4 times the section's: of the deflection 3 E I / (G A 1e4 l^2),
  // below 1e-6.
  EXPECT_NEAR(motion[2], factor * s.second_moment_3, 1e-6 * factor * s.second_moment_3);
  EXPECT_NEAR(motion[1], -factor * s.product_23, 1e-6 * factor * s.second_moment_3);
}

// The section's product of inertia as a turn of the axes: a flat bar turned by 30 degrees.
TEST(Beam, ProductOfInertiaIsATurnOfTheAxes) {
  BeamSection principal = sample_section();
  principal.shear_area_2 = principal.shear_area_3 = 2e-3;
  const double angle = M_PI / 6, c = std::cos(angle), s = std::sin(angle);
  // x_2 = c a - s b, x_3 = s a + c b with principal coordinates a, b.
  const double aa = principal.second_moment_3, bb = principal.second_moment_2;
  BeamSection turned = principal;
  turned.second_moment_3 = c * c * aa + s * s * bb;
  turned.second_moment_2 = s * s * aa + c * c * bb;
  turned.product_23 = s * c * (aa - bb);
  const std::vector<Vector3> vertices{{0, 0, 0}, {length, 0, 0}};
  const Mesh by_axes = line_of_beams(principal, vertices, Vector3(0, c, s));
  const Mesh by_product = line_of_beams(turned, vertices);
  Eigen::Matrix<double, 6, 1> load;
  load << 100, 200, 300, 40, 50, 60;
  const auto expected = tip_motion(by_axes, 3, load), found = tip_motion(by_product, 3, load);
  EXPECT_LT((found - expected).norm(), close * expected.norm());
}

// A beam beside its nodes: the force at the nodes bends and twists it as rigid arms would.
TEST(Beam, OffsetIsARigidArm) {
  const Vector3 offset(0, 0.2, -0.3);
  Mesh beside = line_of_beams(sample_section(), {{0, 0, 0}, {1, 0, 0}, {length, 0, 0}});
  for (Beam& beam : beside.beams) beam.offset = {offset, offset};
  const Mesh plain = line_of_beams(sample_section(), {{0, 0, 0}, {1, 0, 0}, {length, 0, 0}});
  Eigen::Matrix<double, 6, 1> load;
  load << 1000, 200, 300, 40, 50, 60;
  // At the centroid's end the force's moment is that about it; back at the node u = u_c - theta x
  // offset.
  Eigen::Matrix<double, 6, 1> moved = load;
  moved.tail<3>() -= offset.cross(Vector3(load.head<3>()));
  Eigen::Matrix<double, 6, 1> expected = tip_motion(plain, 2, moved);
  expected.head<3>() -= Vector3(expected.tail<3>()).cross(offset);
  const auto found = tip_motion(beside, 2, load);
  EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm());
}

TEST(Beam, RigidMotionsStrainNothingWithSlopingOffsets) {
  for (int degree = 2; degree <= 4; ++degree) {
    Mesh mesh = line_of_beams(sample_section(), {{0.3, 0.1, -0.2}, {2, 1, 0.7}});
    mesh.beams[0].offset = {Vector3(0, 0.1, 0.2), Vector3(0.05, -0.1, 0.3)};
    const Space space(mesh, {degree, {}});
    const Eigen::MatrixXd k = beam_stiffness(space, 0);
    const Eigen::MatrixXd rigid = test::rigid_motions(space, space.beams()[0].nodes);
    EXPECT_LT((k * rigid).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff()) << degree;
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GT(values[6], 1e-9 * values.maxCoeff()) << degree;
  }
}

// Clamped at both ends with a hinge in the middle: two cantilevers under half of the force each.
TEST(Beam, ReleasedHingePassesNoMoment) {
  BeamSection s = sample_section();
  for (const bool offset : {false, true}) {
    Mesh mesh = line_of_beams(s, {{0, 0, 0}, {1.5, 0, 0}, {3, 0, 0}});
    mesh.beams[0].release[1] = {false, false, false, false, true, false};
    if (offset)
      for (Beam& beam : mesh.beams) beam.offset = {Vector3(0, 0, 0.2), Vector3(0, 0, 0.2)};
    const Space space(mesh, {2, {}});
    std::vector<FixedUnknown> fixed;
    clamp(space, {0, 0, 0}, fixed);
    clamp(space, {3, 0, 0}, fixed);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
    const int middle = space.node_of_vertex(1);
    load[6 * middle + 2] = force;
    const Eigen::VectorXd motion = examples::solve(space, load, fixed);
    const Material m = examples::plain_steel();
    const double half = force / 2, reach = 1.5;
    const double w = half * std::pow(reach, 3) / (3 * m.youngs_modulus * s.second_moment_2) +
                     half * reach / (m.shear_modulus() * s.shear_area_3);
    EXPECT_NEAR(motion[6 * middle + 2], w, 1e-8 * w) << offset;
  }
}

TEST(Beam, ReleasesThatLeaveItLooseAreRefused) {
  Mesh mesh = line_of_beams(sample_section(), {{0, 0, 0}, {1, 0, 0}});
  mesh.beams[0].release[0][0] = mesh.beams[0].release[1][0] = true;
  const Space space(mesh, {2, {}});
  EXPECT_THROW(beam_stiffness(space, 0), ModelError);
}

// Three legs of rods under a force: stiffness sum E A / L t t', whatever turns at the joint.
TEST(Beam, TripodOfRods) {
  const std::vector<Vector3> feet{{-1, 0.3, 0}, {1.2, 0.5, 0.1}, {0.1, -1, -0.2}};
  const Vector3 head(0.2, 0.1, 1.5), pull(300, -500, -1000);
  Mesh mesh = line_of_beams(sample_section(), {feet[0], head});
  for (const std::size_t i : {1U, 2U}) {
    mesh.vertices.push_back(feet[i]);
    Beam beam = mesh.beams[0];
    beam.vertices = {static_cast<int>(mesh.vertices.size()) - 1, 1};
    mesh.beams.push_back(beam);
  }
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  for (const Vector3& foot : feet) {
    const Vector3 leg = head - foot;
    stiffness += examples::plain_steel().youngs_modulus * sample_section().area /
                 std::pow(leg.norm(), 3) * leg * leg.transpose();
  }
  const Vector3 expected = stiffness.inverse() * pull;
  for (Beam& beam : mesh.beams) beam.is_rod = true;
  for (const double torsion : {0.0, 5e-6}) {
    mesh.beam_sections[0].torsion = torsion;
    for (const int degree : {1, 3}) {
      const Space space(mesh, {degree, [](const Vector3&) { return 0.4; }});
      std::vector<FixedUnknown> fixed;
      for (const Vector3& foot : feet) clamp(space, foot, fixed);
      Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
      load.segment<3>(6 * space.node_of_vertex(1)) = pull;
      const Vector3 found =
          examples::solve(space, load, fixed).segment<3>(6 * space.node_of_vertex(1));
      EXPECT_LT((found - expected).norm(), close * expected.norm()) << degree;
    }
  }
}

// Divided beams are the same beam; degree and cells do not matter under forces at the ends.
TEST(Beam, DivisionChangesNothing) {
  const Mesh mesh = line_of_beams(sample_section(), {{0, 0, 0}, {2, 1, 0.5}});
  Eigen::Matrix<double, 6, 1> load;
  load << 1000, 200, 300, 40, 50, 60;
  const auto whole = tip_motion(mesh, 3, load);
  const Space space(mesh, {3, [](const Vector3&) { return 0.4; }});
  ASSERT_GT(space.beams().size(), 4U);
  std::vector<FixedUnknown> fixed;
  clamp(space, mesh.vertices[0], fixed);
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(space.freedoms());
  loads.segment<6>(6 * space.node_of_vertex(1)) = load;
  const Eigen::Matrix<double, 6, 1> divided =
      examples::solve(space, loads, fixed).segment<6>(6 * space.node_of_vertex(1));
  EXPECT_LT((divided - whole).norm(), 1e-8 * whole.norm());
}

}  // namespace
}  // namespace blocklift::structure
