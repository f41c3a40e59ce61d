#include "dynamics/marine/waves/waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/marine/waves/wave_kernel.h"

namespace blocklift::dynamics {

namespace {

void require_positive(const char* what, double value, bool may_be_infinite = false) {
  if (value > 0.0 && (std::isfinite(value) || may_be_infinite)) return;
  throw ModelError("the " + std::string(what) + " is " + std::to_string(value) +
                   "; a number above zero is due");
}

void require_water(const Water& water) {
  require_positive("water density", water.density);
  require_positive("gravity of the sea", water.gravity);
  require_positive("water depth", water.depth, true);
}

// cosh(k(z+h))/cosh(kh) and sinh(k(z+h))/cosh(kh), without overflow.
std::array<double, 2> depth_functions(double k, double z, double depth) {
  const double bottom = std::exp(-2.0 * k * depth);
  const double image = std::exp(-2.0 * k * (z + depth));
  const double decay = std::exp(k * z) / (1.0 + bottom);
  return {decay * (1.0 + image), decay * (1.0 - image)};
}

// Of fewer components each is summed for itself.
constexpr std::size_t fewest_to_sum = 8;

double stretched(double z, double eta, double depth) {
  const double above_bottom = std::isinf(depth) ? 1.0 : 1.0 + eta / depth;
  return std::min(0.0, (z - eta) / above_bottom);
}

}  // namespace

double calc_wave_number(double omega, const Water& water) {
  require_positive("wave frequency", omega);
  require_water(water);
  const double deep = omega * omega / water.gravity;
  if (std::isinf(water.depth)) return deep;
  // x tanh x = y with x = k h. Newton's method on a convex function that starts above the root.
  const double y = deep * water.depth;
  double x = y / std::sqrt(std::tanh(y));
  for (int i = 0; i < 30; ++i) {
    const double tangent = std::tanh(x);
    const double step = (x * tangent - y) / (tangent + x * (1.0 - tangent * tangent));
    x -= step;
    if (std::abs(step) < 1e-15 * x) break;
  }
  return x / water.depth;
}

double calc_group_velocity(double omega, const Water& water) {
  const double k = calc_wave_number(omega, water);
  const double two_kh = 2.0 * k * water.depth;
  const double n = two_kh > 700.0 ? 0.5 : 0.5 * (1.0 + two_kh / std::sinh(two_kh));
  return n * omega / k;
}

double WaveRamp::factor(double time) const {
  if (!(duration > 0.0)) return 1.0;
  const double s = std::clamp((time - start) / duration, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

WaveField::WaveField(Water water, const std::vector<WaveComponent>& components, WaveRamp ramp)
    : water_(water), ramp_(ramp) {
  require_water(water);
  if (!std::isfinite(ramp.start) || !(ramp.duration >= 0.0) || !std::isfinite(ramp.duration)) {
    throw ModelError("the ramp of the waves lasts " + std::to_string(ramp.duration) +
                     " s; a finite time, zero or more, is due");
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    const WaveComponent& c = components[i];
    const bool finite =
        std::isfinite(c.amplitude) && std::isfinite(c.heading) && std::isfinite(c.phase);
    if (!finite || c.amplitude < 0.0) {
      throw ModelError("wave component " + std::to_string(i) + " has the amplitude " +
                       std::to_string(c.amplitude) + " m, the heading " +
                       std::to_string(c.heading) + " rad and the phase " + std::to_string(c.phase) +
                       " rad; finite numbers are due, the amplitude not negative");
    }
    const double k = calc_wave_number(c.omega, water);
    amplitude_.push_back(c.amplitude);
    omega_.push_back(c.omega);
    heading_.push_back(c.heading);
    phase_.push_back(c.phase);
    k_.push_back(k);
    kx_.push_back(k * std::cos(c.heading));
    ky_.push_back(k * std::sin(c.heading));
    amplitude_sum_ += c.amplitude;
  }
  if (components.size() < fewest_to_sum) return;
  const auto [lowest, highest] = std::minmax_element(k_.begin(), k_.end());
  if (!WaveSum::can_span(*lowest, *highest)) return;
  std::vector<WaveSum::Wave> waves;
  for (std::size_t i = 0; i < k_.size(); ++i) {
    waves.push_back({amplitude_[i], k_[i], kx_[i], ky_[i], omega_[i], phase_[i]});
  }
  sum_ = WaveSum(std::move(waves), water.depth);
}

WaveComponent WaveField::component(std::size_t i) const {
  return {amplitude_[i], omega_[i], heading_[i], phase_[i]};
}

double WaveField::calc_elevation(double time, double x, double y) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < amplitude_.size(); ++i) {
    sum += amplitude_[i] * std::cos(kx_[i] * x + ky_[i] * y - omega_[i] * time + phase_[i]);
  }
  return ramp_.factor(time) * sum;
}

// What the fields at a point have in common.
struct WaveField::Point {
  double ramp;  // factor
  double z;     // stretched height, not above 0, m
};

WaveField::Point WaveField::locate(double time, const Vector3& p_W) const {
  return {ramp_.factor(time),
          stretched(p_W.z(), calc_elevation(time, p_W.x(), p_W.y()), water_.depth)};
}

double WaveField::calc_dynamic_head(double time, const Vector3& p_W) const {
  const Point point = locate(time, p_W);
  double sum = 0.0;
  for (std::size_t i = 0; i < amplitude_.size(); ++i) {
    const double theta = kx_[i] * p_W.x() + ky_[i] * p_W.y() - omega_[i] * time + phase_[i];
    sum += amplitude_[i] * depth_functions(k_[i], point.z, water_.depth)[0] * std::cos(theta);
  }
  return point.ramp * sum;
}

Vector3 WaveField::calc_velocity(double time, const Vector3& p_W) const {
  const Point point = locate(time, p_W);
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < amplitude_.size(); ++i) {
    const double theta = kx_[i] * p_W.x() + ky_[i] * p_W.y() - omega_[i] * time + phase_[i];
    const auto [C, S] = depth_functions(k_[i], point.z, water_.depth);
    const double scale = amplitude_[i] * water_.gravity / omega_[i];
    sum += scale * Vector3(kx_[i] * C * std::cos(theta), ky_[i] * C * std::cos(theta),
                           k_[i] * S * std::sin(theta));
  }
  return point.ramp * sum;
}

