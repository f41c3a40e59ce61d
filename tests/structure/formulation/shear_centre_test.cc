// Beams whose shear centre is not their centroid.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/formulation/beam.h"
#include "structure/mesh/beams/sections.h"
#include "structure/stress/beam_stress.h"
#include "structure/system/matter.h"
#include "structure/system/natural_modes.h"
#include "tests/structure/formulation/rigid_motions.h"

namespace blocklift::structure {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;

constexpr double span = 1, push = 1000;
constexpr double tight = 1e-9;  // of the figure: some hundred unknowns, condition 1e6

/// A channel of 200 x 80 mm, 8 mm in the web: its shear centre is 51 mm behind its centroid.
Profile thin_channel() { return channel(0.2, 0.008, 0.08, 0.012); }
Profile thin_angle() { return angle_bar(0.2, 0.01, 0.1, 0.012); }

/// Two beams in line along x, whose axis 2 is y if nothing else is said.
Mesh two_in_line(const BeamSection& section, const Vector3& axis_2 = Vector3::UnitY(),
                 const Vector3& offset = Vector3::Zero()) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  mesh.beam_sections = {section};
  mesh.vertices = {{0, 0, 0}, {0.4 * span, 0, 0}, {span, 0, 0}};
  examples::add_beams(mesh, mesh.vertices.front(), mesh.vertices.back(), 0, axis_2, offset);
  return mesh;
}

std::vector<FixedUnknown> clamped(const Space& space, const std::vector<double>& places) {
  std::vector<FixedUnknown> fixed;
  for (const double x : places)
    examples::hold(
        space, [x](const Vector3& p) { return std::abs(p.x() - x) < 1e-9; }, {0, 1, 2, 3, 4, 5},
        fixed);
  return fixed;
}

/// Of the free end of a cantilever that is loaded there.
Motion6 end_motion(const Mesh& mesh, int degree, const Motion6& load) {
  const Space space(mesh, {degree, {}});
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(space.freedoms());
  const int end = space.node_of_vertex(2);
  loads.segment<6>(6 * end) = load;
  return examples::solve(space, loads, clamped(space, {0})).segment<6>(6 * end);
}

/// What a force through a point (y, z) beside a node is at the node.
Motion6 through(const Vector3& force, const Eigen::Vector2d& point) {
  Motion6 load;
  load << force, Vector3(0, point[0], point[1]).cross(force);
  return load;
}

// A force through the shear centre bends the channel as Timoshenko's beam and does not turn it; one
// through the centroid turns it by F e l / G J, Saint-Venant's torsion without warping.
TEST(ShearCentre, ForceThroughItDoesNotTurnAChannel) {
  BeamSection section = thin_channel().section;
  const Eigen::Vector2d centre = section.shear_centre;
  const Material m = examples::plain_steel();
  const double bent = push * (std::pow(span, 3) / (3 * m.youngs_modulus * section.second_moment_3) +
                              span / (m.shear_modulus() * section.shear_area_2));
  const double turn = push * centre[1] * span / (m.shear_modulus() * section.torsion);
  EXPECT_NEAR(turn, -0.00523, 5e-6);
  const Vector3 force(0, push, 0);
  for (int degree = 1; degree <= 4; ++degree) {
    const Mesh mesh = two_in_line(section);
    const Motion6 straight = end_motion(mesh, degree, through(force, centre));
    EXPECT_NEAR(straight[3], 0, tight * std::abs(turn)) << degree;
    EXPECT_NEAR(straight[1], bent, tight * bent) << degree;
    const Motion6 turned = end_motion(mesh, degree, through(force, Eigen::Vector2d::Zero()));
    EXPECT_NEAR(turned[3], turn, tight * std::abs(turn)) << degree;
    // The shear centre moves as before, the centroid turns about it.
    EXPECT_NEAR(turned[1], bent + centre[1] * turn, tight * bent) << degree;
  }
  // Nodes in the shear centre's line.
  const Mesh beside = two_in_line(section, Vector3::UnitY(), -Vector3(0, centre[0], centre[1]));
  EXPECT_NEAR(end_motion(beside, 3, through(force, Eigen::Vector2d::Zero()))[3], 0,
              tight * std::abs(turn));
  section.twists_about_centroid = true;
  EXPECT_NEAR(end_motion(two_in_line(section), 3, through(force, Eigen::Vector2d::Zero()))[3], 0,
              tight * std::abs(turn));
}

