#include "dynamics/algebra/row_products.h"

extern "C" {
void dsyrk_(const char* half, const char* transposed, const int* n, const int* k,
            const double* alpha, const double* a, const int* lda, const double* beta, double* c,
            const int* ldc);
}

namespace blocklift::dynamics {

Eigen::MatrixXd row_products(const Eigen::MatrixXd& A) {
  const int n = static_cast<int>(A.rows()), k = static_cast<int>(A.cols());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n, n);
  if (n == 0 || k == 0) return products;
  const double one = 1, zero = 0;
  dsyrk_("L", "N", &n, &k, &one, A.data(), &n, &zero, products.data(), &n);
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  return products;
}

}  // namespace blocklift::dynamics
