#pragma once

#include <vector>

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// Householder factorisation with column pivoting of a matrix A (rows x columns) of any rank: A P =
/// Q R.
///
/// Columns are scaled to unit length first. A column counts as zero where its length is below a
/// part of 1e-11 of the longest of its group (groups hold columns of one unit), and as dependent on
/// those before it where what is left of it is below the threshold. All memory is taken by the
/// constructor. Source: Golub and Van Loan (2013), section 5.4.2.
///
/// Why not Eigen's: of its decompositions only the complete orthogonal one has the same answers
/// where columns depend on others (equal to 4e-15; those of column pivoting alone are then wrong).
/// It takes memory for each solution and does not scale columns. For both answers, correct() and
/// multipliers(), of a matrix of 6 x 3, 7 x 6, 12 x 10 (rank 7) and 40 x 30 (rank 24) it takes
/// 0.70, 1.36, 3.1 and 18.7 us of processor time, this one 0.26, 0.60, 1.27 and 11.9 us with the
/// scaling (medians of five, 2.1 GHz, tests/benchmarks/rank_revealing_benchmark.cc).
class RankRevealingQr {
 public:
  RankRevealingQr(Eigen::Index rows, Eigen::Index largest_columns);

  Eigen::Index rows() const { return a_.rows(); }
  /// The matrix to be filled before factorise().
  Eigen::Block<Eigen::MatrixXd, Eigen::Dynamic, Eigen::Dynamic, true> columns(Eigen::Index count) {
    return a_.leftCols(count);
  }
  /// `group`: one entry a column, 0 or 1.
  void factorise(Eigen::Index count, const std::vector<char>& group, double threshold);

  Eigen::Index rank() const { return rank_; }
  Eigen::Index column_count() const { return count_; }
  /// Columns in the order of elimination: the first rank() of them are independent.
  const std::vector<int>& pivots() const { return pivots_; }
  /// Did this column count as zero?
  bool is_zero(int column) const { return scale_[column] == 0.0; }

  /// Moves x (rows) the shortest way to where a_j . x = b_j for the independent columns a_j.
  void correct(ConstVectorRef b, VectorRef x);
  /// Least y (columns) with A y = the move that correct() made last; zero for columns that are
  /// zero.
  void multipliers(VectorRef y);
  /// Coefficients c of the combination of independent columns that a dependent column is:
  /// a_(pivot rank + i) = sum c_k a_(pivot k). c: rank() entries.
  void combination(Eigen::Index i, VectorRef c) const;
  /// The other columns of Q: an orthonormal basis of what is perpendicular to all columns, rows x
  /// (rows - rank).
  Eigen::MatrixXd complement() const;
  /// The first rank() columns of Q: an orthonormal basis of the columns, rows x rank.
  Eigen::MatrixXd range() const;

 private:
  Eigen::MatrixXd columns_of_q(Eigen::Index first, Eigen::Index count) const;
  void scale_columns(const std::vector<char>& group);
  void bring_forward(Eigen::Index k);
  void reflect(Eigen::Index k);
  void apply_reflections(VectorRef x) const;            // Q^T x
  void apply_reflections_backwards(VectorRef x) const;  // Q x
  void solve_minimum_norm(VectorRef y);

  Eigen::MatrixXd a_;          ///< R above, reflectors below the diagonal
  Eigen::VectorXd diagonal_;   ///< of R
  Eigen::VectorXd beta_;       ///< 2 / |reflector|^2
  Eigen::VectorXd scale_;      ///< 1 / length of each column as given; 0: zero
  Eigen::VectorXd remaining_;  ///< squared length of what is left of each column
  Eigen::VectorXd reference_;  ///< the same when it was last summed up
  Eigen::VectorXd move_;       ///< Q^T of the last correction
  Eigen::VectorXd work_;
  Eigen::MatrixXd null_;  ///< R11^-1 R12
  Eigen::MatrixXd gram_;
  Eigen::VectorXd free_;
  std::vector<int> pivots_;
  Eigen::Index count_ = 0;
  Eigen::Index rank_ = 0;
};

}  // namespace blocklift::dynamics
