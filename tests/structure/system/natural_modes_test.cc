// Natural modes: structures whose frequencies stand in closed form, and a dense solver.
#include "structure/system/natural_modes.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/system/assembly.h"
#include "structure/system/matter.h"

namespace blocklift::structure {
namespace {

Mesh plate(int m, int n, double length, double width) {
  return examples::sheet_mesh(
      [=](double x, double y) { return Vector3(length * x, width * y, 0.1 * x * y); }, m, n, 0.05,
      examples::plain_steel());
}

NaturalModes modes_of(const Space& space, const std::vector<FixedUnknown>& fixed, int count) {
  return find_natural_modes(space, find_mass_properties(space, nullptr, nullptr), fixed, count);
}

// Against LAPACK's dense solver on the same matrices, by 1 / omega^2, as rotations about the normal
// have no mass: M phi = mu (K + s M) phi.
TEST(NaturalModes, AgreeWithADenseSolver) {
  const Mesh mesh = plate(3, 1, 2, 0.7);
  const Space space(mesh, {2, {}});
  const MassProperties mass = find_mass_properties(space, nullptr, nullptr);
  const auto dense = [&](const SparseLower& matrix) -> Eigen::MatrixXd {
    return matrix.selfadjointView<Eigen::Lower>() *
           Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
  };
  const Eigen::MatrixXd k = dense(assemble_stiffness(space)),
                        m = dense(mass_of_unknowns(space, mass));
  const NaturalModes free = modes_of(space, {}, 14);
  const double shift = 0.1 * free.squared_frequencies[6];
  const Eigen::VectorXd inverse =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(m, k + shift * m).eigenvalues();
  const Eigen::VectorXd exact =
      (inverse.reverse().head(14).cwiseInverse().array() - shift).matrix();
  EXPECT_EQ(free.rigid_motions, 6);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(free.frequencies[i], 0);
    EXPECT_LT(std::abs(free.squared_frequencies[i]), 1e-6 * free.squared_frequencies[6]);
  }
  for (int i = 6; i < 14; ++i)
    EXPECT_NEAR(free.squared_frequencies[i], exact[i], 1e-7 * exact[i]) << i;
  EXPECT_LT(free.residual, 1e-7);
  EXPECT_LT((free.shapes.transpose() * m * free.shapes - Eigen::MatrixXd::Identity(14, 14)).norm(),
            1e-8);
}

// A square pipe's cantilever bends alike in two planes.
TEST(NaturalModes, CopiesOfARepeatedFrequencyAreFound) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  BeamSection section;
  section.area = 1e-2;
  section.second_moment_2 = section.second_moment_3 = 1e-5;
  section.torsion = 2e-5;
  section.shear_area_2 = section.shear_area_3 = 5e-3;
  mesh.beam_sections = {section};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  examples::add_beams(mesh, {0, 0, 0}, {3, 0, 0}, 0, Vector3::UnitY());
  const Space space(mesh, {4, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& x) { return x.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
  const NaturalModes modes = modes_of(space, fixed, 4);
  for (const int pair : {0, 2})
    EXPECT_NEAR(modes.frequencies[pair + 1], modes.frequencies[pair],
                1e-6 * modes.frequencies[pair]);
  // Bernoulli's first, 1.8751^2 / (2 pi l^2) sqrt(E I / rho A), less shear and rotatory inertia of
  // some
  // (r / l)^2 = 1e-4 times 10.
  const double bernoulli =
      1.87510 * 1.87510 / (2 * M_PI * 9) * std::sqrt(210e9 * 1e-5 / (7850 * 1e-2));
  EXPECT_NEAR(modes.frequencies[0], bernoulli, 2e-3 * bernoulli);
}

// With three times a beam's own mass hung along it each frequency is half of what it was.
TEST(NaturalModes, MassBeyondTheSectionSlowsABeam) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  BeamSection section;
  section.area = 1e-2;
  section.second_moment_2 = 1e-5;
  section.second_moment_3 = 2e-5;
  section.torsion = 2e-5;
  section.shear_area_2 = section.shear_area_3 = 5e-3;
  mesh.beam_sections = {section};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  examples::add_beams(mesh, {0, 0, 0}, {3, 0, 0}, 0, Vector3::UnitY());
  const auto modes = [&] {
    const Space space(mesh, {4, {}});
    std::vector<FixedUnknown> fixed;
    examples::hold(
        space, [](const Vector3& x) { return x.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
    return modes_of(space, fixed, 4);
  };
  const NaturalModes bare = modes();
  mesh.beam_sections[0].mass_per_length = 3 * 7850 * 1e-2;
  const NaturalModes heavy = modes();
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(heavy.frequencies[i], bare.frequencies[i] / 2, 1e-6 * bare.frequencies[i]) << i;
  // Bernoulli's first with rho A + m, less shear and rotatory inertia.
  const double bernoulli =
      1.87510 * 1.87510 / (2 * M_PI * 9) * std::sqrt(210e9 * 1e-5 / (4 * 7850 * 1e-2));
  EXPECT_NEAR(heavy.frequencies[0], bernoulli, 2e-3 * bernoulli);
}

// A free strip that cannot bend: f_n = n c / 2 L, c = sqrt(E / rho) without contraction.
TEST(NaturalModes, FreeBarRingsInWholeMultiples) {
  Material bar = examples::plain_steel();
  bar.poisson_ratio = 0;
  const Mesh mesh = examples::sheet_mesh(
      [](double x, double y) { return Vector3(3 * x, 0.1 * y, 0); }, 6, 1, 0.05, bar);
  const Space space(mesh, {3, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3&) { return true; }, {1, 2, 3, 4, 5}, fixed);
  const NaturalModes modes = modes_of(space, fixed, 4);
  const double first = std::sqrt(210e9 / 7850) / 6;
  EXPECT_LT(modes.frequencies[0], 1e-4 * first);
  for (int n = 1; n < 4; ++n) EXPECT_NEAR(modes.frequencies[n], n * first, 1e-4 * n * first);
}

TEST(NaturalModes, WhatCannotBeFoundIsRefused) {
  const Mesh mesh = plate(1, 1, 1, 1);
  const Space space(mesh, {1, {}});
  EXPECT_THROW(modes_of(space, {}, 25), ModelError);
  EXPECT_THROW(modes_of(space, {}, 0), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
