// Supports that hold sums of unknowns.
#include "structure/system/held_sums.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/error.h"

namespace blocklift::structure {
namespace {

constexpr int size = 12;

/// A symmetric positive matrix with all entries.
Eigen::MatrixXd sample_stiffness() {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd root =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(generator); });
  return root * root.transpose() + Eigen::MatrixXd::Identity(size, size);
}

SparseLower lower_of(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd lower = matrix.triangularView<Eigen::Lower>();
  return lower.sparseView().cast<double>();
}

/// The saddle-point problem with multipliers, dense, by singular values: rows may say the same.
Eigen::MatrixXd by_multipliers(const Eigen::MatrixXd& stiffness, const std::vector<HeldSum>& sums,
                               const Eigen::MatrixXd& loads) {
  const auto count = static_cast<Eigen::Index>(sums.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size + count, size + count);
  Eigen::MatrixXd right(size + count, loads.cols());
  matrix.topLeftCorner(size, size) = stiffness;
  right.topRows(size) = loads;
  for (Eigen::Index i = 0; i < count; ++i) {
    const HeldSum& sum = sums[i];
    for (const auto& [unknown, coefficient] : sum.coefficients)
      matrix(size + i, unknown) = matrix(unknown, size + i) = coefficient;
    right.row(size + i).setConstant(sum.value);
  }
  return matrix.completeOrthogonalDecomposition().solve(right);
}

// A single unknown, sums that share unknowns, one that follows from two others, and one that holds
// nothing: motions and forces are those of the saddle-point problem, the forces of least squares.
TEST(HeldSystem, IsTheSaddlePointProblem) {
  const Eigen::MatrixXd stiffness = sample_stiffness();
  const std::vector<HeldSum> sums = {{{{3, 1}}, 0.2},
                                     {{{3, 0.6}, {4, 0.8}}, -0.1},
                                     {{{7, 1}, {8, -2}, {4, 0.5}}, 0.3},
                                     {{{3, 1.6}, {4, 0.8}}, 0.1},
                                     {{}, 0}};
  Eigen::MatrixXd loads(size, 2);
  loads << Eigen::VectorXd::LinSpaced(size, -1, 2), Eigen::VectorXd::Zero(size);
  HeldSystem system(lower_of(stiffness), sums);
  system.factorise();
  const Eigen::MatrixXd solution = system.solve(loads);
  const Eigen::MatrixXd expected = by_multipliers(stiffness, sums, loads);
  EXPECT_LT((solution - expected.topRows(size)).norm(), 1e-11 * expected.norm());
  for (const HeldSum& sum : sums) {
    Eigen::RowVectorXd held = Eigen::RowVectorXd::Zero(2);
    for (const auto& [unknown, coefficient] : sum.coefficients)
      held += coefficient * solution.row(unknown);
    EXPECT_NEAR(held[0], sum.value, 1e-12);
    EXPECT_NEAR(held[1], sum.value, 1e-12);
  }
  // The multipliers pull at the sums: their sign is a reaction's.
  const Eigen::MatrixXd reactions = system.reactions(solution, loads);
  EXPECT_LT((reactions + expected.bottomRows(5)).norm(), 1e-9 * expected.norm());
  const Eigen::VectorXd one = solution.col(0);
  EXPECT_NEAR(system.energy(one), 0.5 * one.dot(stiffness * one), 1e-12 * one.squaredNorm());
}

TEST(HeldSystem, RefusesSumsThatContradict) {
  const std::vector<HeldSum> sums = {{{{0, 1}, {1, 1}}, 1}, {{{0, 2}, {1, 2}}, 1}};
  EXPECT_THROW(HeldSystem(lower_of(sample_stiffness()), sums), ModelError);
}

// Two masses on a spring: a sum that holds their difference leaves them free to move together.
TEST(HeldSystem, TellsThatAMechanismIsLeft) {
  Eigen::MatrixXd stiffness(3, 3);
  stiffness << 1, -1, 0, -1, 1, 0, 0, 0, 1;
  HeldSystem loose(lower_of(stiffness), {{{{0, 1}, {1, -1}}, 0}});
  EXPECT_THROW(loose.factorise(), LooseUnknown);
  HeldSystem held(lower_of(stiffness), {{{{0, 1}, {1, 1}}, 0}});
  EXPECT_NO_THROW(held.factorise());
}

}  // namespace
}  // namespace blocklift::structure
