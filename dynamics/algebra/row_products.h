#pragma once

#include <Eigen/Core>

namespace blocklift::dynamics {

/// A A^T of a matrix, both halves, by BLAS.
Eigen::MatrixXd row_products(const Eigen::MatrixXd& A);

}  // namespace blocklift::dynamics
