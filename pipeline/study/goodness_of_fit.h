#pragma once

#include <vector>

namespace blocklift::pipeline {

/// Anderson and Darling's A^2 of n values of a law, from the shares of the law below each: how far
/// the sample's distribution lies from the law's, squared, with weight on both ends. It is not
/// finite where a share is 0 or 1.
/// @param shares in any order, one at least.
double anderson_darling(std::vector<double> shares);

/// The probability that a sample of a law, of which location and scale were fitted to it, lies as
/// far from its fit by A^2, or farther. A law that was fitted lies nearer than one that is known, so
/// that tables of the latter do not hold: it is the probability of a sum of squares of independent
/// normal values, weighted by the eigenvalues of the covariance of the sample's distribution about
/// its fit (Durbin 1973). It is that of many values; of 30 it is as good, tests say.
/// The 5 % value is 0.757 (Stephens 1977, table 1).
double p_of_gumbel_fit(double anderson_darling);
/// The same of a Pareto tail with its scale and shape fitted (Choulakian and Stephens 2001), which
/// depends on the shape: of one from -1/2 on.
double p_of_pareto_fit(double anderson_darling, double shape);

}  // namespace blocklift::pipeline
