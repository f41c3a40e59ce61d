#pragma once

#include <Eigen/Core>

// Products by BLAS, whose kernels follow the processor; Eigen's are those of the oldest processor
// that the program runs on. They pay from some tens of rows and columns on. Where several threads
// multiply at once, a parallel::OneBlasThread keeps BLAS' own threads out of their way.
namespace blocklift::algebra {

/// C = A B. C has its size and shares no memory with A and B.
void multiply(const Eigen::Ref<const Eigen::MatrixXd>& A,
              const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> C);

/// Adds A A^T to the lower half of C, which has its size; the upper half stays.
void add_row_products(const Eigen::Ref<const Eigen::MatrixXd>& A, Eigen::Ref<Eigen::MatrixXd> C);

/// A A^T, both halves.
Eigen::MatrixXd row_products(const Eigen::MatrixXd& A);

/// A^T A, both halves, into memory that is kept.
void find_column_products(const Eigen::MatrixXd& A, Eigen::MatrixXd& products);

}  // namespace blocklift::algebra
