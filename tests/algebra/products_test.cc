#include "algebra/products.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/algebra/some_matrix.h"

namespace blocklift::algebra {
namespace {

using Eigen::MatrixXd;
using test::some_matrix;

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon();

TEST(Products, AreEigensWithinRounding) {
  const MatrixXd A = some_matrix(11, 40), B = some_matrix(40, 7);
  MatrixXd C(11, 7);
  multiply(A, B, C);
  EXPECT_LT((C - A * B).norm(), 100.0 * unit_roundoff * A.norm() * B.norm());
}

TEST(Products, OfPartsOfMatricesTouchNothingElse) {
  const MatrixXd A = some_matrix(11, 40), B = some_matrix(40, 7);
  MatrixXd C = MatrixXd::Constant(6, 8, 3.0);
  multiply(A.block(2, 5, 4, 20), B.block(10, 1, 20, 3), C.block(1, 2, 4, 3));
  MatrixXd expected = MatrixXd::Constant(6, 8, 3.0);
  expected.block(1, 2, 4, 3) = A.block(2, 5, 4, 20) * B.block(10, 1, 20, 3);
  EXPECT_LT((C - expected).norm(), 100.0 * unit_roundoff * A.norm() * B.norm());
  EXPECT_EQ(C.topRows(1), expected.topRows(1));
  EXPECT_EQ(C.rightCols(3), expected.rightCols(3));
}

TEST(Products, OverNothingAreZero) {
  MatrixXd C = MatrixXd::Constant(3, 2, 5.0);
  multiply(MatrixXd(3, 0), MatrixXd(0, 2), C);
  EXPECT_EQ(C, MatrixXd::Zero(3, 2));
  EXPECT_EQ(row_products(MatrixXd(3, 0)), MatrixXd::Zero(3, 3));
  MatrixXd products;
  find_column_products(MatrixXd(0, 4), products);
  EXPECT_EQ(products, MatrixXd::Zero(4, 4));
}

TEST(RowProducts, AreThoseOfEachRowWithEach) {
  const MatrixXd A = some_matrix(7, 40), products = row_products(A);
  ASSERT_EQ(products.rows(), 7);
  for (Eigen::Index i = 0; i < 7; ++i)
    for (Eigen::Index j = 0; j < 7; ++j)
      EXPECT_NEAR(products(i, j), A.row(i).dot(A.row(j)), 100.0 * unit_roundoff * A.squaredNorm());
}

TEST(RowProducts, AreAddedToTheLowerHalfOfAPart) {
  const MatrixXd A = some_matrix(9, 5);
  MatrixXd C = MatrixXd::Constant(6, 6, 2.0);
  add_row_products(A.middleRows(3, 4), C.bottomRightCorner(4, 4));
  MatrixXd expected = MatrixXd::Constant(6, 6, 2.0);
  expected.bottomRightCorner(4, 4).triangularView<Eigen::Lower>() +=
      A.middleRows(3, 4) * A.middleRows(3, 4).transpose();
  EXPECT_LT((C - expected).norm(), 100.0 * unit_roundoff * A.squaredNorm());
  EXPECT_EQ(C(2, 5), 2.0);
}

TEST(ColumnProducts, AreSymmetricToTheLastDigit) {
  const MatrixXd A = some_matrix(40, 7);
  MatrixXd products = MatrixXd::Ones(2, 2);
  find_column_products(A, products);
  EXPECT_LT((products - A.transpose() * A).norm(), 100.0 * unit_roundoff * A.squaredNorm());
  EXPECT_EQ(products, products.transpose());
}

}  // namespace
}  // namespace blocklift::algebra
