#include "algebra/factors.h"

#include <complex>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/algebra/some_matrix.h"

namespace blocklift::algebra {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using test::some_matrix;
using test::some_positive;

constexpr double small = 1e-11;  // conditions are below 1000

TEST(Factors, SolutionsByLuSatisfyTheirEquations) {
  const MatrixXd A = some_positive(7) + some_matrix(7, 7), B = some_matrix(7, 3);
  const VectorXd b = B.col(1);
  LuFactors<double> factors(7);
  for (const double by : {1.0, 3.0}) {
    factors.factorise(by * A);
    EXPECT_TRUE(factors.is_regular());
    VectorXd x(7);
    factors.solve(b, x);
    EXPECT_LT((by * A * x - b).norm(), small);
    EXPECT_EQ(factors.solve(b), x);
    EXPECT_LT((by * A * factors.solve_columns(B) - B).norm(), small);
    EXPECT_LT((by * A.transpose() * factors.solve_transposed(b) - b).norm(), small);
  }
}

TEST(Factors, ComplexSolutionsSatisfyTheirEquations) {
  MatrixXcd A(6, 6), B(6, 2);
  A.real() = some_positive(6);
  A.imag() = some_matrix(6, 6);
  B.real() = some_matrix(6, 2);
  B.imag() = A.real().leftCols(2);
  const LuFactors<std::complex<double>> factors(A);
  const VectorXcd b = B.col(1);
  EXPECT_LT((A * factors.solve(b) - b).norm(), small);
  EXPECT_LT((A * factors.solve_columns(B) - B).norm(), small);
}

TEST(Factors, ASingularMatrixIsNotRegular) {
  MatrixXd A = some_matrix(3, 3);
  A.row(1).setZero();
  EXPECT_FALSE(LuFactors<double>(A).is_regular());
  A(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(LuFactors<double>(A).is_regular());
  EXPECT_TRUE(LuFactors<double>(MatrixXd(0, 0)).is_regular());
}

TEST(Factors, CholeskysRootsMakeTheMatrix) {
  const MatrixXd A = some_positive(5), B = some_matrix(5, 2);
  CholeskyFactors factors(5);
  factors.factorise(A);
  ASSERT_TRUE(factors.is_positive());
  const MatrixXd L = factors.lower();
  EXPECT_LT((L * L.transpose() - A).norm(), small);
  EXPECT_TRUE(L.isLowerTriangular());
  EXPECT_LT((L.transpose() * factors.inverse_of_transposed() - MatrixXd::Identity(5, 5)).norm(),
            small);
  MatrixXd X = B;
  factors.solve_columns_in_place(X);
  EXPECT_LT((A * X - B).norm(), small);
  VectorXd x = B.col(0);
  factors.solve_in_place(x);
  EXPECT_LT((A * x - B.col(0)).norm(), small);
}

TEST(Factors, AMatrixWithANegativeEigenvalueIsNotPositive) {
  const Eigen::Vector3d diagonal(1, -0.1, 2);
  EXPECT_FALSE(CholeskyFactors(diagonal.asDiagonal()).is_positive());
}

TEST(Factors, SymmetricFactorsSolveWithEitherSign) {
  const VectorXd b = some_matrix(6, 1);
  for (const double sign : {1.0, -1.0}) {
    const MatrixXd A = sign * some_positive(6);
    EXPECT_LT((A * SymmetricFactors(A).solve(b) - b).norm(), small);
  }
}

}  // namespace
}  // namespace blocklift::algebra
