#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace blocklift::dynamics {

/// Reproducible random numbers: the same seed gives the same sea and the same gusts with every
/// compiler and library.
///
/// The engine is std::mt19937_64, whose sequence the C++ standard fixes; what the standard leaves
/// open (its distributions) is not used. A uniform number takes the upper 53 bits of one draw.
class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Uniform in [0, 2 pi), rad.
  double phase() { return 2.0 * std::numbers::pi * uniform(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace blocklift::dynamics
