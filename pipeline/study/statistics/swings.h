#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"

namespace blocklift::pipeline {

/// How far a figure goes, in its own unit, while one input goes through the middle 90 % of its
/// values and the others stay: the bar of a tornado chart.
struct Swing {
  double from = 0, to = 0;  ///< 5 % and 95 % values of the input
  /// Slope of the figure on the input, times (to - from). Not a number where it is not known.
  double value = 0;
  /// Interval of 95 % of a straight line with independent residuals; not numbers where no residual
  /// is left to judge by.
  double low = 0, high = 0;
};

/// Swings of a figure on all inputs of a study.
struct Swings {
  std::vector<Swing> of;  ///< each input
  /// Of the figure's variance, how much the straight lines leave nothing of (R squared). Far below
  /// 1 the figure bends, the inputs act together, or something else moves it. 1 of a figure that
  /// does not vary; not a number where swings are not known.
  double linear_share = std::numeric_limits<double>::quiet_NaN();

  /// Places of the inputs, the largest swing first, whatever its sign; what is not known last.
  std::vector<std::size_t> by_size() const;
};

/// Finds the slopes of a figure on all inputs together, by least squares: what two inputs have in
/// common by chance, or by a correlation, is not counted twice. The swing of an input whose range
/// is one value is 0. That of another is not known if it took one value in all members, and none is
/// where the members do not tell the inputs apart: there are too few, or two inputs go together.
///
/// @param values of the figure. @param members their numbers: rows of the design.
/// Source: Draper and Smith (1998), Applied Regression Analysis, sections 5.1 and 5.2.
Swings find_swings(const StudyFile& study, const Eigen::MatrixXd& design,
                   const std::vector<double>& values, const std::vector<int>& members);

}  // namespace blocklift::pipeline
