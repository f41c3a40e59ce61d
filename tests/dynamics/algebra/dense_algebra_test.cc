#include "dynamics/algebra/dense_algebra.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "tests/algebra/some_matrix.h"

namespace blocklift::dynamics {
namespace {

using test::some_matrix;
using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double rounding = std::numeric_limits<double>::epsilon();

TEST(DenseAlgebra, GeneralEigenvectorsSatisfyTheirEquation) {
  const Eigen::Index n = 17;
  const MatrixXd A = some_matrix(n, n);
  const Eigensystem system = decompose_general(A);
  const MatrixXcd residual =
      A.cast<Complex>() * system.vectors - system.vectors * system.values.asDiagonal();
  EXPECT_LT(residual.norm(), 100.0 * rounding * A.norm());
  for (Eigen::Index k = 0; k < n; ++k) EXPECT_NEAR(system.vectors.col(k).norm(), 1.0, 1e-14);
  EXPECT_NEAR(system.values.sum().real(), A.trace(), 100.0 * rounding * A.norm());
  EXPECT_NEAR(system.values.sum().imag(), 0.0, 100.0 * rounding * A.norm());
}

// The companion matrix of (x - 1)(x - 2)(x^2 + 2 x + 5): roots 1, 2, -1 +- 2 i.
TEST(DenseAlgebra, GeneralEigenvaluesAreTheRootsOfACompanionMatrix) {
  MatrixXd A = MatrixXd::Zero(4, 4);
  A.topRightCorner(3, 3).setIdentity();
  // x^4 - x^3 + x^2 - 11 x + 10
  A.row(3) << -10.0, 11.0, -1.0, 1.0;
  VectorXcd values = decompose_general(A).values;
  std::sort(values.begin(), values.end(), [](const Complex& a, const Complex& b) {
    return std::make_pair(a.real(), a.imag()) < std::make_pair(b.real(), b.imag());
  });
  // Real parts of a conjugate pair are equal to the last bit.
  const std::vector<Complex> roots = {{-1.0, -2.0}, {-1.0, 2.0}, {1.0, 0.0}, {2.0, 0.0}};
  for (Eigen::Index k = 0; k < 4; ++k) EXPECT_LT(std::abs(values[k] - roots[k]), 1e-12);
}

TEST(DenseAlgebra, HermitianMatricesAreMadeOfTheirEigenvectors) {
  const Eigen::Index n = 9;
  const MatrixXcd half = some_matrix(n, n) + Complex(0.0, 1.0) * some_matrix(n, n).transpose();
  const MatrixXcd A = half + half.adjoint();
  MatrixXcd vectors = A;
  const VectorXd values = decompose_hermitian(vectors);
  EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
  const MatrixXcd made = vectors * values.asDiagonal() * vectors.adjoint();
  EXPECT_LT((made - A).norm(), 100.0 * rounding * A.norm());
}

TEST(DenseAlgebra, LastSingularVectorsSpanTheNullSpace) {
  // Three rows, one of them the sum of the others: rank 2 in five columns.
  MatrixXd A = some_matrix(3, 5);
  A.row(2) = A.row(0) + A.row(1);
  const RightSingularVectors svd = decompose_singular(A);
  ASSERT_EQ(svd.values.size(), 3);
  EXPECT_LT(svd.values[2], 10.0 * rounding * svd.values[0]);
  EXPECT_LT((A * svd.vectors.rightCols(3)).norm(), 10.0 * rounding * A.norm());
  EXPECT_LT((svd.vectors.transpose() * svd.vectors - MatrixXd::Identity(5, 5)).norm(), 1e-14);
  EXPECT_NEAR(svd.values.norm(), A.norm(), 10.0 * rounding * A.norm());
}

TEST(DenseAlgebra, NoRowsLeaveAllMotionsFree) {
  const RightSingularVectors svd = decompose_singular(MatrixXd(0, 4));
  EXPECT_EQ(svd.values.size(), 0);
  EXPECT_TRUE(svd.vectors.isIdentity());
}

TEST(DenseAlgebra, SingularMatricesAreNamedWithTheCause) {
  try {
    LuFactorisation(MatrixXd::Zero(3, 3), "the matrix of nothing", "it is empty");
    FAIL() << "no error";
  } catch (const SimulationError& error) {
    EXPECT_EQ(std::string(error.what()), "the matrix of nothing is singular at row 1: it is empty");
  }
}

}  // namespace
}  // namespace blocklift::dynamics
