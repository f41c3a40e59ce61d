#include "dynamics/algebra/dense_algebra.h"

#include <algorithm>
#include <complex>
#include <string>
#include <utility>

#include "dynamics/errors.h"

// The Fortran routines of BLAS and LAPACK that are used, by their fixed interfaces.
extern "C" {
void dgetrf_(const int* rows, const int* columns, double* a, const int* lda, int* pivots,
             int* info);
void sgetrf_(const int* rows, const int* columns, float* a, const int* lda, int* pivots, int* info);
void dgetrs_(const char* transposed, const int* n, const int* right_sides, const double* a,
             const int* lda, const int* pivots, double* b, const int* ldb, int* info);
void sgetrs_(const char* transposed, const int* n, const int* right_sides, const float* a,
             const int* lda, const int* pivots, float* b, const int* ldb, int* info);
void cgetrf_(const int* rows, const int* columns, std::complex<float>* a, const int* lda,
             int* pivots, int* info);
void cgetrs_(const char* transposed, const int* n, const int* right_sides,
             const std::complex<float>* a, const int* lda, const int* pivots,
             std::complex<float>* b, const int* ldb, int* info);
void zgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const std::complex<double>* alpha, const std::complex<double>* a,
            const int* lda, const std::complex<double>* b, const int* ldb,
            const std::complex<double>* beta, std::complex<double>* c, const int* ldc);
void zgesv_(const int* n, const int* right_sides, std::complex<double>* a, const int* lda,
            int* pivots, std::complex<double>* b, const int* ldb, int* info);
void dsyevd_(const char* vectors, const char* half, const int* n, double* a, const int* lda,
             double* values, double* work, const int* work_size, int* integers,
             const int* integer_count, int* info);
void dgeqrf_(const int* rows, const int* columns, double* a, const int* lda, double* factors,
             double* work, const int* work_size, int* info);
void dorgqr_(const int* rows, const int* columns, const int* reflectors, double* a, const int* lda,
             const double* factors, double* work, const int* work_size, int* info);
void dgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const double* alpha, const double* a, const int* lda, const double* b,
            const int* ldb, const double* beta, double* c, const int* ldc);
void sgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const float* alpha, const float* a, const int* lda, const float* b,
            const int* ldb, const float* beta, float* c, const int* ldc);
}

namespace blocklift::dynamics {
namespace {

int to_int(Eigen::Index value) { return static_cast<int>(value); }

[[noreturn]] void throw_no_convergence(const std::string& what, Eigen::Index columns) {
  throw SimulationError("the " + what + " of " + std::to_string(columns) +
                        " columns do not converge");
}

// LAPACK's and BLAS' routine of each number.
template <class Real>
struct Routines;
template <>
struct Routines<double> {
  static constexpr auto factorise = dgetrf_;
  static constexpr auto solve = dgetrs_;
  static constexpr auto multiply = dgemm_;
};
template <>
struct Routines<float> {
  static constexpr auto factorise = sgetrf_;
  static constexpr auto solve = sgetrs_;
  static constexpr auto multiply = sgemm_;
};

template <class Matrix, class Real = typename Matrix::Scalar>
void multiply_of(Real alpha, const Matrix& A, const Matrix& B, Real beta, Matrix& C) {
  const int m = to_int(A.rows()), n = to_int(B.cols()), k = to_int(A.cols());
  if (m == 0 || n == 0) return;
  if (k == 0) {
    C *= beta;
    return;
  }
  Routines<Real>::multiply("N", "N", &m, &n, &k, &alpha, A.data(), &m, B.data(), &k, &beta,
                           C.data(), &m);
}

}  // namespace

template <class Real>
DenseLu<Real>::DenseLu(Matrix matrix, const char* what, const char* cause)
    : factors_(std::move(matrix)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const int n = to_int(factors_.rows());
  if (n == 0) return;
  int info = 0;
  Routines<Real>::factorise(&n, &n, factors_.data(), &n, pivots_.data(), &info);
  if (info != 0) {
    throw SimulationError(std::string(what) + " is singular at row " + std::to_string(info) + ": " +
                          cause);
  }
}

template <class Real>
void DenseLu<Real>::solve_in_place(Eigen::Ref<Matrix> right_sides) const {
  const int n = to_int(size()), columns = to_int(right_sides.cols());
  if (n == 0 || columns == 0) return;
  const int stride = to_int(right_sides.outerStride());
  int info = 0;
  Routines<Real>::solve("N", &n, &columns, factors_.data(), &n, pivots_.data(), right_sides.data(),
                        &stride, &info);
}

template class DenseLu<double>;
template class DenseLu<float>;

namespace {

/// Solves by factors in single precision, which take half the time, and improves the solution until
/// what is left of each right-hand side is a billionth of it: most often once.
/// @returns whether that was reached; if not, both matrices are as they were.
bool solve_by_single_factors(const Eigen::MatrixXcd& matrix, Eigen::MatrixXcd& right_sides) {
  constexpr int most_rounds = 5;
  constexpr double enough = 1e-9;
  const int n = to_int(matrix.rows()), columns = to_int(right_sides.cols());
  Eigen::MatrixXcf factors = matrix.cast<std::complex<float>>();
  std::vector<int> pivots(static_cast<std::size_t>(n));
  int info = 0;
  cgetrf_(&n, &n, factors.data(), &n, pivots.data(), &info);
  if (info != 0) return false;
  Eigen::RowVectorXd sizes = right_sides.colwise().norm();
  for (double& size : sizes) {
    if (size == 0.0) size = 1.0;
  }
  Eigen::MatrixXcd solution = Eigen::MatrixXcd::Zero(n, columns), left = right_sides;
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::RowVectorXd scales = left.colwise().norm().cwiseMax(1e-30 * sizes);
    Eigen::MatrixXcf step =
        (left * scales.cwiseInverse().asDiagonal()).eval().cast<std::complex<float>>();
    cgetrs_("N", &n, &columns, factors.data(), &n, pivots.data(), step.data(), &n, &info);
    solution += step.cast<std::complex<double>>() * scales.asDiagonal();
    left = right_sides;
    const std::complex<double> minus(-1.0), plus(1.0);
    zgemm_("N", "N", &n, &columns, &n, &minus, matrix.data(), &n, solution.data(), &n, &plus,
           left.data(), &n);
    if ((left.colwise().norm().array() <= enough * sizes.array()).all()) {
      right_sides = std::move(solution);
      return true;
    }
  }
  return false;
}

}  // namespace

