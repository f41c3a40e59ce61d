#include "algebra/decompositions.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/algebra/some_matrix.h"

namespace blocklift::algebra {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::some_matrix;
using test::some_positive;

constexpr double rounding = std::numeric_limits<double>::epsilon();

template <int size>
void expect_eigensystem() {
  const SquareMatrix<size> A = some_positive(size == Eigen::Dynamic ? 9 : size);
  const auto [values, vectors] = symmetric_eigensystem<size>(A);
  const Eigen::Index n = A.rows();
  EXPECT_LT((A * vectors - vectors * values.asDiagonal()).norm(), 100 * rounding * A.norm());
  EXPECT_LT((vectors.transpose() * vectors - MatrixXd::Identity(n, n)).norm(), 100 * rounding);
  for (Eigen::Index i = 1; i < n; ++i) EXPECT_LE(values[i - 1], values[i]);
  EXPECT_LT((symmetric_eigenvalues<size>(A) - values).norm(), 100 * rounding * A.norm());
}

TEST(Decompositions, EigenvectorsSatisfyTheirEquation) {
  expect_eigensystem<2>();
  expect_eigensystem<3>();
  expect_eigensystem<Eigen::Dynamic>();
}

TEST(Decompositions, EigenvaluesReadTheLowerHalf) {
  SquareMatrix<6> A = some_positive(6);
  const ColumnVector<6> whole = symmetric_eigenvalues(A);
  EXPECT_NEAR(whole.sum(), A.trace(), 100 * rounding * A.norm());
  A(0, 5) = 1e3;
  EXPECT_EQ(symmetric_eigenvalues(A), whole);
}

TEST(Decompositions, SolutionsSatisfyTheirEquations) {
  const double small = 1e5 * rounding;  // conditions are below 1000
  const auto symmetric = [&]<int size>() {
    const SquareMatrix<size> A = some_positive(size);
    const ColumnVector<size> b = some_matrix(size, 1);
    EXPECT_LT((A * solve_symmetric(A, b) - b).norm(), small);
  };
  symmetric.operator()<2>();
  symmetric.operator()<3>();
  symmetric.operator()<4>();
  symmetric.operator()<5>();
  const MatrixXd A = some_positive(6), B = some_matrix(6, 2);
  EXPECT_LT((A * solve_symmetric(A, VectorXd(B.col(0))) - B.col(0)).norm(), small);
  EXPECT_LT((A * solve_positive_definite(A, B) - B).norm(), small);
  MatrixXd root = A;
  VectorXd x = B.col(0);
  solve_positive_definite_in_place(root, x);
  EXPECT_LT((A * x - B.col(0)).norm(), small);
  EXPECT_LT((A * solve_by_full_pivoting(A, B) - B).norm(), small);
  EXPECT_LT((A * inverse_of(A) - MatrixXd::Identity(6, 6)).norm(), small);
  EXPECT_LT((A * inverse_of<6>(A) - MatrixXd::Identity(6, 6)).norm(), small);
  const Eigen::Matrix3d C = some_matrix(3, 3);
  const Eigen::Vector3d d = some_matrix(3, 1);
  EXPECT_LT((C * solve_square(C, d) - d).norm(), small);
}

TEST(Decompositions, ASingularSystemHasNoNumbers) {
  const Eigen::Matrix3d singular = Eigen::Vector3d(1, 2, 3) * Eigen::RowVector3d(1, 0, 0);
  EXPECT_FALSE(solve_square(singular, Eigen::Vector3d(1, 0, 0)).allFinite());
}

TEST(Decompositions, LeastSquaresLeaveWhatIsAcrossAndAreShortest) {
  MatrixXd A = some_matrix(7, 4);
  A.col(3) = A.col(0) - 2 * A.col(1);  // of rank three
  const MatrixXd B = some_matrix(7, 2), X = least_squares(A, B);
  EXPECT_LT((A.transpose() * (A * X - B)).norm(), 1e-13);
  const Eigen::Vector4d nothing(1, -2, 0, -1);  // A times this is zero
  EXPECT_LT((nothing.transpose() * X).norm(), 1e-13);
  EXPECT_LT((pseudo_inverse(A) * B - X).norm(), 1e-12);
}

TEST(Decompositions, SmallSingularValuesAreLeftOutBelowTheThreshold) {
  const Eigen::Matrix2d A = Eigen::Vector2d(1, 1e-3).asDiagonal();
  const Eigen::Vector2d b(2, 1);
  EXPECT_LT((least_squares(A, b, 1e-4) - Eigen::Vector2d(2, 1000)).norm(), 1e-10);
  EXPECT_LT((least_squares(A, b, 0.1) - Eigen::Vector2d(2, 0)).norm(), 1e-14);
}

TEST(Decompositions, SmallPivotsAreLeftOutBelowTheThreshold) {
  const Eigen::Matrix2d A = Eigen::Vector2d(1, 1e-3).asDiagonal();
  const MatrixXd b = Eigen::Vector2d(2, 1);
  EXPECT_LT((least_squares_by_pivots(A, b, 1e-4) - Eigen::Vector2d(2, 1000)).norm(), 1e-10);
  EXPECT_LT((least_squares_by_pivots(A, b, 0.1) - Eigen::Vector2d(2, 0)).norm(), 1e-14);
}

TEST(Decompositions, EigenvaluesOfATridiagonalMatrix) {
  const VectorXd diagonal = some_matrix(5, 1), beside = some_matrix(4, 1);
  MatrixXd A = diagonal.asDiagonal();
  A.diagonal(-1) = A.diagonal(1) = beside;
  EXPECT_LT((tridiagonal_eigenvalues(diagonal, beside) - symmetric_eigenvalues(A)).norm(),
            100 * rounding * A.norm());
  EXPECT_EQ(tridiagonal_eigenvalues(VectorXd::Constant(1, 3), VectorXd())[0], 3);
}

TEST(Decompositions, RanksAndNullSpaces) {
  MatrixXd A = some_matrix(5, 4);
  A.col(2) = A.col(0) + A.col(1);
  EXPECT_EQ(numerical_rank(A, 1e-10), 3);
  const MatrixXd across = left_null_space(A, 1e-10);
  ASSERT_EQ(across.cols(), 2);
  EXPECT_LT((across.transpose() * A).norm(), 1e-14);
  EXPECT_LT((across.transpose() * across - MatrixXd::Identity(2, 2)).norm(), 1e-14);
}

TEST(Decompositions, TheColumnThatReachesFurthestIsFirst) {
  MatrixXd A(2, 3);
  A << 1, 0, 3, 0, 2, 0;
  const PivotedColumns pivots = pivoted_columns(A);
  EXPECT_EQ(pivots.rank, 2);
  EXPECT_EQ(pivots.order[0], 2);
  EXPECT_EQ(pivots.order[1], 1);
  EXPECT_DOUBLE_EQ(pivots.first, 3);
  EXPECT_DOUBLE_EQ(pivots.last, 2);
}

TEST(Decompositions, OrthonormalColumnsSpanTheMatrix) {
  const MatrixXd A = some_matrix(7, 3), Q = orthonormal_columns(A);
  ASSERT_EQ(Q.cols(), 3);
  EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(3, 3)).norm(), 1e-14);
  EXPECT_LT((Q * (Q.transpose() * A) - A).norm(), 1e-14);
}

TEST(Decompositions, SingularVectorsMakeTheMatrix) {
  const MatrixXd A = some_matrix(6, 3);
  const auto [values, left, right] = singular_vectors(A);
  EXPECT_LT((left * values.asDiagonal() * right.transpose() - A).norm(), 1e-14);
  EXPECT_LT((left.transpose() * left - MatrixXd::Identity(3, 3)).norm(), 1e-14);
  EXPECT_LT((right.transpose() * right - MatrixXd::Identity(3, 3)).norm(), 1e-14);
}

TEST(Decompositions, SingularVectorsSpanTheColumns) {
  const MatrixXd A = some_matrix(6, 3);
  const auto [values, vectors] = left_singular_vectors(A);
  EXPECT_LT((vectors * (vectors.transpose() * A) - A).norm(), 1e-14);
  EXPECT_NEAR(values.norm(), A.norm(), 1e-14);
  const SquareMatrix<6> square = some_positive(6);
  EXPECT_NEAR(smallest_singular_value(square), symmetric_eigenvalues(square)[0], 1e-13);
}

}  // namespace
}  // namespace blocklift::algebra
