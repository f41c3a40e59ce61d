#include "dynamics/algebra/single_precision.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double single_rounding = std::numeric_limits<float>::epsilon();

/// A full matrix whose entries follow no pattern, the same on each machine.
Eigen::MatrixXf some_single_matrix(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXf::NullaryExpr(rows, columns, [](Eigen::Index i, Eigen::Index j) {
    return static_cast<float>(
        std::sin(1.0 + 3.7 * static_cast<double>(i) + 1.3 * static_cast<double>(i * j + j * j)));
  });
}

/// Of both, by norms, over the rounding of one number.
double roundings_apart(const Eigen::MatrixXf& value, const Eigen::MatrixXd& exact) {
  return (value.cast<double>() - exact).norm() / (single_rounding * exact.norm());
}

// Sizes with and without a rest over the vectors, blocks and threads' shares of the product; from
// one thread to several.
TEST(SinglePrecision, SymmetricProductsAreThoseOfDoublePrecision) {
  for (const Eigen::Index n : {1, 3, 8, 63, 64, 130, 1029}) {
    const Eigen::MatrixXf half = some_single_matrix(n, n);
    const Eigen::MatrixXf A = half + half.transpose();
    for (const Eigen::Index columns : {1, 2, 3, 5, 18}) {
      const Eigen::MatrixXf X = some_single_matrix(n, columns);
      Eigen::MatrixXf Y = Eigen::MatrixXf::Constant(n, columns, 7.0F);
      multiply_symmetric(A, X, Y);
      EXPECT_LT(roundings_apart(Y, A.cast<double>() * X.cast<double>()), 20.0)
          << n << " x " << columns;
    }
  }
}

TEST(SinglePrecision, ProductsAddUp) {
  const Eigen::MatrixXf A = some_single_matrix(17, 9), B = some_single_matrix(9, 5);
  Eigen::MatrixXf C = some_single_matrix(17, 5);
  const Eigen::MatrixXd exact = -2.0 * A.cast<double>() * B.cast<double>() + 0.5 * C.cast<double>();
  multiply(-2.0F, A, B, 0.5F, C);
  EXPECT_LT(roundings_apart(C, exact), 5.0);
  multiply(1.0F, Eigen::MatrixXf(17, 0), Eigen::MatrixXf(0, 5), 0.0F, C);
  EXPECT_EQ(C.norm(), 0.0F);
}

TEST(SinglePrecision, FactorsSolve) {
  const Eigen::Index n = 40;
  Eigen::MatrixXf A = some_single_matrix(n, n);
  A.diagonal().array() += 10.0F;
  const Eigen::MatrixXf X = some_single_matrix(n, 3);
  Eigen::MatrixXf B = (A.cast<double>() * X.cast<double>()).cast<float>();
  const SingleLuFactorisation factors(A, "the matrix", "no cause");
  EXPECT_EQ(factors.size(), n);
  factors.solve_in_place(B);
  EXPECT_LT(roundings_apart(B, X.cast<double>()), 50.0);
}

TEST(SinglePrecision, SingularMatricesAreNamed) {
  EXPECT_THAT(
      [] {
        SingleLuFactorisation(Eigen::MatrixXf::Zero(3, 3), "the matrix of nothing", "it is empty");
      },
      ThrowsMessage<SimulationError>(
          HasSubstr("the matrix of nothing is singular at row 1: it is empty")));
}

}  // namespace
}  // namespace blocklift::dynamics
