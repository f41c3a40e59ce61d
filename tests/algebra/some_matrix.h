#pragma once

#include <cmath>

#include <Eigen/Core>

namespace blocklift::test {

/// A full matrix whose entries follow no pattern, the same on each machine.
inline Eigen::MatrixXd some_matrix(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(1.0 + 3.7 * static_cast<double>(i) + 1.3 * static_cast<double>(i * j + j * j));
  });
}

/// Symmetric and positive definite; its condition is below 1000.
inline Eigen::MatrixXd some_positive(Eigen::Index size) {
  const Eigen::MatrixXd root = some_matrix(size, size);
  return root.transpose() * root + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

}  // namespace blocklift::test
