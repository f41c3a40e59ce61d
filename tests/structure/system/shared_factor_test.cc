// Shares of a factorisation, held together in one process; blocklift stress has them in several.
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/space/elimination.h"
#include "structure/system/factor_part.h"
#include "structure/system/linear_solver.h"
#include "structure/system/subtrees.h"

namespace blocklift::structure {
namespace {

constexpr int side = 12, count = side * side;

/// Squares of a grid, each with a positive definite matrix of its four nodes: numbers by nested
/// dissection.
Eigen::MatrixXd grid_stiffness() {
  std::vector<std::vector<int>> squares;
  for (int i = 0; i + 1 < side; ++i)
    for (int j = 0; j + 1 < side; ++j)
      squares.push_back(
          {side * i + j, side * i + j + 1, side * (i + 1) + j, side * (i + 1) + j + 1});
  const Elimination elimination = find_elimination(count, squares);
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
  for (const std::vector<int>& square : squares) {
    const Eigen::Matrix4d root = Eigen::Matrix4d::NullaryExpr([&] { return normal(generator); });
    const Eigen::Matrix4d matrix = root * root.transpose() + 0.1 * Eigen::Matrix4d::Identity();
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        stiffness(elimination.place[square[a]], elimination.place[square[b]]) += matrix(a, b);
  }
  return stiffness;
}

SparseLower lower_part(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd lower = matrix.triangularView<Eigen::Lower>();
  return lower.sparseView().cast<double>();
}

std::vector<int> unknowns_of(const std::vector<int>& process_of, int process) {
  std::vector<int> unknowns;
  for (int u = 0; u < count; ++u)
    if (process_of[u] == process) unknowns.push_back(u);
  return unknowns;
}

class SharesOfAFactor : public ::testing::TestWithParam<int> {
 protected:
  const Eigen::MatrixXd stiffness_ = grid_stiffness();
  const std::vector<int> process_of_ =
      deal_out_subtrees(CholeskyFactor(lower_part(stiffness_)).supernodes(), GetParam());
  const std::vector<int> interface_ = unknowns_of(process_of_, -1);
};

TEST_P(SharesOfAFactor, DoNotKnowOfEachOther) {
  ASSERT_EQ(process_of_.size(), count);
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < a; ++b)
      if (process_of_[a] >= 0 && process_of_[b] >= 0 && process_of_[a] != process_of_[b]) {
        EXPECT_EQ(stiffness_(a, b), 0);
      }
  for (int process = 0; process < GetParam(); ++process)
    EXPECT_GT(unknowns_of(process_of_, process).size(), count / (3 * GetParam()));
}

// Against the same from dense matrices. Rounding: unit roundoff times the condition, 1e3.
TEST_P(SharesOfAFactor, TakeFromTheInterfaceWhatTheyFollowItBy) {
  constexpr double tolerance = 1e-12;
  for (int process = 0; process < GetParam(); ++process) {
    const std::vector<int> inner = unknowns_of(process_of_, process);
    std::vector<int> all = inner;
    all.insert(all.end(), interface_.begin(), interface_.end());
    FactorPart part({lower_part(stiffness_(all, all)), static_cast<int>(inner.size())});
    EXPECT_GT(part.bytes(), 0);
    const Eigen::MatrixXd K = stiffness_(inner, inner), B = stiffness_(interface_, inner);
    const Eigen::MatrixXd follows = K.ldlt().solve(B.transpose());
    const Eigen::MatrixXd expected = -(B * follows);
    const Eigen::MatrixXd taken = part.eliminate();
    const double scale = stiffness_.cwiseAbs().maxCoeff();
    const Eigen::MatrixXd off = (taken - expected).triangularView<Eigen::Lower>();
    EXPECT_LT(off.norm(), tolerance * scale);

    const Eigen::MatrixXd loads = Eigen::MatrixXd::Random(K.cols(), 3);
    const Eigen::MatrixXd given = Eigen::MatrixXd::Random(B.rows(), 3);
    EXPECT_LT((part.forward(loads) + B * K.ldlt().solve(loads)).norm(), tolerance * scale);
    EXPECT_LT((part.backward(given) - (K.ldlt().solve(loads) - follows * given)).norm(),
              tolerance * scale);
  }
}

// A mechanism: a part that nothing resists is found by its number.
TEST_P(SharesOfAFactor, SayWhatNothingResists) {
  const std::vector<int> inner = unknowns_of(process_of_, 0);
  Eigen::MatrixXd matrix = stiffness_(inner, inner);
  matrix.row(3).setZero();
  matrix.col(3).setZero();
  matrix(3, 3) = -1;
  FactorPart part({lower_part(matrix), static_cast<int>(inner.size())});
  try {
    part.eliminate();
    ADD_FAILURE();
  } catch (const LooseUnknown& loose) {
    EXPECT_EQ(loose.unknown, 3);
  }
}

INSTANTIATE_TEST_SUITE_P(Processes, SharesOfAFactor, ::testing::Values(2, 3));

}  // namespace
}  // namespace blocklift::structure
