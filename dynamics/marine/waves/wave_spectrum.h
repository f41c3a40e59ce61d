#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dynamics/marine/waves/waves.h"

namespace blocklift::dynamics {

/// One-sided spectrum S(omega) of the wave elevation, m2 s/rad: m0 = int S d omega = Hs^2/16.
class WaveSpectrum {
 public:
  /// Two-parameter spectrum of Bretschneider and the ISSC (1964): S = A omega^-5 exp(-B omega^-4)
  /// with the mean period T1 = 2 pi m0/m1 = 2 pi / (Gamma(3/4) B^(1/4)) and A = B Hs^2/4.
  static WaveSpectrum issc(double significant_height, double mean_period);
  /// The same shape by its peak period, B = 5/4 omega_p^4: the spectrum of Pierson and Moskowitz
  /// (1964) in the form of two parameters.
  static WaveSpectrum pierson_moskowitz(double significant_height, double peak_period);
  /// Fully developed sea of Pierson and Moskowitz (1964): A = 0.0081 g^2, B = 4 A/Hs^2.
  static WaveSpectrum fully_developed(double significant_height, double gravity = 9.80665);
  /// JONSWAP (Hasselmann et al. 1973): the above times gamma^exp(-((omega/omega_p - 1)/sigma)^2/2),
  /// sigma = 0.07 up to the peak and 0.09 beyond, scaled so that m0 is Hs^2/16 exactly.
  static WaveSpectrum jonswap(double significant_height, double peak_period, double gamma = 3.3);
  /// Points (omega, S), linear between, zero outside.
  /// @throws ModelError if there are fewer than two, the frequencies do not ascend from above zero,
  ///   or a density is negative.
  static WaveSpectrum table(std::vector<double> omega, std::vector<double> density);

  /// S(omega), m2 s/rad; zero for omega <= 0.
  double density(double omega) const { return omega > 0.0 ? density_(omega) : 0.0; }
  /// int omega^n S d omega over all frequencies, by Gauss' quadrature in ln omega; n up to 2 (the
  /// fourth moment of these shapes does not exist).
  double moment(int n) const;
  /// int S d omega from one frequency to another.
  double energy_between(double low, double high) const;
  double significant_height() const;
  /// Frequencies between which all but the fraction `left_out` of m0 lies at each end, rad/s.
  std::array<double, 2> range(double left_out) const;

 private:
  WaveSpectrum(std::function<double(double)> density, std::vector<double> nodes);

  std::function<double(double)> density_;
  std::vector<double> nodes_;  ///< ascending; S is smooth between and negligible outside
};

/// How a spectrum becomes waves.
struct SeaRealisation {
  double heading = 0.0;  ///< of the wind sea: direction of travel, rad
  /// Exponent n of the spreading cos^n(b - heading) over 180 degrees; none: long-crested.
  std::optional<double> spreading_exponent = {};
  int components = 200;
  std::uint64_t seed = 1;
  /// Lowest and highest frequency, rad/s; none: all but 0.1 % of the energy at each end.
  std::optional<std::array<double, 2>> frequencies = {};
  WaveRamp ramp = {};
};

/// A sea with the energy of the spectrum: equal steps of frequency, in each one component at a
/// random place with the energy of the step (so the sea does not repeat itself and m0 is exact), a
/// random phase and, if short-crested, a random direction drawn from the spreading. One direction
/// for each frequency keeps the sea free of standing patterns (Jefferys 1987). Draws, from low to
/// high frequency: place, phase, direction.
/// @throws ModelError if the number of components, the frequencies or the exponent cannot be.
WaveField realise(const WaveSpectrum& spectrum, const Water& water, const SeaRealisation& how);

/// A sea that gives back a measured record of the elevation at the origin.
struct WaveRecord {
  std::vector<double> elevation;    ///< at even steps, m
  double time_step = not_a_number;  ///< s
  double start_time = 0.0;          ///< s: when the first value was measured
  double heading = 0.0;             ///< direction of travel, rad
  /// Frequencies that are kept, rad/s; none: all. The mean is never kept.
  std::optional<std::array<double, 2>> frequencies = {};
  WaveRamp ramp = {};
};

/// Components by the discrete Fourier transform (FFTW): at the samples the elevation at the origin
/// is that of the record less its mean, if all frequencies are kept; after its length it repeats.
/// @throws ModelError if there are fewer than 4 values, one is not finite (the message says which),
///   or no frequency is kept.
WaveField realise(const WaveRecord& record, const Water& water);

}  // namespace blocklift::dynamics
