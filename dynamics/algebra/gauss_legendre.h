#pragma once

#include <vector>

namespace blocklift::dynamics {

/// Points and weights of a rule for integrals.
struct QuadratureRule {
  std::vector<double> points, weights;
};

/// Gauss and Legendre's rule of any order on [-1, 1], exact for polynomials up to 2 n - 1. The
/// points are mirrored exactly: an even order takes the principal value of what has a pole of first
/// order in the middle. The zeros by Newton's method from Tricomi's approximation (1950).
QuadratureRule make_gauss_legendre(int order);

}  // namespace blocklift::dynamics
