#include "algebra/products.h"

#include "algebra/blas.h"

namespace blocklift::algebra {

namespace {

constexpr double one = 1, zero = 0;

int to_int(Eigen::Index value) { return static_cast<int>(value); }

}  // namespace

void multiply(const Eigen::Ref<const Eigen::MatrixXd>& A,
              const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> C) {
  const int m = to_int(A.rows()), n = to_int(B.cols()), k = to_int(A.cols());
  if (m == 0 || n == 0) return;
  if (k == 0) {
    C.setZero();
    return;
  }
  const int of_a = to_int(A.outerStride()), of_b = to_int(B.outerStride()),
            of_c = to_int(C.outerStride());
  dgemm_("N", "N", &m, &n, &k, &one, A.data(), &of_a, B.data(), &of_b, &zero, C.data(), &of_c);
}

void add_row_products(const Eigen::Ref<const Eigen::MatrixXd>& A, Eigen::Ref<Eigen::MatrixXd> C) {
  const int n = to_int(A.rows()), k = to_int(A.cols());
  if (n == 0 || k == 0) return;
  const int of_a = to_int(A.outerStride()), of_c = to_int(C.outerStride());
  dsyrk_("L", "N", &n, &k, &one, A.data(), &of_a, &one, C.data(), &of_c);
}

Eigen::MatrixXd row_products(const Eigen::MatrixXd& A) {
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(A.rows(), A.rows());
  add_row_products(A, products);
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  return products;
}

void find_column_products(const Eigen::MatrixXd& A, Eigen::MatrixXd& products) {
  const int n = to_int(A.cols()), k = to_int(A.rows());
  products.setZero(n, n);
  if (n == 0 || k == 0) return;
  dsyrk_("L", "T", &n, &k, &one, A.data(), &k, &zero, products.data(), &n);
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
}

}  // namespace blocklift::algebra
