#include "algebra/cholesky_steps.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/algebra/some_matrix.h"

namespace blocklift::algebra {
namespace {

constexpr double rounding_of_steps = 1e-11;  // conditions are below 1000

// In blocks of a larger matrix, as a factorisation by blocks has them.
TEST(CholeskySteps, FactoriseABlock) {
  const Eigen::MatrixXd A = test::some_positive(7);
  Eigen::MatrixXd around = Eigen::MatrixXd::Constant(9, 9, 5);
  around.block(1, 1, 7, 7) = A;
  EXPECT_EQ(factorise_in_place(around.block(1, 1, 7, 7)), 7);
  const Eigen::MatrixXd L = around.block(1, 1, 7, 7).triangularView<Eigen::Lower>();
  EXPECT_LT((L * L.transpose() - A).norm(), rounding_of_steps);
  EXPECT_EQ(around(2, 3), A(1, 2));  // the upper half stays
  EXPECT_EQ(around(0, 0), 5);
}

TEST(CholeskySteps, NameTheFirstPivotThatIsNotPositive) {
  Eigen::MatrixXd A = test::some_positive(7);
  A(4, 4) = A(5, 5) = -1;
  EXPECT_EQ(factorise_in_place(A), 4);
}

TEST(CholeskySteps, DivideByWhatTheyFactorised) {
  const Eigen::MatrixXd L =
      test::some_positive(5).llt().matrixL().toDenseMatrix() + Eigen::MatrixXd::Identity(5, 5);
  const Eigen::MatrixXd B = test::some_matrix(5, 3);
  Eigen::MatrixXd X = B;
  divide_by_lower(L, X);
  EXPECT_LT((L * X - B).norm(), rounding_of_steps);
  X = B;
  divide_by_upper(L, X);
  EXPECT_LT((L.transpose() * X - B).norm(), rounding_of_steps);
  Eigen::MatrixXd Y = B.transpose();
  divide_by_upper_from_right(L, Y);
  EXPECT_LT((Y * L.transpose() - B.transpose()).norm(), rounding_of_steps);
}

TEST(CholeskySteps, MultiplyAndSubtract) {
  const Eigen::MatrixXd A = test::some_matrix(6, 4), B = test::some_matrix(3, 4),
                        start = test::some_matrix(6, 3);
  Eigen::MatrixXd C(6, 3);
  multiply_by_transposed(A, B, C);
  EXPECT_LT((C - A * B.transpose()).norm(), rounding_of_steps);
  C = start;
  subtract_by_transposed(A, B, C);
  EXPECT_LT((C - (start - A * B.transpose())).norm(), rounding_of_steps);
  Eigen::MatrixXd D = B.transpose();
  subtract_transposed_by(A, start, D);
  EXPECT_LT((D - (B.transpose() - A.transpose() * start)).norm(), rounding_of_steps);
}

}  // namespace
}  // namespace blocklift::algebra
