// Stress in beams, their ends released or not.
#include "structure/stress/beam_stress.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/formulation/beam.h"
#include "structure/mesh/beams/sections.h"
#include "structure/stress/stress_points.h"
#include "tests/structure/motions.h"

namespace blocklift::structure {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;

constexpr double length = 2, width = 0.02, height = 0.1;

/// Bar along x of a rectangular section, axis 2 upwards.
Mesh bar() {
  Mesh mesh;
  mesh.materials = {examples::plain_steel()};
  mesh.groups = {{"bar", 0}};
  mesh.regions = {{"bar", 0, false}};
  mesh.vertices = {Vector3::Zero(), Vector3(length, 0, 0)};
  BeamSection section;
  section.area = width * height;
  section.second_moment_2 = height * std::pow(width, 3) / 12;
  section.second_moment_3 = width * std::pow(height, 3) / 12;
  section.torsion = height * std::pow(width, 3) / 3;
  section.shear_area_2 = section.shear_area_3 = std::numeric_limits<double>::infinity();
  mesh.beam_sections = {section};
  Beam beam;
  beam.vertices = {0, 1};
  mesh.beams = {beam};
  return mesh;
}

/// Of beam_stresses' rows those along the beam, and the shear stresses.
Eigen::VectorXd along(const Eigen::MatrixXd& stresses) {
  return stresses.col(0)(Eigen::seqN(0, stresses.rows() / 6, 6));
}
Eigen::VectorXd across(const Eigen::MatrixXd& stresses) {
  return stresses.col(0)(Eigen::seqN(3, stresses.rows() / 6, 6));
}

// Uniform bending about an axis off the nodes: u_z = k x^2 / 2, theta_y = -k x; the stress at the
// height z over the nodes is E (s - k z).
TEST(BeamStress, BendingAndStretchAreNaviers) {
  Mesh mesh = bar();
  const double offset = 0.07, stretch = 1e-4, curvature = 3e-3;
  mesh.beams[0].offset = {Vector3(0, 0, offset), Vector3(0, 0, offset)};
  const Space space(mesh, {3, {}});
  const Eigen::VectorXd motion = test::motion_of(space, [&](const Vector3& p) {
    Motion6 m;
    m << stretch * p.x(), 0, curvature * p.x() * p.x() / 2, 0, -curvature * p.x(), 0;
    return m;
  });
  const double e = mesh.materials[0].youngs_modulus;
  // The section states no points: those of the rectangle with its moments, which it is.
  const auto points = stress_points(mesh.beam_sections[0]);
  ASSERT_EQ(points.size(), 4U);
  const Eigen::MatrixXd all = beam_stresses(space, 0, 0.3, motion);
  const Eigen::VectorXd found = along(all);  // these points come first
  EXPECT_LT(across(all).cwiseAbs().maxCoeff(), 1e-8 * e * curvature);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(std::abs(points[p].x()), height / 2, 1e-15);
    const double z = offset + points[p].x();
    EXPECT_NEAR(found[p], e * (stretch - curvature * z), 1e-8 * e * curvature);
  }
  EXPECT_NEAR(beam_stress_at_centroid(space, 0, 0.3, motion)[0], e * (stretch - curvature * offset),
              1e-8 * e * curvature);
  const BeamMotion moved = beam_motion_at(space, 0, 0.5, motion);
  EXPECT_LT((moved.displacement - Vector3(stretch - curvature * offset, 0, curvature / 2)).norm(),
            1e-14);
}

