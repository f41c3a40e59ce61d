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

}  // namespace blocklift::pipeline