// An angle on nodes at its foot is the same whatever axes it is drawn in, and a mirrored one moves
// as in a mirror.
TEST(ShearCentre, AnglesAreTheSameSeenFromElsewhere) {
  const Profile angle = thin_angle();
  const auto motion = [](const Profile& profile, const Vector3& axis_2, const Motion6& load) {
    const Vector3 axis_3 = Vector3::UnitX().cross(axis_2);
    return end_motion(two_in_line(profile.section, axis_2,
                                  profile.centroid[0] * axis_2 + profile.centroid[1] * axis_3),
                      3, load);
  };
  Motion6 load, image;
  load << 700, 1000, -400, 30, 50, -60;
  // In the plane z = 0: displacements across it and rotations in it turn round.
  Motion6 mirror;
  mirror << 1, 1, -1, -1, -1, 1;
  image = mirror.cwiseProduct(load);
  const Motion6 expected = motion(angle, Vector3::UnitY(), load);
  const double close = 1e-8 * expected.norm();
  EXPECT_GT(std::abs(expected[3]), 1e-3);
  const Profile turned = seen(angle, true, false, true), back = seen(angle, false, true, true);
  EXPECT_LT((motion(turned, Vector3::UnitZ(), load) - expected).norm(), close);
  EXPECT_LT((motion(back, -Vector3::UnitY(), load) - expected).norm(), close);
  const Profile mirrored = seen(angle, false, false, true);
  EXPECT_LT((mirror.cwiseProduct(motion(mirrored, Vector3::UnitY(), image)) - expected).norm(),
            close);
  // Through the shear centre no force turns any of them.
  for (const Profile& one : {angle, turned, back, mirrored}) {
    const Motion6 straight = end_motion(two_in_line(one.section), 3,
                                        through(Vector3(0, 1000, -400), one.section.shear_centre));
    EXPECT_NEAR(straight[3], 0, tight * std::abs(expected[3]));
  }
}

// A second method: what bears N and bending in the centroids' line, beside what bears shear and
// torsion in the shear centres' line.
TEST(ShearCentre, IsTheOffsetOfShearAndTorsion) {
  const BeamSection whole = thin_angle().section;
  const Vector3 from(0.3, 0.1, -0.2), to(2, 1, 0.7), offset(0.02, -0.1, 0.2);
  const auto stiffness = [&](const BeamSection& section, const Vector3& beside, int degree) {
    Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
    mesh.beam_sections = {section};
    mesh.vertices = {from, to};
    examples::add_beams(mesh, from, to, 0, Vector3::UnitZ(), beside);
    return beam_stiffness(Space(mesh, {degree, {}}), 0);
  };
  const Vector3 along = (to - from).normalized();
  const Vector3 axis_2 = (Vector3::UnitZ() - along.z() * along).normalized();
  const Vector3 of_centre =
      offset + whole.shear_centre[0] * axis_2 + whole.shear_centre[1] * along.cross(axis_2);
  BeamSection bends = whole, shears = whole;
  bends.shear_area_2 = bends.shear_area_3 = bends.torsion = 0;
  bends.shear_centre.setZero();
  shears.second_moment_2 = shears.second_moment_3 = shears.product_23 = 0;
  shears.shear_centre.setZero();
  // What bears shear has an area, whose stretch is taken off again.
  BeamSection stretches = shears;
  stretches.shear_area_2 = stretches.shear_area_3 = stretches.torsion = 0;
  for (int degree = 1; degree <= 4; ++degree) {
    const Eigen::MatrixXd expected = stiffness(bends, offset, degree) +
                                     stiffness(shears, of_centre, degree) -
                                     stiffness(stretches, of_centre, degree);
    const Eigen::MatrixXd found = stiffness(whole, offset, degree);
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-12 * found.cwiseAbs().maxCoeff())
        << degree;
  }
}

// Centres on a line from c_0 to c_1 along a beam that is otherwise even: a force through the last
// one has the arm c - c_1 about each, so that the end turns by F (c_0 - c_1) l / (2 G J).
TEST(ShearCentre, MovesAlongATaperedBeam) {
  const BeamSection first = thin_channel().section;
  BeamSection last = first;
  last.shear_centre *= 0.3;
  Mesh mesh = two_in_line(first);
  BeamSection middle = first;
  middle.shear_centre += 0.4 * (last.shear_centre - first.shear_centre);
  mesh.beam_sections = {first, middle, last};
  for (int b = 0; b < 2; ++b) {
    mesh.beams[b].section = b;
    mesh.beams[b].end_section = b + 1;
  }
  const double turn = push * (first.shear_centre - last.shear_centre)[1] * span /
                      (2 * examples::plain_steel().shear_modulus() * first.torsion);
  for (const int degree : {1, 2, 3}) {
    const Motion6 found = end_motion(mesh, degree, through(Vector3(0, push, 0), last.shear_centre));
    EXPECT_NEAR(found[3], turn, tight * std::abs(turn)) << degree;
  }
}

TEST(ShearCentre, RigidMotionsStrainNothing) {
  for (int degree = 2; degree <= 4; ++degree) {
    Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
    mesh.beam_sections = {thin_angle().section, angle_bar(0.3, 0.012, 0.12, 0.014).section};
    mesh.vertices = {{0.3, 0.1, -0.2}, {2, 1, 0.7}};
    examples::add_beams(mesh, mesh.vertices[0], mesh.vertices[1], 0, Vector3::UnitY());
    mesh.beams[0].end_section = 1;
    mesh.beams[0].offset = {Vector3(0, 0.1, 0.2), Vector3(0.05, -0.1, 0.3)};
    const Space space(mesh, {degree, {}});
    const Eigen::MatrixXd k = beam_stiffness(space, 0);
    const Eigen::MatrixXd rigid = test::rigid_motions(space, space.beams()[0].nodes);
    EXPECT_LT((k * rigid).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff()) << degree;
  }
}

