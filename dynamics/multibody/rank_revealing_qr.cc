#include "dynamics/multibody/rank_revealing_qr.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/decompositions.h"

namespace blocklift::dynamics {
namespace {

// Part of the longest column of its group below which a column is zero: far above rounding, far
// below ratios of inertias that occur.
constexpr double zero = 1e-11;

}  // namespace

RankRevealingQr::RankRevealingQr(Eigen::Index rows, Eigen::Index columns)
    : a_(Eigen::MatrixXd::Zero(rows, columns)),
      diagonal_(Eigen::VectorXd::Zero(std::min(rows, columns))),
      beta_(diagonal_),
      scale_(Eigen::VectorXd::Zero(columns)),
      remaining_(scale_),
      reference_(scale_),
      move_(Eigen::VectorXd::Zero(rows)),
      work_(Eigen::VectorXd::Zero(rows)),
      null_(Eigen::MatrixXd::Zero(columns, columns)),
      gram_(null_),
      free_(scale_),
      pivots_(static_cast<std::size_t>(columns)) {}

void RankRevealingQr::scale_columns(const std::vector<char>& group) {
  std::array<double, 2> longest{0.0, 0.0};
  for (Eigen::Index j = 0; j < count_; ++j) {
    scale_[j] = a_.col(j).norm();
    double& most = longest[group[j] != 0 ? 1 : 0];
    most = std::max(most, scale_[j]);
  }
  for (Eigen::Index j = 0; j < count_; ++j) {
    const double most = longest[group[j] != 0 ? 1 : 0];
    const bool is_zero = !(scale_[j] > zero * most);
    scale_[j] = is_zero ? 0.0 : 1.0 / scale_[j];
    a_.col(j) *= scale_[j];
    remaining_[j] = reference_[j] = is_zero ? 0.0 : 1.0;
    pivots_[j] = static_cast<int>(j);
  }
}

void RankRevealingQr::bring_forward(Eigen::Index k) {
  Eigen::Index pivot = k;
  remaining_.segment(k, count_ - k).maxCoeff(&pivot);
  pivot += k;
  if (pivot == k) return;
  a_.col(k).swap(a_.col(pivot));
  std::swap(remaining_[k], remaining_[pivot]);
  std::swap(reference_[k], reference_[pivot]);
  std::swap(pivots_[k], pivots_[pivot]);
}

void RankRevealingQr::reflect(Eigen::Index k) {
  const Eigen::Index n = a_.rows() - k;
  auto v = a_.col(k).tail(n);
  const double length = v.norm();
  diagonal_[k] = v[0] > 0.0 ? -length : length;
  v[0] -= diagonal_[k];
  beta_[k] = 2.0 / v.squaredNorm();
  for (Eigen::Index j = k + 1; j < count_; ++j) {
    if (remaining_[j] == 0.0) continue;
    auto column = a_.col(j).tail(n);
    column -= (beta_[k] * v.dot(column)) * v;
    remaining_[j] -= column[0] * column[0];
    // Where the difference has lost its digits the sum is formed anew.
    if (remaining_[j] < 1e-6 * reference_[j]) {
      remaining_[j] = reference_[j] = column.tail(n - 1).squaredNorm();
    }
  }
}

void RankRevealingQr::factorise(Eigen::Index count, const std::vector<char>& group,
                                double threshold) {
  count_ = count;
  rank_ = 0;
  scale_columns(group);
  const Eigen::Index most = std::min(count_, a_.rows());
  while (rank_ < most) {
    bring_forward(rank_);
    if (!(remaining_[rank_] > threshold * threshold)) break;
    reflect(rank_);
    ++rank_;
  }
}

void RankRevealingQr::apply_reflections(VectorRef x) const {
  for (Eigen::Index k = 0; k < rank_; ++k) {
    const auto v = a_.col(k).tail(a_.rows() - k);
    auto tail = x.tail(a_.rows() - k);
    tail -= (beta_[k] * v.dot(tail)) * v;
  }
}

void RankRevealingQr::apply_reflections_backwards(VectorRef x) const {
  for (Eigen::Index k = rank_; k-- > 0;) {
    const auto v = a_.col(k).tail(a_.rows() - k);
    auto tail = x.tail(a_.rows() - k);
    tail -= (beta_[k] * v.dot(tail)) * v;
  }
}

void RankRevealingQr::correct(ConstVectorRef b, VectorRef x) {
  work_ = x;
  apply_reflections(work_);
  // R11^T z = b of the independent columns.
  for (Eigen::Index k = 0; k < rank_; ++k) {
    const int column = pivots_[k];
    const double sum = b[column] * scale_[column] - a_.col(k).head(k).dot(move_.head(k));
    move_[k] = sum / diagonal_[k];
  }
  move_.head(rank_) -= work_.head(rank_);
  move_.tail(a_.rows() - rank_).setZero();
  work_ = move_;
  apply_reflections_backwards(work_);
  x += work_;
}

void RankRevealingQr::multipliers(VectorRef y) {
  y.setZero();
  // R11 y1 = z, by columns.
  work_.head(rank_) = move_.head(rank_);
  for (Eigen::Index k = rank_; k-- > 0;) {
    work_[k] /= diagonal_[k];
    work_.head(k) -= work_[k] * a_.col(k).head(k);
  }
  for (Eigen::Index k = 0; k < rank_; ++k) {
    const int column = pivots_[k];
    y[column] = scale_[column] * work_[k];
  }
  if (rank_ < count_) solve_minimum_norm(y);
}

void RankRevealingQr::combination(Eigen::Index i, VectorRef c) const {
  const Eigen::Index j = rank_ + i;
  const int dependent = pivots_[j];
  c = a_.col(j).head(rank_);
  for (Eigen::Index k = rank_; k-- > 0;) {
    c[k] /= diagonal_[k];
    c.head(k) -= c[k] * a_.col(k).head(k);
  }
  for (Eigen::Index k = 0; k < rank_; ++k) {
    c[k] *= scale_[pivots_[k]] / scale_[dependent];
  }
}

// Of all y + N c with A N = 0 the shortest. Each column of N has a one at its dependent column.
void RankRevealingQr::solve_minimum_norm(VectorRef y) {
  Eigen::Index dependent = 0;
  for (Eigen::Index j = rank_; j < count_; ++j) {
    if (is_zero(pivots_[j])) continue;
    combination(j - rank_, null_.col(dependent).head(rank_));
    null_(rank_, dependent) = static_cast<double>(j);  // remembered; the row is of no other use
    ++dependent;
  }
  if (dependent == 0) return;
  for (Eigen::Index i = 0; i < dependent; ++i) {
    double& right = free_[i];
    right = 0.0;
    for (Eigen::Index k = 0; k < rank_; ++k) {
      right += null_(k, i) * y[pivots_[k]];
    }
    for (Eigen::Index j = 0; j <= i; ++j) {
      gram_(i, j) = null_.col(i).head(rank_).dot(null_.col(j).head(rank_)) + (i == j ? 1.0 : 0.0);
    }
  }
  // Gram = 1 + C^T C is well conditioned from below: plain Cholesky.
  Eigen::Ref<Eigen::MatrixXd> gram = gram_.topLeftCorner(dependent, dependent);
  auto c = free_.head(dependent);
  algebra::solve_positive_definite_in_place(gram, c);
  for (Eigen::Index i = 0; i < dependent; ++i) {
    const auto j = static_cast<std::size_t>(null_(rank_, i));
    y[pivots_[j]] = c[i];
    for (Eigen::Index k = 0; k < rank_; ++k) {
      y[pivots_[k]] -= null_(k, i) * c[i];
    }
  }
}

Eigen::MatrixXd RankRevealingQr::columns_of_q(Eigen::Index first, Eigen::Index count) const {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(a_.rows(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    columns(first + i, i) = 1.0;
    apply_reflections_backwards(columns.col(i));
  }
  return columns;
}

Eigen::MatrixXd RankRevealingQr::complement() const {
  return columns_of_q(rank_, a_.rows() - rank_);
}

Eigen::MatrixXd RankRevealingQr::range() const { return columns_of_q(0, rank_); }

}  // namespace blocklift::dynamics
