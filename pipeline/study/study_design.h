#pragma once

#include <string>
#include <utility>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"

namespace blocklift::pipeline {

/// The values of all members: a member a row, a variable a column, SI units. The same study gives
/// the same values on every machine. Rows of a sensitivity are those of Saltelli's two samples,
/// then of the first with a column after another of the second (Saltelli 2002). Of a search they
/// are the sample with which it begins. Correlated values are joined by copulas; a Latin hypercube
/// keeps its strata.
///
/// @throws InputError, with the variable's place, if a law cannot be what it is asked to be.
Eigen::MatrixXd make_design(const StudyFile& study);

/// "9.98 m": a value of a variable as a key has it, in SI units.
std::string value_text(const StudyVariable& variable, double value, int digits = 15);
/// "273.5 MN", "18 deg": the same for people, angles in degrees, forces, moments, stiffnesses,
/// stresses and masses in the multiple of their size.
std::string shown_value(const StudyVariable& variable, double value, int digits);

/// The dimension's unit of a variable's values, as UDUNITS reads it; empty for plain numbers.
std::string unit_text(const StudyVariable& variable);

/// The values of a variable between which the middle 90 % of all members lie, in SI units: of its
/// law, or of its listed values, each as likely as the others.
std::pair<double, double> middle_range(const StudyVariable& variable);

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
