#include "structure/system/supernodal_solution.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "algebra/cholesky_steps.h"
#include "algebra/products.h"
#include "parallel/blas_threads.h"
#include "parallel/threads.h"

namespace blocklift::structure {

namespace {

using Columns = Eigen::Ref<Eigen::MatrixXd>;
using Entries = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// A supernode's entries and its rows below its columns.
struct Step {
  Entries own, below;
  const long* rows;
};

Step step_of(const SupernodalPattern& pattern, const double* values, std::size_t s) {
  const Supernode& of = pattern.supernodes[s];
  const double* const first = values + pattern.value_starts[s];
  const Eigen::OuterStride<> height(of.rows);
  return {{first, of.columns, of.columns, height},
          {first + of.columns, of.rows - of.columns, of.columns, height},
          pattern.rows + pattern.row_starts[s] + of.columns};
}

long most_rows_below(const SupernodalPattern& pattern) {
  long most = 0;
  for (const Supernode& supernode : pattern.supernodes)
    most = std::max(most, supernode.rows - supernode.columns);
  return most;
}

/// work(columns, memory for rows below): so many columns at a time that reading the factor anew for
/// each few costs little.
void in_columns(const SupernodalPattern& pattern, Eigen::MatrixXd& all, int threads,
                const std::function<void(Columns, Eigen::MatrixXd&)>& work) {
  constexpr int at_once = 16;
  const parallel::OneBlasThread whatever_the_threads;
  const auto count = static_cast<int>(all.cols());
  const long most = most_rows_below(pattern);
  parallel::for_each((count + at_once - 1) / at_once, threads, [&](int part) {
    const int first = part * at_once, columns = std::min(at_once, count - first);
    Eigen::MatrixXd below(most, columns);
    work(all.middleCols(first, columns), below);
  });
}

}  // namespace

void solve_lower(const SupernodalPattern& pattern, const double* values, Eigen::MatrixXd& loads,
                 int threads) {
  in_columns(pattern, loads, threads, [&](Columns x, Eigen::MatrixXd& memory) {
    for (std::size_t s = 0; s < pattern.supernodes.size(); ++s) {
      const Step step = step_of(pattern, values, s);
      auto solved = x.middleRows(pattern.supernodes[s].first, step.own.cols());
      algebra::divide_by_lower(step.own, solved);
      auto taken = memory.topRows(step.below.rows());
      algebra::multiply(step.below, solved, taken);
      for (Eigen::Index c = 0; c < x.cols(); ++c)
        for (Eigen::Index i = 0; i < taken.rows(); ++i) x(step.rows[i], c) -= taken(i, c);
    }
  });
}

void solve_upper(const SupernodalPattern& pattern, const double* values, Eigen::MatrixXd& reduced,
                 int threads) {
  in_columns(pattern, reduced, threads, [&](Columns x, Eigen::MatrixXd& memory) {
    for (std::size_t s = pattern.supernodes.size(); s-- > 0;) {
      const Step step = step_of(pattern, values, s);
      auto known = memory.topRows(step.below.rows());
      for (Eigen::Index c = 0; c < x.cols(); ++c)
        for (Eigen::Index i = 0; i < known.rows(); ++i) known(i, c) = x(step.rows[i], c);
      auto sought = x.middleRows(pattern.supernodes[s].first, step.own.cols());
      algebra::subtract_transposed_by(step.below, known, sought);
      algebra::divide_by_upper(step.own, sought);
    }
  });
}

}  // namespace blocklift::structure
