// Y = A X for a large symmetric A and a few columns X. A general product of BLAS first copies A,
// once for every product, which costs as much as the product itself where X has few columns. Here
// what a column of A and one of X have in common is summed as both lie in memory.
#include <algorithm>
#include <array>
#include <cstddef>

#include "dynamics/algebra/single_precision.h"
#include "dynamics/instruction_sets.h"
#include "parallel/threads.h"

extern "C" {
void ssymv_(const char* half, const int* n, const float* alpha, const float* a, const int* lda,
            const float* x, const int* incx, const float* beta, float* y, const int* incy);
}

namespace blocklift::dynamics {
namespace {

constexpr std::ptrdiff_t lane_count = 8;
using Lanes = float __attribute__((vector_size(4 * lane_count)));

/// Lanes from numbers wherever they lie.
[[gnu::always_inline]] inline void load(Lanes& to, const float* from) {
  __builtin_memcpy(&to, from, sizeof(Lanes));
}

// Twelve sums of lanes fit into the processor's registers beside what they are made of.
constexpr std::ptrdiff_t columns_of_A = 4, columns_of_X = 3;
// Rows of so many columns fit into its nearest memory.
constexpr std::ptrdiff_t rows_together = 1024;
// So many columns of A are one thread's work at a time.
constexpr std::ptrdiff_t columns_together = 64;

/// Columns of a matrix from some row on.
struct Columns {
  const float* first;
  std::ptrdiff_t stride;  ///< from a column to the next

  const float* operator[](std::ptrdiff_t column) const { return first + column * stride; }
};

/// Adds the products of p columns of A with q of X, over some rows, to a p x q block of Y.
/// @param next a column that is asked from the memory meanwhile.
template <std::ptrdiff_t p, std::ptrdiff_t q>
[[gnu::always_inline]] inline void add_block(const Columns& A, const Columns& X,
                                             std::ptrdiff_t rows, const float* next, float* Y,
                                             std::ptrdiff_t stride_of_Y) {
  std::array<std::array<Lanes, q>, p> sums{};
  std::ptrdiff_t k = 0;
  for (; k + lane_count <= rows; k += lane_count) {
    __builtin_prefetch(next + k, 0, 2);
    std::array<Lanes, q> x;
    for (std::ptrdiff_t j = 0; j < q; ++j) load(x[j], X[j] + k);
    for (std::ptrdiff_t i = 0; i < p; ++i) {
      Lanes a;
      load(a, A[i] + k);
      for (std::ptrdiff_t j = 0; j < q; ++j) sums[i][j] += a * x[j];
    }
  }
  for (std::ptrdiff_t i = 0; i < p; ++i) {
    for (std::ptrdiff_t j = 0; j < q; ++j) {
      float sum = 0.0F;
      for (std::ptrdiff_t lane = 0; lane < lane_count; ++lane) sum += sums[i][j][lane];
      for (std::ptrdiff_t row = k; row < rows; ++row) sum += A[i][row] * X[j][row];
      Y[i + j * stride_of_Y] += sum;
    }
  }
}

/// The same with all columns of X.
/// @param next the p columns of A that come next.
template <std::ptrdiff_t p>
[[gnu::always_inline]] inline void add_blocks(const Columns& A, const Columns& next,
                                              const Columns& X, std::ptrdiff_t columns,
                                              std::ptrdiff_t rows, float* Y,
                                              std::ptrdiff_t stride_of_Y) {
  std::ptrdiff_t j = 0;
  std::ptrdiff_t block = 0;
  for (; j + columns_of_X <= columns; j += columns_of_X) {
    add_block<p, columns_of_X>(A, {X[j], X.stride}, rows, next[block++ % p], Y + j * stride_of_Y,
                               stride_of_Y);
  }
  for (; j < columns; ++j) {
    add_block<p, 1>(A, {X[j], X.stride}, rows, next[block++ % p], Y + j * stride_of_Y, stride_of_Y);
  }
}

/// Adds A^T X to Y for some columns of A, so many rows of Y.
BLOCKLIFT_CLONES
void add_products(const float* A, std::ptrdiff_t columns_in_A, const float* X,
                  std::ptrdiff_t columns_in_X, std::ptrdiff_t n, float* Y) {
  for (std::ptrdiff_t row = 0; row < n; row += rows_together) {
    const std::ptrdiff_t rows = std::min(rows_together, n - row);
    const Columns from_X{X + row, n};
    std::ptrdiff_t i = 0;
    for (; i + columns_of_A <= columns_in_A; i += columns_of_A) {
      const Columns now{A + i * n + row, n};
      const bool is_last = i + 2 * columns_of_A > columns_in_A;
      const Columns next{now[is_last ? 0 : columns_of_A], n};
      add_blocks<columns_of_A>(now, next, from_X, columns_in_X, rows, Y + i, n);
    }
    for (; i < columns_in_A; ++i) {
      const Columns now{A + i * n + row, n};
      add_blocks<1>(now, now, from_X, columns_in_X, rows, Y + i, n);
    }
  }
}

}  // namespace

void multiply_symmetric(const Eigen::MatrixXf& A, const Eigen::MatrixXf& X, Eigen::MatrixXf& Y) {
  const Eigen::Index n = A.rows();
  if (n == 0 || X.cols() == 0) return;
  if (X.cols() == 1) {
    const int size = static_cast<int>(n), one = 1;
    const float alpha = 1.0F, beta = 0.0F;
    ssymv_("L", &size, &alpha, A.data(), &size, X.data(), &one, &beta, Y.data(), &one);
    return;
  }
  Y.setZero();
  const auto multiply_some = [&](int part) {
    const Eigen::Index first = part * columns_together;
    add_products(A.data() + first * n, std::min<Eigen::Index>(columns_together, n - first),
                 X.data(), X.cols(), n, Y.data() + first);
  };
  // Threads are not worth their start below ten million products, half a millisecond.
  const int threads = static_cast<double>(X.size()) * static_cast<double>(n) < 1e7 ? 1 : 0;
  parallel::for_each(static_cast<int>((n + columns_together - 1) / columns_together), threads,
                     multiply_some);
}

}  // namespace blocklift::dynamics
