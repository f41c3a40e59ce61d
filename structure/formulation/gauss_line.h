#pragma once

#include <vector>

namespace blocklift::structure {

/// Gauss points on [0, 1].
std::vector<double> gauss_places(int count);

/// Lagrange polynomials through places at x.
std::vector<double> lagrange_at(const std::vector<double>& places, double x);

}  // namespace blocklift::structure
