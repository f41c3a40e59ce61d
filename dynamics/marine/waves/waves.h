#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "dynamics/marine/waves/wave_kernel.h"
#include "dynamics/marine/waves/wave_sum.h"
#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// Water of even depth.
struct Water {
  double density = 1025.0;                                 ///< kg/m3
  double gravity = 9.80665;                                ///< m/s2
  double depth = std::numeric_limits<double>::infinity();  ///< m; infinite: deep
};

/// Wave number k (rad/m) of the angular frequency omega (rad/s): omega^2 = g k tanh(k h), solved by
/// Newton's method from Eckart's (1952) approximation to machine precision, at any depth.
/// @throws ModelError if the frequency, depth or gravity is not positive.
double calc_wave_number(double omega, const Water& water);

/// Velocity of the energy, d omega/dk, m/s: half the phase velocity in deep water.
double calc_group_velocity(double omega, const Water& water);

/// One regular wave: eta = a cos(k (x cos b + y sin b) - omega t + phase).
struct WaveComponent {
  double amplitude = not_a_number;  ///< a, m
  double omega = not_a_number;      ///< rad/s
  double heading = 0.0;             ///< b: direction of travel from +x towards +y, rad
  double phase = 0.0;               ///< rad
};

/// How waves grow at the start of a simulation: a factor 3 s^2 - 2 s^3 on all that they do, with s
/// from 0 at `start` to 1 after `duration`; no ramp if the duration is zero. Its own rate of change
/// is left out of velocities and accelerations, which is small if it lasts several periods.
struct WaveRamp {
  double start = 0.0;     ///< s
  double duration = 0.0;  ///< s

  double factor(double time) const;
};

/// Long- or short-crested sea of linear (Airy) waves, superposed (paper eq. 28):
///
///   phi = sum a g/omega C(z') sin(theta),   theta = k (x cos b + y sin b) - omega t + phase,
///   eta = sum a cos(theta),   p_d = rho g sum a C(z') cos(theta),
///   C(z) = cosh(k (z + h)) / cosh(k h)   (exp(k z) in deep water).
///
/// Wheeler (1970) stretching: z' = (z - eta) / (1 + eta/h), so that the kinematics of the calm
/// water line are found at the wave's surface, and the whole pressure rho g (p_d/(rho g) - z)
/// vanishes there exactly. Above the surface the values of the surface are returned.
class WaveField {
 public:
  /// Still water.
  explicit WaveField(Water water = {}) : water_(water) {}
  /// @throws ModelError if an amplitude is negative, a frequency not positive, a number not finite,
  ///   the density, gravity or depth not positive.
  WaveField(Water water, const std::vector<WaveComponent>& components, WaveRamp ramp = {});

  const Water& water() const { return water_; }
  const WaveRamp& ramp() const { return ramp_; }
  bool is_still() const { return amplitude_.empty(); }
  std::size_t component_count() const { return amplitude_.size(); }
  /// As many as are summed together (WaveSum), not one by one.
  bool has_many_components() const { return sum_.count() > 0; }
  WaveComponent component(std::size_t index) const;
  double wave_number(std::size_t index) const { return k_[index]; }

  /// Elevation above z = 0, m.
  double calc_elevation(double time, double x, double y) const;
  /// p_d / (rho g) at a point, m.
  double calc_dynamic_head(double time, const Vector3& p_W) const;
  /// Velocity of the water, m/s.
  Vector3 calc_velocity(double time, const Vector3& p_W) const;
  /// Its derivative with respect to time at the place, m/s2.
  Vector3 calc_acceleration(double time, const Vector3& p_W) const;

  /// Elevation and dynamic head of many points at once (at most `most_points`), the fast way: the
  /// inner loop runs over points and is vectorised. Does not allocate. In a sea of many components
  /// the head is within WaveSum::depth_error of each one's amplitude.
  static constexpr std::size_t most_points = 72;
  void calc_surface(double time, std::span<const Vector3> points_W, std::span<double> elevation,
                    std::span<double> dynamic_head) const;
  /// The same of `count` points by their coordinates.
  void calc_surface(double time, std::size_t count, const double* x, const double* y,
                    const double* z, double* elevation, double* dynamic_head) const;

  /// Elevation alone of `count` points, of any number.
  void calc_elevations(double time, std::size_t count, const double* x, const double* y,
                       double* elevation) const;

  /// No elevation is ever higher: sum of the amplitudes, m.
  double highest_elevation() const { return amplitude_sum_; }
  /// 4 sqrt(m0), m; m0 = sum a^2/2.
  double significant_height() const;
  /// 2 pi sqrt(m0/m2), s; NaN in still water.
  double mean_zero_crossing_period() const;
  /// Length of the shortest component, m; infinite in still water.
  double shortest_wave_length() const;
  /// Mean energy on an area, rho g sum a^2/2, J/m2.
  double energy_density() const;

 private:
  struct Point;
  WaveTerms terms() const;
  Point locate(double time, const Vector3& p_W) const;

  Water water_;
  WaveRamp ramp_;
  std::vector<double> amplitude_, omega_, heading_, phase_, k_, kx_, ky_;
  double amplitude_sum_ = 0.0;
  WaveSum sum_;  ///< of many components; empty where they are summed one by one
};

/// Waves that break are no Airy waves.
///
///  - one component: height over length at most 0.142 tanh(k h) (Miche 1944);
///  - many: the same for the significant height and the mean zero-crossing period, and the
///    steepness
///    2 pi Hs/(g Tz^2) at most 1/10 for Tz up to 6 s, 1/15 from 12 s, linear between
///    (DNV-RP-C205, 3.5.4).
/// @throws ModelError with height, limit and what to do.
void require_not_breaking(const WaveField& waves);

}  // namespace blocklift::dynamics
