#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dynamics/force/wind_gust.h"
#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// How the mean wind grows with the height z above the sea or ground (m).
enum class WindProfile {
  uniform,  ///< U(z) = U10
  power,    ///< U(z) = U10 (z/10)^alpha
  /// U(z) = U10 (1 + C ln(z/10)), C = 0.0573 sqrt(1 + 0.15 U10): NPD (Froya), ISO 19901-1, A.7.3.
  npd,
};

/// Spectra of the wind's gusts S(f), m2/s2 per Hz, with U10 the mean at 10 m (m/s) and z a height
/// (m).
enum class GustSpectrum {
  none,
  /// S = 320 (U10/10)^2 (z/10)^0.45 / (1 + f~^n)^(5/(3n)), f~ = 172 f (z/10)^(2/3) (U10/10)^-0.75,
  /// n = 0.468: NPD (Froya), ISO 19901-1, A.7.4. U10 is the mean of one hour.
  npd,
  /// f S = sigma^2 x/(1 + 1.5 x)^(5/3), x = f/f_p, f_p = 0.025 U(z)/z, sigma = 0.15 (z/20)^e U(z),
  /// e =
  /// -0.125 up to 20 m and -0.275 above, U(z) = U10 (z/10)^0.125: API RP 2A (1993), 2.3.2.
  api,
  /// f S = 4 kappa U10^2 x^2/(1 + x^2)^(4/3), x = 1200 f/U10, the same at all heights: Davenport
  /// (1961).
  davenport,
};

/// S(f), m2/s2 per Hz. `surface_drag`: kappa of Davenport's spectrum.
double calc_gust_density(GustSpectrum spectrum, double frequency, double U10, double height,
                         double surface_drag = 0.003);

/// Wind over the heights of the world, steady or with gusts.
///
/// The gusts are a sum of cosines along the mean wind, one at a random place in each of
/// `components` steps of ln f with the energy of the step and a random phase (RandomSource; draws:
/// place, phase). One gust acts everywhere at once: loads of large structures are on the safe side.
/// A single gust over time (WindGust) may come besides.
class WindField {
 public:
  struct Definition {
    double speed = not_a_number;    ///< U10: mean at 10 m, m/s
    double heading = not_a_number;  ///< direction in which the wind blows, rad from +x towards +y
    double air_density = 1.25;      ///< kg/m3
    WindProfile profile = WindProfile::uniform;
    double exponent = 0.12;  ///< alpha of the power law
    GustSpectrum gusts = GustSpectrum::none;
    double gust_height = 10.0;               ///< z at which the spectrum is taken, m
    double surface_drag = 0.003;             ///< kappa of Davenport's spectrum
    double lowest_frequency = 1.0 / 2400.0;  ///< of the gusts, Hz
    double highest_frequency = 0.5;          ///< Hz
    int components = 60;
    std::uint64_t seed = 1;
    std::optional<WindGust> gust = {};  ///< a single one
  };

  /// @throws ModelError if a number is negative or not finite, the frequencies do not ascend from
  ///   above zero, or there is no component.
  explicit WindField(const Definition& definition);

  const Definition& definition() const { return definition_; }
  double air_density() const { return definition_.air_density; }
  /// Mean speed at a height, m/s. Below 1 m, where no law holds, that of 1 m.
  double calc_mean_speed(double z) const;
  /// What gusts and the single one add, m/s.
  double calc_gust(double time) const;
  Vector3 calc_velocity(double time, double z) const {
    return (calc_mean_speed(z) + calc_gust(time)) * direction_W_;
  }
  /// Standard deviation of the gusts that are realised, m/s.
  double gust_deviation() const;
  /// The same wind without gusts: for static equilibrium.
  WindField mean() const;

 private:
  Definition definition_;
  Vector3 direction_W_;
  double npd_slope_ = 0.0;
  std::vector<double> amplitude_, omega_, phase_;
};

}  // namespace blocklift::dynamics
