#include "structure/system/linear_solver.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/limits.h"
#include "structure/system/cholesky_factor.h"
#include "structure/system/shared_factor.h"

namespace blocklift::structure {

struct ConstrainedSystem::Factor {
  std::optional<CholeskyFactor> own;
  std::optional<SharedFactor> shared;  ///< where a team of processes is there
  Eigen::VectorXd held;                ///< diagonal of the stiffness
};

double available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("MemAvailable:", 0) == 0)
      return std::min(1024 * std::stod(line.substr(13)), memory_within_limit());
  return memory_within_limit();
}

double memory_for(double bytes) {
  const double available = available_memory();
#if defined(__GLIBC__)
  if (available < bytes && ::malloc_trim(0) == 1) return available_memory();
#endif
  return available;
}

ConstrainedSystem::ConstrainedSystem(SparseLower&& stiffness, std::vector<FixedUnknown> fixed)
    : fixed_(std::move(fixed)), factor_(new Factor) {
  stiffness_.swap(stiffness);  // Eigen's sparse matrices do not move, they copy
  separate_fixed();
  factor_->held = stiffness_.diagonal();
  if (const FactorTeam* team = FactorTeam::present()) {
    factor_->shared.emplace(*team, stiffness_);
    SparseLower().swap(stiffness_);  // each process has its part
    return;
  }
  factor_->own.emplace(stiffness_);
  const double needed = 1.3 * factor_bytes(), available = memory_for(needed);
  if (needed > available)
    throw NotEnoughMemory(fmt::format(
        "factorising {} unknowns needs about {:.1f} GB and {:.1f} GB are free; use larger elements "
        "or a lower element degree",
        stiffness_.rows(), needed / 1e9, available / 1e9));
}

ConstrainedSystem::~ConstrainedSystem() = default;

double ConstrainedSystem::factor_bytes() const {
  return factor_->shared ? factor_->shared->bytes() : factor_->own->bytes();
}

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
  if (factor_->shared) return factor_->shared->factorise(factor_->held);
  factor_->own->factorise(stiffness_, factor_->held);
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
  Eigen::MatrixXd displacements =
      factor_->shared ? factor_->shared->solve(loads) : factor_->own->solve(std::move(loads));
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
