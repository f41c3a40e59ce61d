#pragma once

#include <cstddef>

#include "dynamics/marine/waves/wave_sum.h"

namespace blocklift::dynamics {

/// Inner loops of a sea: sums over points, written so that the compiler vectorises them (the sine
/// and exponential are polynomials of their own, within 4 units of the last place for the arguments
/// that occur: |x| < 1e6 for the cosine, x <= 0 for the exponential).

/// The components of a sea, each array `count` long.
struct WaveTerms {
  std::size_t count;
  const double* a;   ///< amplitude, m
  const double* k;   ///< wave number, rad/m
  const double* kx;  ///< and its parts, rad/m
  const double* ky;
  const double* omega;  ///< rad/s
  const double* phase;  ///< rad
};

/// sum[i] += scale sum_c a cos(kx x[i] + ky y[i] - omega t + phase).
void add_wave_elevation(const WaveTerms& waves, double time, double scale, std::size_t count,
                        const double* x, const double* y, double* sum);

/// sum[i] += scale sum_c a C(z[i]) cos(kx x[i] + ky y[i] - omega t + phase), with z <= 0 and
/// C = e^(k z) (1 + e^(-2 k (z + h))) / (1 + e^(-2 k h)); h may be infinite.
void add_wave_head(const WaveTerms& waves, double depth, double time, double scale,
                   std::size_t count, const double* x, const double* y, const double* z,
                   double* sum);

/// Both at once, of a sea of one component, at heights z before stretching: its cosine serves both.
/// Overwrites elevation and head.
void calc_single_wave(const WaveTerms& wave, double depth, double time, double scale,
                      std::size_t count, const double* x, const double* y, const double* z,
                      double* elevation, double* head);

/// WaveSum::calc_elevations and WaveSum::calc_surface.
void sum_wave_elevations(const WaveSum::Terms& waves, double time, double scale, std::size_t count,
                         const double* x, const double* y, double* elevation);
void sum_wave_surface(const WaveSum::Terms& waves, double time, double scale, std::size_t count,
                      const double* x, const double* y, const double* z, double* elevation,
                      double* head);

}  // namespace blocklift::dynamics
