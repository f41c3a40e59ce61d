#pragma once

#include <Eigen/Core>

namespace blocklift::pipeline {

/// Sobol' indices of a figure: how much of its variance each variable has by itself, and with all
/// others together. With y of sample A, of B, and of A with the variable's column of B (E), less
/// their means and over their deviations: yE = first yB + (1 - total) yA by least squares, which
/// takes off what A and B have in common by chance (Glen and Isaacs 2012). Without that the indices
/// would be Martinez' corr(yB, yE) and 1 - corr(yA, yE) (2011). A variable that does nothing has
/// both indices 0.
///
/// The intervals of 95 % are those between the percentiles of a bootstrap of base members (Archer,
/// Saltelli and Sobol 1997), so that they lie where a correlation can. An index, or an end of its
/// interval, is not a number where figures do not vary: all of them, one of the samples, or those
/// of most resamples; all are of fewer base members than fewest_for_sobol_indices.
struct Sensitivity {
  Eigen::VectorXd first, first_low, first_high;
  Eigen::VectorXd total, total_low, total_high;
  int members = 0;  ///< base members of which all lifts have the figure: the others are left out
};

/// @param design as make_design gives it for a sensitivity. @param figure of its members; not a
/// number of those that failed. @param members the size of a sample.
Sensitivity find_sensitivity(const Eigen::MatrixXd& design, const Eigen::VectorXd& figure,
                             int members);

}  // namespace blocklift::pipeline
