#pragma once

#include <vector>

namespace blocklift::algebra {

/// Quantile of a sample, linear between its values in their order: the smallest has the share 0,
/// the largest 1, those between at equal steps (Hyndman and Fan 1996, definition 7).
/// @param values that are numbers, in any order; one at least.
/// @param share from 0 to 1; 0.5: the median.
double quantile_of(std::vector<double> values, double share);

/// The same of values that rise already.
double quantile_of_sorted(const std::vector<double>& values, double share);

}  // namespace blocklift::algebra
