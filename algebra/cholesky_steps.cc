#include "algebra/cholesky_steps.h"

#include "algebra/blas.h"

namespace blocklift::algebra {

namespace {

int int_of(Eigen::Index value) { return static_cast<int>(value); }

/// C = alpha op(A) op(B) + beta C; op is the transpose where its letter is T.
void multiply_and_add(const char* op_a, const char* op_b, double alpha, const Given& A,
                      const Given& B, double beta, Changed& C) {
  const int m = int_of(C.rows()), n = int_of(C.cols()),
            k = int_of(*op_a == 'T' ? A.rows() : A.cols());
  if (m == 0 || n == 0 || (k == 0 && beta == 1)) return;
  const int of_a = int_of(A.outerStride()), of_b = int_of(B.outerStride()),
            of_c = int_of(C.outerStride());
  dgemm_(op_a, op_b, &m, &n, &k, &alpha, A.data(), &of_a, B.data(), &of_b, &beta, C.data(), &of_c);
}

void divide(const char* side, const char* op, const Given& L, Changed& B) {
  const int m = int_of(B.rows()), n = int_of(B.cols());
  if (m == 0 || n == 0) return;
  const int of_l = int_of(L.outerStride()), of_b = int_of(B.outerStride());
  constexpr double once = 1;
  dtrsm_(side, "L", op, "N", &m, &n, &once, L.data(), &of_l, B.data(), &of_b);
}

}  // namespace

Eigen::Index factorise_in_place(Changed A) {
  const int n = int_of(A.cols()), of_a = int_of(A.outerStride());
  int failed = 0;
  if (n > 0) dpotrf_("L", &n, A.data(), &of_a, &failed);
  return failed > 0 ? failed - 1 : n;
}

void divide_by_lower(const Given& L, Changed B) { divide("L", "N", L, B); }

void divide_by_upper(const Given& L, Changed B) { divide("L", "T", L, B); }

void divide_by_upper_from_right(const Given& L, Changed B) { divide("R", "T", L, B); }

void multiply_by_transposed(const Given& A, const Given& B, Changed C) {
  multiply_and_add("N", "T", 1, A, B, 0, C);
}

void subtract_by_transposed(const Given& A, const Given& B, Changed C) {
  multiply_and_add("N", "T", -1, A, B, 1, C);
}

void subtract_transposed_by(const Given& A, const Given& B, Changed C) {
  multiply_and_add("T", "N", -1, A, B, 1, C);
}

}  // namespace blocklift::algebra
