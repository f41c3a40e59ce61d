#include "dynamics/marine/radiation/block_hankel.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/algebra/dense_algebra.h"

namespace blocklift::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Symmetric samples of three modes that swing and fade.
std::vector<MatrixXd> fading_samples(int count) {
  std::vector<MatrixXd> K;
  for (int n = 0; n < count; ++n) {
    const double t = 0.2 * n;
    MatrixXd k(3, 3);
    for (Index i = 0; i < 3; ++i) {
      for (Index j = 0; j < 3; ++j) {
        const auto sum = static_cast<double>(i + j);
        k(i, j) = std::exp(-(0.3 + 0.1 * sum) * t * t) * std::cos(t * (1.0 + 0.4 * sum));
      }
    }
    K.push_back(k);
  }
  return K;
}

MatrixXd whole_matrix(const std::vector<MatrixXd>& K, Index shift) {
  const auto count = static_cast<Index>(K.size());
  const Index modes = K[0].rows();
  MatrixXd whole = MatrixXd::Zero(count * modes, count * modes);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; i + j + shift < count; ++j) {
      whole.block(i * modes, j * modes, modes, modes) = K[i + j + shift];
    }
  }
  return whole;
}

TEST(BlockHankel, MultipliesAsTheWholeMatrix) {
  for (const int count : {1, 2, 7, 40}) {
    const std::vector<MatrixXd> K = fading_samples(count);
    const BlockHankel hankel(K);
    ASSERT_EQ(hankel.size(), 3 * count);
    // More columns than go through a product together.
    const MatrixXd columns = MatrixXd::Random(hankel.size(), 19);
    for (const Index shift : {0, 1}) {
      const MatrixXd expected = whole_matrix(K, shift) * columns;
      // Transforms round by the logarithm of their length times the sum of what is multiplied.
      EXPECT_LT((hankel.multiply(columns, shift) - expected).norm(), 1e-14 * columns.norm() * count)
          << count << " samples, shifted by " << shift;
    }
  }
}

TEST(BlockHankel, LeadingEigenpairsAreThoseOfTheWholeMatrix) {
  const std::vector<MatrixXd> K = fading_samples(60);
  MatrixXd vectors = whole_matrix(K, 0);
  const MatrixXd whole = vectors;
  Eigen::VectorXd values = decompose_symmetric(vectors);
  std::sort(values.begin(), values.end(),
            [](double a, double b) { return std::abs(a) > std::abs(b); });
  for (const Index count : {5, 12, 170}) {
    const LeadingEigenpairs pairs = find_leading_eigenpairs(BlockHankel(K), count);
    ASSERT_EQ(pairs.values.size(), count);
    // The random subspace is turned by the third power of the eigenvalues' ratio, and the error of
    // an eigenvalue is the square of its vector's: they have to fall by two orders over the twenty
    // columns beyond those asked for.
    if (count + 20 < values.size()) {
      ASSERT_LT(std::abs(values[count + 20]), 0.01 * std::abs(values[count - 1])) << count;
    }
    const double rounding = 1e-13 * std::abs(values[0]);
    EXPECT_LT((pairs.values.cwiseAbs() - values.head(count).cwiseAbs()).lpNorm<Eigen::Infinity>(),
              rounding)
        << count;
    const MatrixXd residual = whole * pairs.vectors - pairs.vectors * pairs.values.asDiagonal();
    EXPECT_LT(residual.norm(), 10.0 * rounding) << count;
    const MatrixXd gram = pairs.vectors.transpose() * pairs.vectors;
    EXPECT_LT((gram - MatrixXd::Identity(count, count)).norm(), 1e-12) << count;
  }
}

}  // namespace
}  // namespace blocklift::dynamics
