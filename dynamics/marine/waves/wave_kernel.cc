#include "dynamics/marine/waves/wave_kernel.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "dynamics/instruction_sets.h"

namespace blocklift::dynamics {

namespace {

// Adding this rounds a double to an integer, which then stands in the low bits.
constexpr double rounding = 0x1.8p52;

[[gnu::always_inline]] inline double polynomial_cosine(double x) {
  // x = n pi/2 + r, pi/2 in three parts (Cody and Waite 1980), |r| <= pi/4.
  constexpr double part1 = 0x1.921fb544p0;
  constexpr double part2 = 0x1.0b4611a6p-34;
  constexpr double part3 = 0x1.3198a2e037073p-69;
  const double shifted = x * (2.0 / std::numbers::pi) + rounding;
  const double n = shifted - rounding;
  const double r = ((x - n * part1) - n * part2) - n * part3;
  const double s = r * r;
  // Taylor series: the terms left out are below 1e-17 for |r| <= pi/4.
  const double cosine =
      1.0 +
      s * (-1.0 / 2 +
           s * (1.0 / 24 +
                s * (-1.0 / 720 +
                     s * (1.0 / 40320 + s * (-1.0 / 3628800 + s * (1.0 / 479001600 +
                                                                   s * (-1.0 / 87178291200.0 +
                                                                        s / 20922789888000.0)))))));
  const double sine =
      r + r * s *
              (-1.0 / 6 +
               s * (1.0 / 120 +
                    s * (-1.0 / 5040 +
                         s * (1.0 / 362880 + s * (-1.0 / 39916800 + s * (1.0 / 6227020800.0 -
                                                                         s / 1307674368000.0))))));
  // cos(r + n pi/2) is cos r, -sin r, -cos r, sin r for n mod 4 = 0, 1, 2, 3.
  const auto bits = std::bit_cast<std::uint64_t>(shifted);
  const std::uint64_t odd = std::uint64_t{0} - (bits & 1);
  const std::uint64_t sign = ((bits + 1) & 2) << 62;
  const std::uint64_t value =
      (std::bit_cast<std::uint64_t>(sine) & odd) | (std::bit_cast<std::uint64_t>(cosine) & ~odd);
  return std::bit_cast<double>(value ^ sign);
}

[[gnu::always_inline]] inline double polynomial_exponential(double x) {
  constexpr double ln2_high = 0x1.62e42fefap-1;
  constexpr double ln2_low = 0x1.cf79abc9e3b39p-40;
  const double bounded = x > -700.0 ? x : -700.0;
  const double shifted = bounded * std::numbers::log2e + rounding;
  const double n = shifted - rounding;
  const double r = (bounded - n * ln2_high) - n * ln2_low;
  double sum = 1.0 / 6227020800.0;
  sum = sum * r + 1.0 / 479001600;
  sum = sum * r + 1.0 / 39916800;
  sum = sum * r + 1.0 / 3628800;
  sum = sum * r + 1.0 / 362880;
  sum = sum * r + 1.0 / 40320;
  sum = sum * r + 1.0 / 5040;
  sum = sum * r + 1.0 / 720;
  sum = sum * r + 1.0 / 120;
  sum = sum * r + 1.0 / 24;
  sum = sum * r + 1.0 / 6;
  sum = sum * r + 0.5;
  sum = sum * r + 1.0;
  sum = sum * r + 1.0;
  const std::uint64_t power = (std::bit_cast<std::uint64_t>(shifted) + 1023) << 52;
  return sum * std::bit_cast<double>(power);
}

// Phase of a component at the origin, within half a turn where it would grow large: the arguments
// of the cosine stay small however long the simulation lasts.
double phase_at(const WaveTerms& waves, std::size_t c, double time) {
  const double phase = waves.phase[c] - waves.omega[c] * time;
  constexpr double large = 1e5;
  return std::abs(phase) < large ? phase : std::remainder(phase, 2.0 * std::numbers::pi);
}

BLOCKLIFT_CLONES
void cloned_wave_elevation(const WaveTerms& waves, double time, double scale, std::size_t count,
                           const double* __restrict x, const double* __restrict y,
                           double* __restrict sum) {
  for (std::size_t c = 0; c < waves.count; ++c) {
    const double a = scale * waves.a[c];
    const double kx = waves.kx[c];
    const double ky = waves.ky[c];
    const double phase = phase_at(waves, c, time);
    for (std::size_t i = 0; i < count; ++i) {
      sum[i] += a * polynomial_cosine(kx * x[i] + ky * y[i] + phase);
    }
  }
}

BLOCKLIFT_CLONES
void cloned_wave_head(const WaveTerms& waves, double depth, double time, double scale,
                      std::size_t count, const double* __restrict x, const double* __restrict y,
                      const double* __restrict z, double* __restrict sum) {
  for (std::size_t c = 0; c < waves.count; ++c) {
    const double k = waves.k[c];
    const double kx = waves.kx[c];
    const double ky = waves.ky[c];
    const double phase = phase_at(waves, c, time);
    const double bottom = std::exp(-2.0 * k * depth);
    const double a = scale * waves.a[c] / (1.0 + bottom);
    if (bottom < 1e-17) {
      for (std::size_t i = 0; i < count; ++i) {
        sum[i] +=
            a * polynomial_exponential(k * z[i]) * polynomial_cosine(kx * x[i] + ky * y[i] + phase);
      }
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      // e^(k z) and its image in the bottom, e^(-k (z + 2 h)).
      const double decay =
          polynomial_exponential(k * z[i]) + polynomial_exponential(-k * (z[i] + 2.0 * depth));
      sum[i] += a * decay * polynomial_cosine(kx * x[i] + ky * y[i] + phase);
    }
  }
}

BLOCKLIFT_CLONES
void cloned_single_wave(const WaveTerms& wave, double depth, double time, double scale,
                        std::size_t count, const double* __restrict x, const double* __restrict y,
                        const double* __restrict z, double* __restrict elevation,
                        double* __restrict head) {
  const double k = wave.k[0];
  const double kx = wave.kx[0];
  const double ky = wave.ky[0];
  const double phase = phase_at(wave, 0, time);
  const double bottom = std::exp(-2.0 * k * depth);
  const double a = scale * wave.a[0];
  if (bottom < 1e-17) {
    const double per_depth = 1.0 / depth;
    for (std::size_t i = 0; i < count; ++i) {
      const double eta = a * polynomial_cosine(kx * x[i] + ky * y[i] + phase);
      const double below = (z[i] - eta) / (1.0 + eta * per_depth);
      elevation[i] = eta;
      head[i] = eta * polynomial_exponential(k * (below < 0.0 ? below : 0.0));
    }
    return;
  }
  const double level = 1.0 / (1.0 + bottom);
  for (std::size_t i = 0; i < count; ++i) {
    const double eta = a * polynomial_cosine(kx * x[i] + ky * y[i] + phase);
    const double stretched = (z[i] - eta) / (1.0 + eta / depth);
    const double below = stretched < 0.0 ? stretched : 0.0;
    elevation[i] = eta;
    head[i] =
        eta * level *
        (polynomial_exponential(k * below) + polynomial_exponential(-k * (below + 2.0 * depth)));
  }
}

}  // namespace

void add_wave_elevation(const WaveTerms& waves, double time, double scale, std::size_t count,
                        const double* x, const double* y, double* sum) {
  cloned_wave_elevation(waves, time, scale, count, x, y, sum);
}

void add_wave_head(const WaveTerms& waves, double depth, double time, double scale,
                   std::size_t count, const double* x, const double* y, const double* z,
                   double* sum) {
  cloned_wave_head(waves, depth, time, scale, count, x, y, z, sum);
}

void calc_single_wave(const WaveTerms& wave, double depth, double time, double scale,
                      std::size_t count, const double* x, const double* y, const double* z,
                      double* elevation, double* head) {
  cloned_single_wave(wave, depth, time, scale, count, x, y, z, elevation, head);
}

}  // namespace blocklift::dynamics
