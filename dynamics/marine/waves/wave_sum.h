#pragma once

#include <cstddef>
#include <vector>

namespace blocklift::dynamics {

/// Some components of neighbouring wave numbers, which share their carriers.
struct WaveGroup {
  std::size_t first, last;  ///< components, the last behind the end
  std::size_t carrier;      ///< the first of `carriers_of_wave`
};

/// Elevation and dynamic head of many waves at many points, by one cosine for each wave and point.
///
/// How a wave decays with depth, C(k, z) = cosh(k (z + h))/cosh(k h), is interpolated in ln k
/// between a few wave numbers K_m, the carriers, four to an octave, by polynomials of the fifth
/// degree:
///
///   C(k, z) = sum_m L_m(ln k) C(K_m, z),   so   sum_c a_c C(k_c, z) cos theta_c = sum_m C(K_m, z)
///     W_m,
///
/// with W_m = sum_c a_c L_m(ln k_c) cos theta_c, sums in which the depth does not occur. The
/// polynomials add up to 1: the elevation is the sum of all W_m, and pressure vanishes at it. C is
/// one function of ln k + ln(-z) in deep water, so that the error of a component is the same at any
/// depth and any wave number: at most `depth_error` of its amplitude, 1.2e-6 in deep water and
/// 4.2e-6 in water of any depth; it falls with the sixth power of the carriers' distance. e^(K z)
/// of a carrier an octave higher is the square of that below.
///
/// The cosine is a polynomial of the fraction of a turn, within 1e-14. Immutable.
class WaveSum {
 public:
  static constexpr std::size_t carriers_of_wave = 6;
  static constexpr std::size_t carriers_of_octave = 4;
  static constexpr std::size_t most_carriers = 96;
  static constexpr double depth_error = 5e-6;  ///< of the amplitude, at most

  /// One wave of the sum.
  struct Wave {
    double amplitude, k, kx, ky, omega, phase;
  };

  WaveSum() = default;
  /// Can the sum be taken for wave numbers (rad/m) between these?
  static bool can_span(double lowest, double highest);
  /// The wave numbers must be such that can_span. `depth` may be infinite, m.
  WaveSum(std::vector<Wave> waves, double depth);

  std::size_t count() const { return amplitude_.size(); }

  /// elevation[i] = scale sum_c a cos theta_c of `count` points, of any number. Does not allocate.
  void calc_elevations(double time, double scale, std::size_t count, const double* x,
                       const double* y, double* elevation) const;
  /// The same, and the dynamic head at heights z before stretching (Wheeler's, see WaveField).
  void calc_surface(double time, double scale, std::size_t count, const double* x, const double* y,
                    const double* z, double* elevation, double* head) const;

  /// What the inner loops read.
  struct Terms {
    std::size_t wave_count, group_count, carrier_count;
    const double *turns_x, *turns_y, *turns_t, *turns;  ///< of the phase: by m, by s, at the origin
    const double* amplitude;
    const double* weight;  ///< a L_m, `carriers_of_wave` for each wave
    const WaveGroup* groups;
    const double* carrier;  ///< K_m, rad/m
    double depth;
  };

 private:
  Terms terms() const;

  double depth_ = 0.0;
  std::vector<double> turns_x_, turns_y_, turns_t_, turns_, amplitude_, weight_, carrier_;
  std::vector<WaveGroup> groups_;
};

}  // namespace blocklift::dynamics