// Between ends that hold it against twist and displacement a channel's modes are sines: of the
// shear centre v, of the slope and of the twist, coupled by the mass, which is in the centroid.
// Source: Timoshenko, Young and Weaver (1974), section 5.22, with the beam's shear and the inertia
// of its cross-sections.
TEST(ShearCentre, ChannelBendsAndTwistsAtOnce) {
  const BeamSection s = thin_channel().section;
  const Material m = examples::plain_steel();
  const double length = 2, c = s.shear_centre[1], g = m.shear_modulus();
  std::vector<double> exact_frequencies;
  for (int n = 1; n <= 6; ++n) {
    const double k = n * M_PI / length, sheared = g * s.shear_area_2;
    Eigen::Matrix3d stiffness, mass;
    stiffness << sheared * k * k, -sheared * k, 0, -sheared * k,
        sheared + m.youngs_modulus * s.second_moment_3 * k * k, 0, 0, 0, g * s.torsion * k * k;
    mass << s.area, 0, s.area * c, 0, s.second_moment_3, 0, s.area * c, 0,
        s.second_moment_2 + s.second_moment_3 + s.area * c * c;
    const Eigen::Vector3d squares = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(
                                        stiffness, m.density * mass, Eigen::EigenvaluesOnly)
                                        .eigenvalues();
    for (const double square : squares) exact_frequencies.push_back(std::sqrt(square) / (2 * M_PI));
  }
  std::sort(exact_frequencies.begin(), exact_frequencies.end());
  Mesh mesh = examples::empty_mesh(m, 0.01);
  mesh.beam_sections = {s};
  for (int v = 0; v <= 6; ++v) mesh.vertices.emplace_back(length * v / 6, 0, 0);
  examples::add_beams(mesh, mesh.vertices.front(), mesh.vertices.back(), 0, Vector3::UnitY());
  const Space space(mesh, {4, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3&) { return true; }, {0, 2, 4}, fixed);
  examples::hold(
      space, [&](const Vector3& p) { return p.x() < 1e-9 || p.x() > length - 1e-9; }, {1, 3},
      fixed);
  const NaturalModes modes =
      find_natural_modes(space, find_mass_properties(space, nullptr, nullptr), fixed, 4);
  // Three half-waves, the third, are within 7e-7 by six cells of degree 4.
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(modes.frequencies[i], exact_frequencies[i], 2e-6 * exact_frequencies[i]) << i;
  // Twist about the centroid would have this one.
  const double uncoupled =
      std::sqrt(g * s.torsion / (m.density * (s.second_moment_2 + s.second_moment_3))) /
      (2 * length);
  EXPECT_LT(modes.frequencies[0], 0.85 * uncoupled);
}

// An end that lets twist go bears no torque about the shear centre; about the centroid it does.
TEST(ShearCentre, IsWhatAReleasedEndTwistsAbout) {
  const BeamSection section = thin_angle().section;
  const Eigen::Vector2d c = section.shear_centre;
  for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(0, 0.1, -0.05)}) {
    Mesh mesh = two_in_line(section, Vector3::UnitY(), offset);
    mesh.beams[0].release[1] = {false, false, false, true, false, false};
    const Space space(mesh, {3, {}});
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(space.freedoms());
    loads.segment<6>(6 * space.node_of_vertex(1)) << 700, 1000, 400, 30, 50, -60;
    const Eigen::VectorXd motion = examples::solve(space, loads, clamped(space, {0, span}));
    for (const double xi : {0.0, 0.3, 1.0}) {
      const Eigen::VectorXd forces = beam_forces(space, 0, xi, motion);
      EXPECT_GT(std::abs(forces[3]), 1);
      EXPECT_NEAR(forces[3] + c[1] * forces[1] - c[0] * forces[2], 0, 1e-6) << xi;
    }
  }
}

// A rod bears no shear, wherever it would go through.
TEST(ShearCentre, IsNothingToARod) {
  Mesh mesh = two_in_line(thin_channel().section);
  for (Beam& beam : mesh.beams) beam.is_rod = true;
  const Material m = examples::plain_steel();
  Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
  law(0, 0) = m.youngs_modulus * mesh.beam_sections[0].area;
  law(3, 3) = m.shear_modulus() * mesh.beam_sections[0].torsion;
  for (const BeamGaussPoint& point : beam_gauss_points(Space(mesh, {2, {}}), 0))
    EXPECT_EQ(point.law, law);
}

}  // namespace
}  // namespace blocklift::structure
