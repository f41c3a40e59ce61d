#include "dynamics/algebra/hierarchical_matrix.h"

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace blocklift::dynamics {
namespace {

/// Points of a plane on a spiral, the denser the nearer to its middle.
Eigen::Matrix2Xd spiral(Eigen::Index count) {
  constexpr double golden_angle = 2.399963229728653;
  Eigen::Matrix2Xd points(2, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double along = static_cast<double>(k) + 0.5;
    points.col(k) = 0.01 * along *
                    Eigen::Vector2d(std::cos(golden_angle * along), std::sin(golden_angle * along));
  }
  return points;
}

/// What a surface has of sources at its points: falls with the third power of the distance.
Eigen::MatrixXd influence(const Eigen::Matrix2Xd& points) {
  return Eigen::MatrixXd::NullaryExpr(
      points.cols(), points.cols(), [&](Eigen::Index i, Eigen::Index j) {
        return std::pow(0.01 + (points.col(i) - points.col(j)).squaredNorm(), -1.5);
      });
}

double relative_error(const Eigen::MatrixXf& value, const Eigen::MatrixXd& exact) {
  return (value.cast<double>() - exact).norm() / exact.norm();
}

// Columns that change their sign from point to point, and smooth ones, to which blocks of points
// that lie apart contribute most. The error falls as the blocks become more accurate, to that of
// single precision.
TEST(HierarchicalMatrix, ProductsAreThoseOfTheDenseMatrix) {
  const Eigen::Index n = 3000;
  const Eigen::Matrix2Xd points = spiral(n);
  const Eigen::MatrixXd dense = influence(points);
  Eigen::MatrixXd columns(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    columns.row(i) << (i % 2 == 0 ? 1.0 : -1.0), 1.0, std::cos(0.2 * points(0, i));
  }
  const Eigen::MatrixXd exact = dense * columns;
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    const HierarchicalMatrix matrix(dense.cast<float>(), points, accuracy);
    EXPECT_LT(matrix.bytes(), 0.25 * 4.0 * static_cast<double>(n * n));
    Eigen::MatrixXf product(n, 3);
    HierarchicalMatrix::Workspace workspace;
    matrix.multiply(columns.cast<float>(), product, workspace);
    for (Eigen::Index j = 0; j < 3; ++j) {
      EXPECT_LT(relative_error(product.col(j), exact.col(j)), 0.1 * accuracy + 1e-6)
          << "accuracy " << accuracy << ", column " << j;
    }
    // One column alone, in the same workspace.
    Eigen::MatrixXf single(n, 1);
    matrix.multiply(columns.col(2).cast<float>(), single, workspace);
    EXPECT_LT(relative_error(single, product.col(2).cast<double>()), 1e-6);
  }
}

// What is made and multiplied by one thread and by several is equal to the last bit.
TEST(HierarchicalMatrix, ProductsDoNotDependOnTheThreads) {
  const Eigen::Matrix2Xd points = spiral(2000);
  const Eigen::MatrixXf dense = influence(points).cast<float>();
  const Eigen::MatrixXf X = points.transpose().cast<float>();
  const char* const threads = std::getenv("OMP_NUM_THREADS");
  const std::string before = threads != nullptr ? threads : "";
  std::vector<Eigen::MatrixXf> products;
  for (const char* count : {"1", "3"}) {
    ::setenv("OMP_NUM_THREADS", count, 1);
    HierarchicalMatrix::Workspace workspace;
    Eigen::MatrixXf& product = products.emplace_back(X.rows(), X.cols());
    HierarchicalMatrix(dense, points, 1e-3).multiply(X, product, workspace);
  }
  before.empty() ? ::unsetenv("OMP_NUM_THREADS") : ::setenv("OMP_NUM_THREADS", before.c_str(), 1);
  EXPECT_EQ(products[0], products[1]);
}

TEST(HierarchicalMatrix, FewPointsAndNone) {
  for (const Eigen::Index n : {1, 3, 5, 41}) {
    const Eigen::Matrix2Xd points = spiral(n);
    const Eigen::MatrixXd dense = influence(points);
    const HierarchicalMatrix matrix(dense.cast<float>(), points, 1e-3);
    const Eigen::MatrixXf X = Eigen::MatrixXf::Constant(n, 2, 0.5F);
    Eigen::MatrixXf Y = Eigen::MatrixXf::Constant(n, 2, 7.0F);
    HierarchicalMatrix::Workspace workspace;
    matrix.multiply(X, Y, workspace);
    EXPECT_LT(relative_error(Y, dense * X.cast<double>()), 1e-6) << n;
  }
  const HierarchicalMatrix empty(Eigen::MatrixXf(0, 0), Eigen::Matrix2Xd(2, 0), 1e-3);
  EXPECT_EQ(empty.bytes(), 0.0);
  Eigen::MatrixXf nothing(0, 2);
  HierarchicalMatrix::Workspace workspace;
  empty.multiply(Eigen::MatrixXf(0, 2), nothing, workspace);
}

}  // namespace
}  // namespace blocklift::dynamics