Vector3 WaveField::calc_acceleration(double time, const Vector3& p_W) const {
  const Point point = locate(time, p_W);
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < amplitude_.size(); ++i) {
    const double theta = kx_[i] * p_W.x() + ky_[i] * p_W.y() - omega_[i] * time + phase_[i];
    const auto [C, S] = depth_functions(k_[i], point.z, water_.depth);
    const double scale = amplitude_[i] * water_.gravity;
    sum += scale * Vector3(kx_[i] * C * std::sin(theta), ky_[i] * C * std::sin(theta),
                           -k_[i] * S * std::cos(theta));
  }
  return point.ramp * sum;
}

WaveTerms WaveField::terms() const {
  return {amplitude_.size(), amplitude_.data(), k_.data(),    kx_.data(),
          ky_.data(),        omega_.data(),     phase_.data()};
}

void WaveField::calc_surface(double time, std::span<const Vector3> points_W,
                             std::span<double> elevation, std::span<double> dynamic_head) const {
  const std::size_t count = points_W.size();
  std::array<double, most_points> x, y, z;
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = points_W[i].x();
    y[i] = points_W[i].y();
    z[i] = points_W[i].z();
  }
  calc_surface(time, count, x.data(), y.data(), z.data(), elevation.data(), dynamic_head.data());
}

void WaveField::calc_surface(double time, std::size_t count, const double* x, const double* y,
                             const double* z, double* elevation, double* dynamic_head) const {
  if (sum_.count() > 0) {
    sum_.calc_surface(time, ramp_.factor(time), count, x, y, z, elevation, dynamic_head);
    return;
  }
  std::fill_n(elevation, count, 0.0);
  std::fill_n(dynamic_head, count, 0.0);
  const WaveTerms terms = this->terms();
  const double ramp = ramp_.factor(time);
  if (terms.count == 1) {
    calc_single_wave(terms, water_.depth, time, ramp, count, x, y, z, elevation, dynamic_head);
    return;
  }
  std::array<double, most_points> below;
  add_wave_elevation(terms, time, ramp, count, x, y, elevation);
  for (std::size_t i = 0; i < count; ++i) below[i] = stretched(z[i], elevation[i], water_.depth);
  add_wave_head(terms, water_.depth, time, ramp, count, x, y, below.data(), dynamic_head);
}

void WaveField::calc_elevations(double time, std::size_t count, const double* x, const double* y,
                                double* elevation) const {
  if (sum_.count() > 0) {
    sum_.calc_elevations(time, ramp_.factor(time), count, x, y, elevation);
    return;
  }
  std::fill_n(elevation, count, 0.0);
  add_wave_elevation(terms(), time, ramp_.factor(time), count, x, y, elevation);
}

double WaveField::significant_height() const {
  double m0 = 0.0;
  for (const double a : amplitude_) m0 += 0.5 * a * a;
  return 4.0 * std::sqrt(m0);
}

double WaveField::mean_zero_crossing_period() const {
  double m0 = 0.0;
  double m2 = 0.0;
  for (std::size_t i = 0; i < amplitude_.size(); ++i) {
    m0 += 0.5 * amplitude_[i] * amplitude_[i];
    m2 += 0.5 * amplitude_[i] * amplitude_[i] * omega_[i] * omega_[i];
  }
  return 2.0 * std::numbers::pi * std::sqrt(m0 / m2);
}

double WaveField::shortest_wave_length() const {
  if (is_still()) return std::numeric_limits<double>::infinity();
  return 2.0 * std::numbers::pi / *std::max_element(k_.begin(), k_.end());
}

double WaveField::energy_density() const {
  const double height = significant_height();
  return water_.density * water_.gravity * height * height / 16.0;
}

namespace {

[[noreturn]] void throw_breaks(const std::string& what, double height, double limit) {
  std::ostringstream text;
  text << what << " of " << height << " m breaks: at most " << limit
       << " m can stand. Lower the wave or lengthen its period";
  throw ModelError(text.str());
}

}  // namespace

void require_not_breaking(const WaveField& waves) {
  if (waves.is_still()) return;
  constexpr double two_pi = 2.0 * std::numbers::pi;
  const bool regular = waves.component_count() == 1;
  const double height = regular ? 2.0 * waves.component(0).amplitude : waves.significant_height();
  const double period =
      regular ? two_pi / waves.component(0).omega : waves.mean_zero_crossing_period();
  std::ostringstream what;
  what << (regular ? "a wave with the period " : "a sea with the mean zero-crossing period ")
       << period << " s and the " << (regular ? "height" : "significant height");
  const double k = calc_wave_number(two_pi / period, waves.water());
  const double miche = 0.142 * std::tanh(k * waves.water().depth) * two_pi / k;
  if (height > miche) throw_breaks(what.str(), height, miche);
  if (regular) return;
  const double share = std::clamp((period - 6.0) / 6.0, 0.0, 1.0);
  const double steepness = 1.0 / 10.0 + share * (1.0 / 15.0 - 1.0 / 10.0);
  const double highest = steepness * waves.water().gravity * period * period / two_pi;
  if (height > highest) throw_breaks(what.str(), height, highest);
}

}  // namespace blocklift::dynamics