void solve_in_place(Eigen::MatrixXcd& matrix, Eigen::MatrixXcd& right_sides, const char* what) {
  const int n = to_int(matrix.rows()), columns = to_int(right_sides.cols());
  if (n == 0 || columns == 0) return;
  constexpr int small = 200;
  if (n >= small && solve_by_single_factors(matrix, right_sides)) return;
  std::vector<int> pivots(static_cast<std::size_t>(n));
  int info = 0;
  zgesv_(&n, &columns, matrix.data(), &n, pivots.data(), right_sides.data(), &n, &info);
  if (info != 0) {
    throw SimulationError(std::string(what) + " is singular at row " + std::to_string(info));
  }
}

Eigen::VectorXd decompose_symmetric(Eigen::MatrixXd& matrix) {
  const int n = to_int(matrix.rows());
  Eigen::VectorXd values(n);
  if (n == 0) return values;
  double work_size = 0.0;
  int integer_count = 0, info = 0;
  const int ask = -1;
  dsyevd_("V", "L", &n, matrix.data(), &n, values.data(), &work_size, &ask, &integer_count, &ask,
          &info);
  std::vector<double> work(static_cast<std::size_t>(work_size));
  std::vector<int> integers(static_cast<std::size_t>(integer_count));
  const int size = static_cast<int>(work.size());
  dsyevd_("V", "L", &n, matrix.data(), &n, values.data(), work.data(), &size, integers.data(),
          &integer_count, &info);
  if (info != 0) throw_no_convergence("eigenvalues of a symmetric matrix", n);
  return values;
}

Eigen::VectorXd decompose_hermitian(Eigen::MatrixXcd& matrix) {
  if (matrix.size() == 0) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw_no_convergence("eigenvalues of a Hermitian matrix", matrix.cols());
  matrix = solver.eigenvectors();
  return solver.eigenvalues();
}

Eigensystem decompose_general(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return {};
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw_no_convergence("eigenvalues of a matrix", matrix.cols());
  return {solver.eigenvalues(), solver.eigenvectors()};
}

RightSingularVectors decompose_singular(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return {{}, Eigen::MatrixXd::Identity(matrix.cols(), matrix.cols())};
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

void orthonormalise(Eigen::MatrixXd& matrix) {
  const int m = to_int(matrix.rows()), n = to_int(matrix.cols());
  if (n == 0) return;
  Eigen::VectorXd factors(n);
  double first_size = 0.0, second_size = 0.0;
  const int ask = -1;
  int info = 0;
  dgeqrf_(&m, &n, matrix.data(), &m, factors.data(), &first_size, &ask, &info);
  dorgqr_(&m, &n, &n, matrix.data(), &m, factors.data(), &second_size, &ask, &info);
  std::vector<double> work(static_cast<std::size_t>(std::max(first_size, second_size)));
  const int size = static_cast<int>(work.size());
  dgeqrf_(&m, &n, matrix.data(), &m, factors.data(), work.data(), &size, &info);
  dorgqr_(&m, &n, &n, matrix.data(), &m, factors.data(), work.data(), &size, &info);
}

void multiply(double alpha, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double beta,
              Eigen::MatrixXd& C) {
  multiply_of(alpha, A, B, beta, C);
}

void multiply(float alpha, const Eigen::MatrixXf& A, const Eigen::MatrixXf& B, float beta,
              Eigen::MatrixXf& C) {
  multiply_of(alpha, A, B, beta, C);
}

}  // namespace blocklift::dynamics
