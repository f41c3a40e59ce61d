// Natural modes: bodies whose frequencies stand in closed form.
#include "structure/elasticity/natural_modes.h"

#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/box_mesh.h"
#include "structure/error.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

const Material bar{"bar", 200e9, 0, 8000, 250e6};  // no contraction: stretching is one-dimensional

Eigen::VectorXd all_values(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(a, b).eigenvalues();
}

// Against LAPACK's dense solver on the same matrices: free, and held at one end.
TEST(NaturalModes, AgreeWithADenseSolver) {
  const ElasticModel model(testing::box_mesh({4, 2, 1}, Vector3(2, 0.7, 0.1), bar), 2);
  const SparseLower stiffness = assemble_stiffness(model.mesh(), model.space(), 1);
  const NodalMass mass = block_mass_matrix(model);
  Eigen::MatrixXd k = stiffness.selfadjointView<Eigen::Lower>() *
                      Eigen::MatrixXd::Identity(stiffness.rows(), stiffness.cols());
  Eigen::MatrixXd m = mass_times(mass, Eigen::MatrixXd::Identity(k.rows(), k.cols()));
  EXPECT_NEAR(
      mass.selfadjointView<Eigen::Lower>().operator*(Eigen::VectorXd::Ones(mass.rows())).sum(),
      8000 * 2 * 0.7 * 0.1, 1e-9 * 1120);
  const NaturalModes free = find_block_modes(model, 14);
  const Eigen::VectorXd exact = all_values(k, m);
  EXPECT_EQ(free.rigid_motions, 6);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(free.frequencies[i], 0);
    EXPECT_LT(std::abs(free.squared_frequencies[i]), 1e-7 * free.squared_frequencies[6]);
  }
  for (int i = 6; i < 14; ++i)
    EXPECT_NEAR(free.squared_frequencies[i], exact[i], 1e-8 * exact[i]) << i;
  EXPECT_LT(free.residual, 1e-8);
  EXPECT_LT((free.shapes.transpose() * m * free.shapes - Eigen::MatrixXd::Identity(14, 14)).norm(),
            1e-9);

  std::vector<FixedUnknown> fixed;
  std::vector<int> moving;
  for (int n = 0; n < model.space().node_count(); ++n)
    for (int a = 0; a < 3; ++a) {
      if (model.space().nodes(0, n) < 1e-9)
        fixed.push_back({3 * n + a, 0});
      else
        moving.push_back(3 * n + a);
    }
  const NaturalModes held = find_block_modes(model, 5, fixed);
  const Eigen::VectorXd exact_held = all_values(k(moving, moving), m(moving, moving));
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(held.squared_frequencies[i], exact_held[i], 1e-8 * exact_held[i]) << i;
  for (const FixedUnknown& unknown : fixed) EXPECT_EQ(held.shapes.row(unknown.unknown).norm(), 0);
}

// A shell of plates, soft beside the stretching and bending of its whole: none of its six rigid motions,
// which have one frequency, is missed, and so no elastic mode is taken for one.
TEST(NaturalModes, AllRigidMotionsOfASoftBodyAreFound) {
  const ElasticModel model = make_elastic_model(testing::small_block(), 1);
  const NaturalModes modes = find_block_modes(model, 8);
  EXPECT_LT(modes.squared_frequencies.head(6).cwiseAbs().maxCoeff(),
            1e-5 * modes.squared_frequencies[6]);
  EXPECT_GT(modes.frequencies[6], 0.1);
}

TEST(NaturalModes, CopiesOfARepeatedFrequencyAreFound) {
  const Material soft{"soft", 1e9, 0, 8000, 250e6};
  const ElasticModel model(testing::box_mesh({4, 1, 1}, Vector3(2, 0.1, 0.1), soft), 2);
  std::vector<FixedUnknown> fixed;  // a square bar, held at one end, bends alike in two planes
  for (int n = 0; n < model.space().node_count(); ++n)
    for (int a = 0; a < 3; ++a)
      if (model.space().nodes(0, n) < 1e-9) fixed.push_back({3 * n + a, 0});
  const NaturalModes modes = find_block_modes(model, 4, fixed);
  for (const int pair : {0, 2})
    EXPECT_NEAR(modes.frequencies[pair + 1], modes.frequencies[pair],
                1e-6 * modes.frequencies[pair]);
}

// A free bar that cannot bend (held across): f_n = n c / (2 L), c = sqrt(E / rho).
TEST(NaturalModes, FreeBarRingsInWholeMultiples) {
  const ElasticModel model(testing::box_mesh({6, 1, 1}, Vector3(3, 0.1, 0.1), bar), 3);
  std::vector<FixedUnknown> fixed;
  for (int n = 0; n < model.space().node_count(); ++n)
    for (int a = 1; a < 3; ++a) fixed.push_back({3 * n + a, 0});
  const NaturalModes modes = find_block_modes(model, 4, fixed);
  const double first = std::sqrt(200e9 / 8000) / 6;
  EXPECT_LT(modes.frequencies[0], 1e-5 * first);
  for (int n = 1; n < 4; ++n) EXPECT_NEAR(modes.frequencies[n], n * first, 1e-4 * n * first);
}

TEST(NaturalModes, WhatCannotBeFoundIsRefused) {
  const ElasticModel model(testing::box_mesh({1, 1, 1}, Vector3(1, 1, 1), bar), 1);
  EXPECT_THROW(find_block_modes(model, 25), ModelError);
  EXPECT_THROW(find_block_modes(model, 0), ModelError);
  EXPECT_EQ(find_block_modes(model, 24).frequencies.size(), 24);
}

}  // namespace
}  // namespace blocklift::structure
