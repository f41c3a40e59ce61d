#pragma once

#include <complex>
#include <span>

namespace blocklift::dynamics::examples {

/// The resonance w = frequency + i rate of water that swings as Re exp(i w t) by itself, from A +
/// B/(i w) at some frequencies about it (at least six, ascending). There that is r/(w - p) and
/// something smooth, p the resonance; times w - p, with a parabola for what is smooth, it is linear
/// in p and four more constants.
std::complex<double> find_resonance(std::span<const double> frequencies,
                                    std::span<const std::complex<double>> masses);

}  // namespace blocklift::dynamics::examples
