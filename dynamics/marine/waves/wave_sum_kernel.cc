// Inner loops of WaveSum, over lanes of eight points that the compiler turns into the machine's
// vectors.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "dynamics/instruction_sets.h"
#include "dynamics/marine/waves/wave_kernel.h"

namespace blocklift::dynamics {
namespace {

constexpr std::size_t lane_count = 8;
using Lanes = double __attribute__((vector_size(8 * lane_count)));
using Bits = std::uint64_t __attribute__((vector_size(8 * lane_count)));

// Adding this rounds a double to an integer, which then stands in the low bits.
constexpr double rounding = 0x1.8p52;

/// cos(2 pi turns). In place of the turns.
[[gnu::always_inline]] inline void take_cosine(Lanes& turns) {
  const Lanes r = turns - ((turns + rounding) - rounding);
  const Lanes s = r * r;
  // Interpolated in s = r^2 at eleven of Chebyshev's points between 0 and 1/4: within 4e-17 before
  // rounding.
  turns = 1.0 + s * (-19.739208802178685025 +
                     s * (64.939394022663135508 +
                          s * (-85.456817206371766042 +
                               s * (60.244641361562494436 +
                                    s * (-26.426256590531024209 +
                                         s * (7.9035341220416129997 +
                                              s * (-1.7143738447256550291 +
                                                   s * (0.28192457035657781416 +
                                                        s * (-0.036137991334258316738 +
                                                             s * 0.0033596762548915736386)))))))));
}

/// e^x for x <= 0. In place of x.
[[gnu::always_inline]] inline void take_exponential(Lanes& x) {
  constexpr double ln2_high = 0x1.62e42fefap-1;
  constexpr double ln2_low = 0x1.cf79abc9e3b39p-40;
  const Lanes bounded = x > -700.0 ? x : x * 0.0 - 700.0;
  const Lanes shifted = bounded * std::numbers::log2e + rounding;
  const Lanes n = shifted - rounding;
  const Lanes r = (bounded - n * ln2_high) - n * ln2_low;
  Lanes sum = r * (1.0 / 6227020800.0) + 1.0 / 479001600;
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
  const Bits power = ((Bits)shifted + 1023) << 52;
  x = sum * (Lanes)power;
}

/// The first values of an array, zeros behind its end.
[[gnu::always_inline]] inline void load(const double* values, std::size_t count, Lanes& lanes) {
  lanes = Lanes{};
  for (std::size_t i = 0; i < std::min(count, lane_count); ++i) lanes[i] = values[i];
}
[[gnu::always_inline]] inline void store(const Lanes& lanes, std::size_t count, double* values) {
  for (std::size_t i = 0; i < std::min(count, lane_count); ++i) values[i] = lanes[i];
}

/// W_m at points.
[[gnu::always_inline]] inline void sum_carriers(const WaveSum::Terms& waves, double time,
                                                const Lanes& x, const Lanes& y, Lanes* W) {
  constexpr std::size_t width = WaveSum::carriers_of_wave;
  for (std::size_t m = 0; m < waves.carrier_count; ++m) W[m] = Lanes{};
  for (std::size_t g = 0; g < waves.group_count; ++g) {
    const WaveGroup group = waves.groups[g];
    Lanes w0{}, w1{}, w2{}, w3{}, w4{}, w5{};
    for (std::size_t c = group.first; c < group.last; ++c) {
      Lanes cosine =
          waves.turns_x[c] * x + waves.turns_y[c] * y + (waves.turns[c] - waves.turns_t[c] * time);
      take_cosine(cosine);
      const double* weight = waves.weight + width * c;
      w0 += weight[0] * cosine;
      w1 += weight[1] * cosine;
      w2 += weight[2] * cosine;
      w3 += weight[3] * cosine;
      w4 += weight[4] * cosine;
      w5 += weight[5] * cosine;
    }
    Lanes* to = W + group.carrier;
    to[0] += w0;
    to[1] += w1;
    to[2] += w2;
    to[3] += w3;
    to[4] += w4;
    to[5] += w5;
  }
}

/// sum_m C(K_m, z) W_m, z <= 0.
[[gnu::always_inline]] inline void sum_depths(const WaveSum::Terms& waves, const Lanes& z,
                                              const Lanes* W, Lanes& head) {
  constexpr std::size_t octave = WaveSum::carriers_of_octave;
  std::array<Lanes, octave> decay, image;
  const bool is_deep = std::isinf(waves.depth);
  head = Lanes{};
  for (std::size_t m = 0; m < waves.carrier_count; ++m) {
    const double K = waves.carrier[m];
    Lanes& down = decay[m % octave];
    Lanes& up = image[m % octave];
    if (m < octave) {
      down = K * z;
      take_exponential(down);
    } else {
      down *= down;
    }
    if (is_deep) {
      head += down * W[m];
      continue;
    }
    // e^(K z) and its image in the bottom, e^(-K (z + 2 h)).
    if (m < octave) {
      up = -K * (z + 2.0 * waves.depth);
      take_exponential(up);
    } else {
      up *= up;
    }
    head += (down + up) * W[m] / (1.0 + std::exp(-2.0 * K * waves.depth));
  }
}

BLOCKLIFT_CLONES
void cloned_wave_elevations(const WaveSum::Terms& waves, double time, double scale,
                            std::size_t count, const double* x, const double* y,
                            double* elevation) {
  for (std::size_t i = 0; i < count; i += lane_count) {
    Lanes at_x, at_y, sum{};
    load(x + i, count - i, at_x);
    load(y + i, count - i, at_y);
    for (std::size_t c = 0; c < waves.wave_count; ++c) {
      Lanes cosine = waves.turns_x[c] * at_x + waves.turns_y[c] * at_y +
                     (waves.turns[c] - waves.turns_t[c] * time);
      take_cosine(cosine);
      sum += waves.amplitude[c] * cosine;
    }
    sum *= scale;
    store(sum, count - i, elevation + i);
  }
}

BLOCKLIFT_CLONES
void cloned_wave_surface(const WaveSum::Terms& waves, double time, double scale, std::size_t count,
                         const double* x, const double* y, const double* z, double* elevation,
                         double* head) {
  std::array<Lanes, WaveSum::most_carriers> W;
  for (std::size_t i = 0; i < count; i += lane_count) {
    Lanes at_x, at_y, at_z;
    load(x + i, count - i, at_x);
    load(y + i, count - i, at_y);
    load(z + i, count - i, at_z);
    sum_carriers(waves, time, at_x, at_y, W.data());
    Lanes eta{};
    for (std::size_t m = 0; m < waves.carrier_count; ++m) eta += W[m];
    eta *= scale;
    // Wheeler's stretching.
    const Lanes below = (at_z - eta) / (1.0 + eta / waves.depth);
    Lanes sum;
    sum_depths(waves, below < 0.0 ? below : Lanes{}, W.data(), sum);
    sum *= scale;
    store(eta, count - i, elevation + i);
    store(sum, count - i, head + i);
  }
}

}  // namespace

void sum_wave_elevations(const WaveSum::Terms& waves, double time, double scale, std::size_t count,
                         const double* x, const double* y, double* elevation) {
  cloned_wave_elevations(waves, time, scale, count, x, y, elevation);
}

void sum_wave_surface(const WaveSum::Terms& waves, double time, double scale, std::size_t count,
                      const double* x, const double* y, const double* z, double* elevation,
                      double* head) {
  cloned_wave_surface(waves, time, scale, count, x, y, z, elevation, head);
}

}  // namespace blocklift::dynamics