// One end sinks by d with its turning released: M = 3 E I d / L^2 at the other end, none at this
// one. (Stiff in shear to 1e-4 of a bar's bending of this slenderness.)
TEST(BeamStress, ReleasedEndBearsNoMoment) {
  Mesh mesh = bar();
  mesh.beams[0].release[1] = {false, false, false, false, true, true};
  const Space space(mesh, {3, {}});
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(space.freedoms());
  const double sinking = 0.01;
  const BeamCell& cell = space.beams()[0];
  // Ends as given, nodes between where no force acts on them.
  const Eigen::MatrixXd stiffness = beam_stiffness(space, 0);
  const Eigen::Index size = stiffness.rows(), inner = size - 12;
  Eigen::VectorXd local = Eigen::VectorXd::Zero(size);
  local[size - 6 + 2] = -sinking;
  local[size - 6 + 4] = 0.3;  // the neighbour turns as it likes
  local.segment(6, inner) =
      -stiffness.block(6, 6, inner, inner).ldlt().solve(stiffness.middleRows(6, inner) * local);
  for (std::size_t i = 0; i < cell.nodes.size(); ++i)
    motion.segment<6>(6 * cell.nodes[i]) = local.segment<6>(6 * static_cast<Eigen::Index>(i));
  const double e = mesh.materials[0].youngs_modulus;
  const double expected = 3 * e * sinking / (length * length) * height / 2;
  const auto largest = [&](double xi) {
    return along(beam_stresses(space, 0, xi, motion)).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(largest(0), expected, 1e-3 * expected);
  EXPECT_LT(largest(1), 1e-3 * expected);
}

TEST(BeamStress, RodHasNoBending) {
  Mesh mesh = bar();
  mesh.beams[0].is_rod = true;
  const Space space(mesh, {2, {}});
  const Eigen::VectorXd motion = test::motion_of(space, [&](const Vector3& p) {
    Motion6 m;
    m << 1e-4 * p.x(), 0, 0, 0, -0.1 * p.x(), 0;
    return m;
  });
  const Eigen::MatrixXd found = beam_stresses(space, 0, 0.5, motion);
  ASSERT_EQ(found.rows(), 6);  // one stress all over the section
  EXPECT_NEAR(found(0, 0), 1e-4 * mesh.materials[0].youngs_modulus, 1);
  EXPECT_EQ(found(3, 0), 0);
}

/// A twist of `rate` rad/m.
Eigen::VectorXd twisted(const Space& space, double rate) {
  return test::motion_of(space, [&](const Vector3& p) {
    Motion6 m = Motion6::Zero();
    m[3] = rate * p.x();
    return m;
  });
}

// T r / J of a round bar; von Mises is the square root of three times it: 408 MPa of 60 mm under
// 10 kN m. A rod bears it, too.
TEST(BeamStress, TwistedRoundBar) {
  Mesh mesh = bar();
  mesh.beam_sections = {solid_circle(0.03).section};
  const BeamSection& section = mesh.beam_sections[0];
  const double torque = 1e4, rate = torque / (mesh.materials[0].shear_modulus() * section.torsion);
  const double expected = std::sqrt(3.0) * torque * 0.03 / section.torsion;
  for (const bool is_rod : {false, true}) {
    mesh.beams[0].is_rod = is_rod;
    const Space space(mesh, {2, {}});
    const Eigen::MatrixXd found = beam_stresses(space, 0, 0.7, twisted(space, rate));
    EXPECT_NEAR(largest_von_mises(found), expected, 1e-9 * expected);
    EXPECT_NEAR(expected, 408.4e6, 0.1e6);
  }
}

// Of a tapered pipe torsion's stress is T r / J at both ends, as J says there.
TEST(BeamStress, TwistedTaper) {
  Mesh mesh = bar();
  mesh.beam_sections = {pipe(0.1, 0.09).section, pipe(0.06, 0.05).section};
  mesh.beams[0].end_section = 1;
  for (const double share : {0.0, 1.0}) {
    const BeamSection& own = mesh.beam_sections[share > 0 ? 1 : 0];
    const std::vector<SectionPoint> points = points_of_beam(mesh, mesh.beams[0], share);
    ASSERT_EQ(points.size(), own.shear_points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      EXPECT_NEAR(points[p].of_torsion, own.shear_points[p].of_torsion,
                  1e-12 * own.shear_points[p].of_torsion);
      EXPECT_LT((points[p].of_force - own.shear_points[p].of_force).norm(), 1e-9);
    }
  }
  // Between them the radius over J, both linear.
  const double torsion = (mesh.beam_sections[0].torsion + mesh.beam_sections[1].torsion) / 2;
  EXPECT_NEAR(points_of_beam(mesh, mesh.beams[0], 0.5).front().of_torsion, 0.08 / torsion,
              1e-9 / torsion);
}

// By figures alone a section has fewer points where it does not resist torsion. Where a taper ends
// in such a one, each place along it has its own number of them.
TEST(BeamStress, TaperWhoseTorsionConstantVanishes) {
  Mesh mesh = bar();
  mesh.beam_sections.push_back(mesh.beam_sections[0]);
  mesh.beam_sections[1].torsion = 0;
  mesh.beams[0].end_section = 1;
  const Space space(mesh, {2, {}});
  const StressPoints points(space);
  int expected = 0;
  for (const double share : {0.0, 0.5, 1.0})
    expected += static_cast<int>(points_of_beam(mesh, mesh.beams[0], share).size());
  ASSERT_LT(points_of_beam(mesh, mesh.beams[0], 1).size(),
            points_of_beam(mesh, mesh.beams[0], 0).size());
  ASSERT_EQ(points.count(), expected);
  const Eigen::VectorXd stretched = test::motion_of(space, [](const Vector3& p) {
    Motion6 m = Motion6::Zero();
    m[0] = 1e-3 * p.x();
    return m;
  });
  const double due = 1e-3 * mesh.materials[0].youngs_modulus;
  const Eigen::VectorXd found = along(points.stresses(0, points.count(), stretched));
  EXPECT_LT((found.array() - due).abs().maxCoeff(), 1e-6 * due);
}

// A force through the shear centre of a channel makes a moment about the centroid, which does not
// twist it.
TEST(BeamStress, ForceThroughTheShearCentreTwistsNothing) {
  const BeamSection section = channel(0.2, 0.0085, 0.08, 0.0115).section;
  const Eigen::Vector2d centre = section.shear_centre, force(3, 5);
  ASSERT_GT(centre.norm(), 0.01);
  Motion6 forces = Motion6::Zero();
  forces[1] = force[0];
  forces[2] = force[1];
  forces[3] = centre[0] * force[1] - centre[1] * force[0];
  EXPECT_NEAR(torsion_about_twist_centre(section, forces)[0], 0, 1e-15);
  forces[3] += 7;
  EXPECT_NEAR(torsion_about_twist_centre(section, forces)[0], 7, 1e-12);
}

}  // namespace
}  // namespace blocklift::structure
