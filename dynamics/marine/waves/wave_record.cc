// A measured record of the elevation as a sea of its Fourier components (wave_spectrum.h).
#include <fftw3.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "dynamics/errors.h"
#include "dynamics/marine/waves/wave_spectrum.h"

namespace blocklift::dynamics {

namespace {

void require_record(const WaveRecord& record) {
  if (record.elevation.size() < 4) {
    throw ModelError("a record of the wave elevation has " +
                     std::to_string(record.elevation.size()) + " values; 4 or more are due");
  }
  if (!(record.time_step > 0.0) || !std::isfinite(record.time_step)) {
    throw ModelError("a record of the wave elevation has the time step " +
                     std::to_string(record.time_step) + " s; a number above zero is due");
  }
  for (std::size_t i = 0; i < record.elevation.size(); ++i) {
    if (std::isfinite(record.elevation[i])) continue;
    throw ModelError("value " + std::to_string(i) + " of a record of the wave elevation is " +
                     std::to_string(record.elevation[i]) + "; finite numbers are due");
  }
}

// X_j = sum x_i exp(-2 pi i j / n), j = 0 .. n/2, as pairs of real and imaginary part.
std::vector<std::array<double, 2>> transform(std::vector<double> values) {
  const int n = static_cast<int>(values.size());
  std::vector<std::array<double, 2>> result(values.size() / 2 + 1);
  auto* out = reinterpret_cast<fftw_complex*>(result.data());
  const fftw_plan plan = fftw_plan_dft_r2c_1d(n, values.data(), out, FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  return result;
}

}  // namespace

WaveField realise(const WaveRecord& record, const Water& water) {
  require_record(record);
  const std::size_t n = record.elevation.size();
  const std::vector<std::array<double, 2>> X = transform(record.elevation);
  const double step = 2.0 * std::numbers::pi / (static_cast<double>(n) * record.time_step);
  std::vector<WaveComponent> components;
  for (std::size_t j = 1; j < X.size(); ++j) {
    const double omega = static_cast<double>(j) * step;
    if (record.frequencies &&
        (omega < (*record.frequencies)[0] || omega > (*record.frequencies)[1])) {
      continue;
    }
    // The last component of an even number of values stands for itself alone.
    const double share = 2 * j == n ? 1.0 : 2.0;
    const double amplitude = share * std::hypot(X[j][0], X[j][1]) / static_cast<double>(n);
    if (amplitude == 0.0) continue;
    // cos(-omega t + phase) = cos(omega (t - t0) + arg X): phase = -arg X + omega t0.
    const double argument = std::atan2(X[j][1], X[j][0]);
    components.push_back({amplitude, omega, record.heading, omega * record.start_time - argument});
  }
  if (components.empty()) {
    throw ModelError(
        "no frequency of the record of the wave elevation is kept; its frequencies are multiples "
        "of " +
        std::to_string(step) + " rad/s up to " +
        std::to_string(static_cast<double>(X.size() - 1) * step) + " rad/s");
  }
  return {water, components, record.ramp};
}

}  // namespace blocklift::dynamics
