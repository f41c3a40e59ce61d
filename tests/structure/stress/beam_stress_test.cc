// Stress in beams, their ends released or not.
#include "structure/stress/beam_stress.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/formulation/beam.h"
#include "tests/structure/motions.h"

namespace blocklift::structure {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;

constexpr double length = 2, width = 0.02, height = 0.1;

/// Bar along x of a rectangular section, axis 2 upwards.
Mesh bar() {
  Mesh mesh;
  mesh.materials = {testing::plain_steel()};
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

// Uniform bending about an axis off the nodes: u_z = k x^2 / 2, theta_y = -k x; the stress at the
// height z over the nodes is E (s - k z).
TEST(BeamStress, BendingAndStretchAreNaviers) {
  Mesh mesh = bar();
  const double offset = 0.07, stretch = 1e-4, curvature = 3e-3;
  mesh.beams[0].offset = {Vector3(0, 0, offset), Vector3(0, 0, offset)};
  const Space space(mesh, {3, {}});
  const Eigen::VectorXd motion = testing::motion_of(space, [&](const Vector3& p) {
    Motion6 m;
    m << stretch * p.x(), 0, curvature * p.x() * p.x() / 2, 0, -curvature * p.x(), 0;
    return m;
  });
  const double e = mesh.materials[0].youngs_modulus;
  // The section states no points: those of the rectangle with its moments, which it is.
  const auto points = stress_points(mesh.beam_sections[0]);
  ASSERT_EQ(points.size(), 4U);
  const Eigen::VectorXd found = beam_stresses(space, 0, 0.3, motion);
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
  EXPECT_NEAR(beam_stresses(space, 0, 0, motion).cwiseAbs().maxCoeff(), expected, 1e-3 * expected);
  EXPECT_LT(beam_stresses(space, 0, 1, motion).cwiseAbs().maxCoeff(), 1e-3 * expected);
}

TEST(BeamStress, RodHasNoBending) {
  Mesh mesh = bar();
  mesh.beams[0].is_rod = true;
  const Space space(mesh, {2, {}});
  const Eigen::VectorXd motion = testing::motion_of(space, [&](const Vector3& p) {
    Motion6 m;
    m << 1e-4 * p.x(), 0, 0, 0, -0.1 * p.x(), 0;
    return m;
  });
  const Eigen::VectorXd found = beam_stresses(space, 0, 0.5, motion);
  for (const double stress : found) EXPECT_NEAR(stress, 1e-4 * mesh.materials[0].youngs_modulus, 1);
}

}  // namespace
}  // namespace blocklift::structure
