#include "structure/system/cholesky_factor.h"

#include <SuiteSparse_config.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

#include <Eigen/CholmodSupport>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/large_pages.h"
#include "structure/system/linear_solver.h"
#include "structure/system/supernodal_factorisation.h"
#include "structure/system/supernodal_solution.h"

namespace blocklift::structure {

namespace {

void* allocate_in_large_pages(std::size_t bytes) {
  void* const memory = std::malloc(bytes);
  prefer_large_pages(memory, bytes);
  take_pages(memory, bytes);
  return memory;
}

/// The factor is the largest there is of a block.
void let_cholmod_use_large_pages() {
  static const bool once = [] {
    SuiteSparse_config.malloc_func = allocate_in_large_pages;
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace

// Source of the supernodal factor's arrays: CHOLMOD's user guide.
struct CholeskyFactor::Implementation
    : public Eigen::CholmodSupernodalLLT<SparseLower, Eigen::Lower> {
  Implementation() {
    let_cholmod_use_large_pages();
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_NATURAL;
    cholmod().postorder = 0;  // the unknowns come in postorder already
    cholmod().print = 0;
  }

  /// Values of the factor, which are yet to be written; null where the memory did not suffice.
  double* make_values() {
    if (factor().xtype == CHOLMOD_PATTERN)
      cholmod_l_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, m_cholmodFactor, &cholmod());
    return static_cast<double*>(factor().x);
  }
  const cholmod_factor& factor() const { return *m_cholmodFactor; }
  /// Eigen does not ask whether CHOLMOD found the memory for its analysis.
  bool is_analysed() const { return m_cholmodFactor != nullptr; }

  const long* first_columns() const { return static_cast<const long*>(factor().super); }
  const long* row_starts() const { return static_cast<const long*>(factor().pi); }
  const long* value_starts() const { return static_cast<const long*>(factor().px); }
  const long* rows() const { return static_cast<const long*>(factor().s); }
  const double* values() const { return static_cast<const double*>(factor().x); }

  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(factor().n));
    for (std::size_t s = 0; s < factor().nsuper; ++s) {
      const long height = row_starts()[s + 1] - row_starts()[s], first = first_columns()[s];
      for (long column = first; column < first_columns()[s + 1]; ++column)
        result[column] = values()[value_starts()[s] + (column - first) * (height + 1)];
    }
    return result;
  }

  SupernodalPattern pattern;
};

CholeskyFactor::CholeskyFactor(const SparseLower& matrix) : implementation_(new Implementation) {
  implementation_->analyzePattern(matrix);
  if (!implementation_->is_analysed())
    throw NotEnoughMemory(
        fmt::format("the memory did not suffice to analyse the stiffness matrix of {} unknowns for "
                    "its factorisation",
                    matrix.rows()));
  implementation_->pattern = {supernodes(), implementation_->row_starts(),
                              implementation_->value_starts(), implementation_->rows()};
}

CholeskyFactor::~CholeskyFactor() = default;

double CholeskyFactor::bytes() const {
  const cholmod_factor& factor = implementation_->factor();
  return 8.0 * static_cast<double>(factor.xsize) + 8.0 * static_cast<double>(factor.ssize);
}

std::vector<Supernode> CholeskyFactor::supernodes() const {
  const Implementation& of = *implementation_;
  const auto count = static_cast<int>(of.factor().nsuper);
  std::vector<int> supernode_of(of.factor().n);
  for (int s = 0; s < count; ++s)
    std::fill(supernode_of.begin() + of.first_columns()[s],
              supernode_of.begin() + of.first_columns()[s + 1], s);
  std::vector<Supernode> all;
  for (int s = 0; s < count; ++s) {
    const long first = of.first_columns()[s], columns = of.first_columns()[s + 1] - first;
    const long start = of.row_starts()[s], rows = of.row_starts()[s + 1] - start;
    all.push_back(
        {first, columns, rows, rows > columns ? supernode_of[of.rows()[start + columns]] : -1});
  }
  return all;
}

void CholeskyFactor::factorise(const SparseLower& matrix, const Eigen::VectorXd& held,
                               int threads) {
  Implementation& factor = *implementation_;
  const auto refuse = [&] {
    throw NotEnoughMemory(fmt::format(
        "the memory did not suffice to factorise the stiffness matrix of {} unknowns; use larger "
        "elements or a lower element degree",
        matrix.rows()));
  };
  double* const values = factor.make_values();
  if (values == nullptr) refuse();
  const char* const loose =
      "the stiffness matrix is not positive definite: the supports leave a part free to move";
  long failed = 0;
  try {
    failed = factorise_supernodes(factor.pattern, matrix, values, threads);
  } catch (const std::bad_alloc&) {
    refuse();
  }
  if (failed < matrix.cols()) throw LooseUnknown(loose, static_cast<int>(failed));
  // What is left of an unknown's stiffness where nothing resists it: rounding, some tens of the
  // unit of it. Slender blocks leave 1e-9 and more.
  constexpr double rounding = 1e-14;
  Eigen::Index least = 0;
  const double left = (factor.diagonal().array().square() / held.array()).minCoeff(&least);
  if (!(left > rounding)) throw LooseUnknown(loose, static_cast<int>(least));
}

Eigen::MatrixXd CholeskyFactor::solve(Eigen::MatrixXd loads) const {
  return solve_upper(solve_lower(std::move(loads)));
}

Eigen::MatrixXd CholeskyFactor::solve_lower(Eigen::MatrixXd loads) const {
  structure::solve_lower(implementation_->pattern, implementation_->values(), loads);
  return loads;
}

Eigen::MatrixXd CholeskyFactor::solve_upper(Eigen::MatrixXd reduced) const {
  structure::solve_upper(implementation_->pattern, implementation_->values(), reduced);
  return reduced;
}

Eigen::MatrixXd CholeskyFactor::corner(long first) const {
  const Implementation& of = *implementation_;
  const auto size = static_cast<long>(of.factor().n) - first;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t s = 0; s < of.factor().nsuper; ++s) {
    const long* const rows = of.rows() + of.row_starts()[s];
    const long height = of.row_starts()[s + 1] - of.row_starts()[s];
    for (long column = std::max(first, of.first_columns()[s]); column < of.first_columns()[s + 1];
         ++column) {
      const long k = column - of.first_columns()[s];
      const double* const values = of.values() + of.value_starts()[s] + k * height;
      for (long r = k; r < height; ++r) result(rows[r] - first, column - first) = values[r];
    }
  }
  return result;
}

}  // namespace blocklift::structure
