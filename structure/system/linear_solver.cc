#include "structure/system/linear_solver.h"

#include <SuiteSparse_config.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/CholmodSupport>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/large_pages.h"
#include "structure/limits.h"

namespace blocklift::structure {

namespace {

void* allocate_in_large_pages(std::size_t bytes) {
  void* const memory = std::malloc(bytes);
  prefer_large_pages(memory, bytes);
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

struct ConstrainedSystem::Factor : public Eigen::CholmodSupernodalLLT<SparseLower, Eigen::Lower> {
  Factor() {
    let_cholmod_use_large_pages();
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_NATURAL;
    cholmod().postorder = 0;  // the unknowns come in postorder already
    cholmod().print = 0;
  }
  /// Eigen does not ask whether CHOLMOD found the memory for its analysis.
  bool is_analysed() const { return m_cholmodFactor != nullptr; }
  bool is_short_of_memory() { return cholmod().status == CHOLMOD_OUT_OF_MEMORY; }
  double bytes() const {
    return 8.0 * static_cast<double>(m_cholmodFactor->xsize) +
           8.0 * static_cast<double>(m_cholmodFactor->ssize);
  }
  /// The column at which the matrix ceased to be positive definite; the number of columns if none.
  Eigen::Index first_failure() const { return static_cast<Eigen::Index>(m_cholmodFactor->minor); }
  /// Diagonal of L. Source: CHOLMOD's user guide, the supernodal factor.
  Eigen::VectorXd diagonal() const {
    const cholmod_factor& factor = *m_cholmodFactor;
    Eigen::VectorXd values(static_cast<Eigen::Index>(factor.n));
    const auto* super = static_cast<const long*>(factor.super);
    const auto* rows = static_cast<const long*>(factor.pi);
    const auto* start = static_cast<const long*>(factor.px);
    const auto* entries = static_cast<const double*>(factor.x);
    for (std::size_t s = 0; s < factor.nsuper; ++s)
      for (long column = super[s]; column < super[s + 1]; ++column)
        values[column] = entries[start[s] + (column - super[s]) * (rows[s + 1] - rows[s] + 1)];
    return values;
  }
};

double available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("MemAvailable:", 0) == 0)
      return std::min(1024 * std::stod(line.substr(13)), memory_within_limit());
  return memory_within_limit();
}

ConstrainedSystem::ConstrainedSystem(SparseLower&& stiffness, std::vector<FixedUnknown> fixed)
    : fixed_(std::move(fixed)), factor_(new Factor) {
  stiffness_.swap(stiffness);  // Eigen's sparse matrices do not move, they copy
  separate_fixed();
  factor_->analyzePattern(stiffness_);
  if (!factor_->is_analysed())
    throw NotEnoughMemory(
        fmt::format("the memory did not suffice to analyse the stiffness matrix of {} unknowns for "
                    "its factorisation",
                    stiffness_.rows()));
  const double needed = 1.3 * factor_bytes(), available = available_memory();
  if (needed > available)
    throw NotEnoughMemory(fmt::format(
        "factorising {} unknowns needs about {:.1f} GB and {:.1f} GB are free; use larger elements "
        "or a lower element degree",
        stiffness_.rows(), needed / 1e9, available / 1e9));
}

ConstrainedSystem::~ConstrainedSystem() = default;

double ConstrainedSystem::factor_bytes() const { return factor_->bytes(); }

// Keeps the rows of fixed unknowns aside, empties them in the matrix and leaves their diagonal.
void ConstrainedSystem::separate_fixed() {
  std::vector<int> place(static_cast<std::size_t>(stiffness_.rows()), -1);
  for (std::size_t i = 0; i < fixed_.size(); ++i) place[fixed_[i].unknown] = static_cast<int>(i);
  std::vector<long> ascending;
  for (const FixedUnknown& fixed : fixed_) ascending.push_back(fixed.unknown);
  std::sort(ascending.begin(), ascending.end());
  std::vector<Eigen::Triplet<double, long>> rows;
  const auto take = [&](long column, long entry) {
    const long row = stiffness_.innerIndexPtr()[entry];
    double& value = stiffness_.valuePtr()[entry];
    const int of_row = place[row];
    const int of_column = place[column];
    if (of_row >= 0) rows.emplace_back(of_row, column, value);
    if (row == column) return;
    if (of_column >= 0) rows.emplace_back(of_column, row, value);
    value = 0;
  };
  for (long column = 0; column < stiffness_.cols(); ++column) {
    const long *start = stiffness_.innerIndexPtr() + stiffness_.outerIndexPtr()[column],
               *end = stiffness_.innerIndexPtr() + stiffness_.outerIndexPtr()[column + 1];
    if (start == end) continue;
    if (place[column] >= 0) {
      for (const long* row = start; row != end; ++row)
        take(column, row - stiffness_.innerIndexPtr());
      continue;
    }
    // Rows ascend: those of fixed unknowns are looked up, most columns have none.
    auto fixed = std::lower_bound(ascending.begin(), ascending.end(), *start);
    for (const long* row = start; fixed != ascending.end() && *fixed <= *(end - 1); ++fixed) {
      row = std::lower_bound(row, end, *fixed);
      if (*row == *fixed) take(column, row - stiffness_.innerIndexPtr());
    }
  }
  fixed_rows_.resize(static_cast<long>(fixed_.size()), stiffness_.cols());
  fixed_rows_.setFromTriplets(rows.begin(), rows.end());
}

void ConstrainedSystem::factorise() {
  const Eigen::VectorXd stiffness = stiffness_.diagonal();
  factor_->factorize(stiffness_);
  if (factor_->is_short_of_memory())
    throw NotEnoughMemory(fmt::format(
        "the memory did not suffice to factorise the stiffness matrix of {} unknowns; use larger "
        "elements or a lower element degree",
        stiffness_.rows()));
  const char* const loose =
      "the stiffness matrix is not positive definite: the supports leave a part free to move";
  if (factor_->info() != Eigen::Success)
    throw LooseUnknown(loose, static_cast<int>(factor_->first_failure()));
  // What is left of an unknown's stiffness where nothing resists it: rounding, some tens of the
  // unit of it. Slender blocks leave 1e-9 and more.
  constexpr double rounding = 1e-14;
  Eigen::Index least = 0;
  const double left = (factor_->diagonal().array().square() / stiffness.array()).minCoeff(&least);
  if (!(left > rounding)) throw LooseUnknown(loose, static_cast<int>(least));
  SparseLower().swap(stiffness_);
}

Eigen::MatrixXd ConstrainedSystem::solve(Eigen::MatrixXd loads) const {
  Eigen::VectorXd given(static_cast<Eigen::Index>(fixed_.size()));
  for (std::size_t i = 0; i < fixed_.size(); ++i) given[i] = fixed_[i].value;
  const Eigen::Index columns = loads.cols();
  return solve(std::move(loads), given.replicate(1, columns));
}

Eigen::MatrixXd ConstrainedSystem::solve(Eigen::MatrixXd loads,
                                         const Eigen::MatrixXd& given) const {
  if (!given.isZero(0)) loads -= fixed_rows_.transpose() * given;
  for (const FixedUnknown& fixed : fixed_) loads.row(fixed.unknown).setZero();
  Eigen::MatrixXd displacements = factor_->solve(loads);
  if (factor_->info() != Eigen::Success)
    throw NotEnoughMemory(
        fmt::format("the memory did not suffice to solve for {} loads", loads.cols()));
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    displacements.row(fixed_[i].unknown) = given.row(i);
  return displacements;
}

Eigen::MatrixXd ConstrainedSystem::reactions(const Eigen::MatrixXd& displacements,
                                             const Eigen::MatrixXd& loads) const {
  Eigen::MatrixXd forces = fixed_rows_ * displacements;
  for (std::size_t i = 0; i < fixed_.size(); ++i) forces.row(i) -= loads.row(fixed_[i].unknown);
  return forces;
}

}  // namespace blocklift::structure
