#pragma once

#include <string>
#include <vector>

namespace blocklift::pipeline {

/// A curve of a chart.
struct Curve {
  std::string name;  ///< in the legend; empty: none
  std::vector<double> x, y;
};

/// Curves over a common axis.
struct LineChart {
  std::string title;
  std::string x_label, y_label;
  std::vector<Curve> curves;
  std::vector<double> y_figures = {};  ///< that mark the y axis, ascending; empty: round ones
  bool legend_outside = false;         ///< right of the frame, for curves that fill it
};

/// The chart as SVG for a page: axes with round figures, one colour a curve, a legend.
/// Numbers that are not finite leave a gap.
std::string to_svg(const LineChart& chart);

/// Round figures (1, 2 or 5 times a power of ten apart) that span the values, about `count` of
/// them.
std::vector<double> round_figures(double lowest, double highest, int count);

}  // namespace blocklift::pipeline
