#pragma once

#include <Eigen/Core>

// What Cholesky factorisations by blocks, and solutions by them, are made of: by BLAS and LAPACK.
// L is the lower half of a square matrix. What a function writes shares no memory with what it
// reads, and has its size.
namespace blocklift::algebra {

using Given = Eigen::Ref<const Eigen::MatrixXd>;
using Changed = Eigen::Ref<Eigen::MatrixXd>;

/// Replaces the lower half of a symmetric matrix A by L of A = L L^T; the upper half stays.
/// @returns the first row whose pivot is not positive; as many as there are if all are positive.
Eigen::Index factorise_in_place(Changed A);

void divide_by_lower(const Given& L, Changed B);             ///< B becomes L^-1 B
void divide_by_upper(const Given& L, Changed B);             ///< B becomes L^-T B
void divide_by_upper_from_right(const Given& L, Changed B);  ///< B becomes B L^-T

void multiply_by_transposed(const Given& A, const Given& B, Changed C);  ///< C = A B^T
void subtract_by_transposed(const Given& A, const Given& B, Changed C);  ///< C becomes C - A B^T
void subtract_transposed_by(const Given& A, const Given& B, Changed C);  ///< C becomes C - A^T B

}  // namespace blocklift::algebra
