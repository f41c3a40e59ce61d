#include "dynamics/algebra/single_precision.h"

#include <string>
#include <utility>

#include "dynamics/errors.h"

// The Fortran routines of BLAS and LAPACK that are used, by their fixed interfaces.
extern "C" {
void sgetrf_(const int* rows, const int* columns, float* a, const int* lda, int* pivots, int* info);
void sgetrs_(const char* transposed, const int* n, const int* right_sides, const float* a,
             const int* lda, const int* pivots, float* b, const int* ldb, int* info);
void sgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const float* alpha, const float* a, const int* lda, const float* b,
            const int* ldb, const float* beta, float* c, const int* ldc);
}

namespace blocklift::dynamics {

SingleLuFactorisation::SingleLuFactorisation(Eigen::MatrixXf matrix, const char* what,
                                             const char* cause)
    : factors_(std::move(matrix)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const int n = static_cast<int>(factors_.rows());
  if (n == 0) return;
  int info = 0;
  sgetrf_(&n, &n, factors_.data(), &n, pivots_.data(), &info);
  if (info != 0) {
    throw SimulationError(std::string(what) + " is singular at row " + std::to_string(info) + ": " +
                          cause);
  }
}

void SingleLuFactorisation::solve_in_place(Eigen::MatrixXf& right_sides) const {
  const int n = static_cast<int>(size()), columns = static_cast<int>(right_sides.cols());
  if (n == 0 || columns == 0) return;
  int info = 0;
  sgetrs_("N", &n, &columns, factors_.data(), &n, pivots_.data(), right_sides.data(), &n, &info);
}

void multiply(float alpha, const Eigen::MatrixXf& A, const Eigen::MatrixXf& B, float beta,
              Eigen::MatrixXf& C) {
  const int m = static_cast<int>(A.rows()), n = static_cast<int>(B.cols());
  const int k = static_cast<int>(A.cols());
  if (m == 0 || n == 0) return;
  if (k == 0) {
    C *= beta;
    return;
  }
  sgemm_("N", "N", &m, &n, &k, &alpha, A.data(), &m, B.data(), &k, &beta, C.data(), &m);
}

}  // namespace blocklift::dynamics
