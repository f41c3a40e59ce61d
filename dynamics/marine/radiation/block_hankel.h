#pragma once

#include <vector>

#include <Eigen/Dense>

namespace blocklift::dynamics {

/// The symmetric block Hankel matrix of samples K_0, K_1, ..., its block (i, j) being K_(i+j+shift)
/// and zero behind the last sample; as many blocks of rows as samples. It is never formed: a
/// product is a convolution of the samples with the columns turned round, by Fourier transforms.
class BlockHankel {
 public:
  /// @param K samples, each symmetric and of the same size (modes x modes); one at least.
  explicit BlockHankel(const std::vector<Eigen::MatrixXd>& K);

  Eigen::Index size() const { return samples_ * modes_; }

  /// The matrix of the samples from the `shift`-th on, times `columns` (size() rows).
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& columns, Eigen::Index shift) const;

 private:
  Eigen::Index samples_, modes_, length_;    ///< length of the transforms
  std::vector<Eigen::MatrixXcd> transform_;  ///< of the samples, at each frequency
};

/// Leading eigenvalues of a block Hankel matrix, by falling size, and their eigenvectors.
struct LeadingEigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  ///< one a column, orthonormal
};

/// As many as are asked for, or as the matrix has: by iterating a random subspace and then
/// Rayleigh and Ritz's method (Halko, Martinsson and Tropp 2011, algorithm 4.4). The random numbers
/// are the same each time.
LeadingEigenpairs find_leading_eigenpairs(const BlockHankel& hankel, Eigen::Index count);

}  // namespace blocklift::dynamics
