#include "dynamics/marine/waves/wave_sum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/marine/waves/wave_kernel.h"

namespace blocklift::dynamics {
namespace {

constexpr double spacing = std::numbers::ln2 / WaveSum::carriers_of_octave;  // of carriers in ln k
// Carriers that lie below a wave, of the six that it is interpolated between.
constexpr double below = 2.0;

std::size_t count_steps(double lowest, double highest) {
  return static_cast<std::size_t>(std::floor(std::log(highest / lowest) / spacing));
}

/// Lagrange's polynomial through carriers at 0, 1, .. 5: that of `m` at s.
double lagrange(std::size_t m, double s) {
  double value = 1.0;
  for (std::size_t i = 0; i < WaveSum::carriers_of_wave; ++i) {
    if (i == m) continue;
    const auto place = static_cast<double>(i);
    value *= (s - place) / (static_cast<double>(m) - place);
  }
  return value;
}

}  // namespace

bool WaveSum::can_span(double lowest, double highest) {
  return lowest > 0.0 && count_steps(lowest, highest) + carriers_of_wave <= most_carriers;
}

WaveSum::WaveSum(std::vector<Wave> waves, double depth) : depth_(depth) {
  if (waves.empty()) return;
  std::stable_sort(waves.begin(), waves.end(),
                   [](const Wave& a, const Wave& b) { return a.k < b.k; });
  const double lowest = waves.front().k;
  const std::size_t carriers = count_steps(lowest, waves.back().k) + carriers_of_wave;
  for (std::size_t m = 0; m < carriers; ++m) {
    carrier_.push_back(lowest * std::exp((static_cast<double>(m) - below) * spacing));
  }
  constexpr double per_turn = 0.5 / std::numbers::pi;
  for (std::size_t c = 0; c < waves.size(); ++c) {
    const Wave& wave = waves[c];
    turns_x_.push_back(per_turn * wave.kx);
    turns_y_.push_back(per_turn * wave.ky);
    turns_t_.push_back(per_turn * wave.omega);
    turns_.push_back(std::remainder(per_turn * wave.phase, 1.0));
    amplitude_.push_back(wave.amplitude);
    const std::size_t step = count_steps(lowest, wave.k);
    if (groups_.empty() || groups_.back().carrier != step) groups_.push_back({c, c, step});
    groups_.back().last = c + 1;
    const double s = std::log(wave.k / carrier_[step]) / spacing;
    for (std::size_t m = 0; m < carriers_of_wave; ++m) {
      weight_.push_back(wave.amplitude * lagrange(m, s));
    }
  }
}

WaveSum::Terms WaveSum::terms() const {
  return {count(),         groups_.size(),  carrier_.size(), turns_x_.data(),
          turns_y_.data(), turns_t_.data(), turns_.data(),   amplitude_.data(),
          weight_.data(),  groups_.data(),  carrier_.data(), depth_};
}

void WaveSum::calc_elevations(double time, double scale, std::size_t count, const double* x,
                              const double* y, double* elevation) const {
  sum_wave_elevations(terms(), time, scale, count, x, y, elevation);
}

void WaveSum::calc_surface(double time, double scale, std::size_t count, const double* x,
                           const double* y, const double* z, double* elevation,
                           double* head) const {
  sum_wave_surface(terms(), time, scale, count, x, y, z, elevation, head);
}

}  // namespace blocklift::dynamics
