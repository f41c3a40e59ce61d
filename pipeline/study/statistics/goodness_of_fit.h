#pragma once

#include <vector>

namespace blocklift::pipeline {

/// Anderson and Darling's A^2 of n values of a law, from the shares of the law below each: how far
/// the sample's distribution lies from the law's, squared, with weight on both ends. It is not
/// finite where a share is 0 or 1.
/// @param shares in any order, one at least.
double anderson_darling(std::vector<double> shares);

/// The probability that a sample of a law, of which location and scale were fitted to it, lies as
/// far from its fit by A^2, or farther. A law that was fitted lies nearer than one that is known,
/// so that tables of the latter do not hold: it is the probability of a sum of squares of
/// independent normal values, weighted by the eigenvalues of the covariance of the sample's
/// distribution about its fit (Durbin 1973). It is that of many values, of which the 5 % value is
/// 0.757 (Stephens 1977). Of 30, 60 and 300 values of a Gumbel law it is below 0.05 in 3.3 %, 6.2 %
/// and 4.8 % of 400 samples (interval_coverage_test).
double p_of_gumbel_fit(double anderson_darling);
/// The same of a Pareto tail with its scale and shape fitted (Choulakian and Stephens 2001), which
/// depends on the shape: of one from -1/2 on. Of 30 excesses of shapes from -0.3 to 0.5 it is below
/// 0.05 in 3.0 to 3.7 % of 400 samples, of 100 in 3.5 to 4.5 %.
double p_of_pareto_fit(double anderson_darling, double shape);

}  // namespace blocklift::pipeline
