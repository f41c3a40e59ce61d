#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace blocklift::structure {

/// Asks the kernel to fill memory that was taken and not yet written with large pages, of 2 MB
/// instead of 4 KB: each page that is touched first costs a call of the kernel. Less than some
/// megabytes stay as they are; so does all where the kernel knows no such pages.
void prefer_large_pages(void* begin, std::size_t bytes);

/// Has the kernel hand over the pages of memory that was taken and not yet written, to all threads
/// at once: one thread that writes it first waits for each. What the memory holds stays.
void take_pages(void* begin, std::size_t bytes);

/// A matrix whose entries are yet to be written, in large pages.
template <typename Matrix = Eigen::MatrixXd>
Matrix make_large(Eigen::Index rows, Eigen::Index columns) {
  Matrix matrix(rows, columns);
  prefer_large_pages(matrix.data(),
                     static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar));
  return matrix;
}

/// The same of zeros.
inline Eigen::MatrixXd make_large_zero(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix = make_large(rows, columns);
  matrix.setZero();
  return matrix;
}

}  // namespace blocklift::structure
