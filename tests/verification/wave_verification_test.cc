// Irregular seas: what a long realisation measures is what its spectrum says.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/waves/wave_spectrum.h"

namespace blocklift::dynamics {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

struct Statistics {
  double samples = 0, mean = 0, square = 0, fourth = 0;
  double above_one = 0, above_two = 0;  // samples above one and two standard deviations
  double crossings = 0;                 // upwards through zero
};

// Twenty storms of one hour, sampled twice a second.
Statistics measure(const WaveSpectrum& spectrum, double sigma, double duration, double step) {
  Statistics s;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const WaveField sea = realise(spectrum, {}, {.seed = seed});
    double last = sea.calc_elevation(0, 0, 0);
    for (double t = step; t < duration; t += step) {
      const double eta = sea.calc_elevation(t, 0, 0);
      s.samples += 1;
      s.mean += eta;
      s.square += eta * eta;
      s.fourth += std::pow(eta, 4);
      s.above_one += eta > sigma ? 1 : 0;
      s.above_two += eta > 2 * sigma ? 1 : 0;
      s.crossings += last < 0 && eta >= 0 ? 1 : 0;
      last = eta;
    }
  }
  return s;
}

// 20 h of waves of 7 s are 10,000 waves: counting errors are about 1/sqrt(10,000) of a count of
// waves, a few times that for the rarer samples above two deviations.
TEST(IrregularSea, MeasuresWhatTheSpectrumSays) {
  const double Hs = 3, Tp = 9, duration = 3600;
  const WaveSpectrum spectrum = WaveSpectrum::jonswap(Hs, Tp);
  const Statistics s = measure(spectrum, Hs / 4, duration, 0.5);
  EXPECT_NEAR(s.mean / s.samples, 0, 0.002 * Hs);
  EXPECT_NEAR(4 * std::sqrt(s.square / s.samples), Hs, 0.01 * Hs);
  const auto range = spectrum.range(1e-3);
  double m0 = 0, m2 = 0;  // of the band that is realised
  for (int i = 0; i < 2000; ++i) {
    const double step = (range[1] - range[0]) / 2000, omega = range[0] + (i + 0.5) * step;
    m0 += spectrum.density(omega) * step;
    m2 += omega * omega * spectrum.density(omega) * step;
  }
  EXPECT_NEAR(20 * duration / s.crossings, two_pi * std::sqrt(m0 / m2), 0.02 * 7);
  // Gaussian: kurtosis 3, 15.87 % and 2.275 % above one and two standard deviations.
  EXPECT_NEAR(s.fourth * s.samples / (s.square * s.square), 3, 0.1);
  EXPECT_NEAR(s.above_one / s.samples, 0.1587, 0.003);
  EXPECT_NEAR(s.above_two / s.samples, 0.02275, 0.0015);
}

// cos^2: the mean of cos is 8/(3 pi), the variance of the angle pi^2/12 - 1/2. 4,000 draws with a
// standard deviation of 0.57 leave an error of 0.009 in the mean angle.
TEST(ShortCrestedSea, SpreadsAsTheCosineSays) {
  double count = 0, mean = 0, cosine = 0, square = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const WaveField sea = realise(WaveSpectrum::pierson_moskowitz(2, 8), {},
                                  {.heading = 1.0, .spreading_exponent = 2.0, .seed = seed});
    for (std::size_t i = 0; i < sea.component_count(); ++i) {
      const double angle = sea.component(i).heading - 1.0;
      EXPECT_LE(std::abs(angle), std::numbers::pi / 2);
      count += 1;
      mean += angle;
      cosine += std::cos(angle);
      square += angle * angle;
    }
  }
  EXPECT_NEAR(mean / count, 0, 0.027);
  EXPECT_NEAR(cosine / count, 8 / (3 * std::numbers::pi), 0.01);
  EXPECT_NEAR(square / count, std::numbers::pi * std::numbers::pi / 12 - 0.5, 0.02);
}

// Linear waves: kinetic energy in a column equals potential energy, and the power through a
// vertical plane is their sum times the group velocity. Averaged over a period, by the midpoint
// rule in depth
// (second order) for an amplitude so small that what lies above z = 0 does not count.
TEST(RegularWave, CarriesItsEnergyAtTheGroupVelocity) {
  for (const double depth : {6.0, 20.0, 400.0}) {
    const Water water = {.depth = depth};
    const double a = 1e-4, omega = 0.9;
    const WaveField wave(water, {{a, omega, 0, 0}});
    const double k = wave.wave_number(0);
    const double bottom = std::min(depth, 12 / k);
    double kinetic = 0, power = 0;
    constexpr int layers = 4000, phases = 16;
    for (int i = 0; i < layers; ++i) {
      const double z = -(i + 0.5) * bottom / layers;
      for (int j = 0; j < phases; ++j) {
        const double t = two_pi / omega * j / phases;
        const Vector3 u = wave.calc_velocity(t, {0, 0, z});
        const double head = wave.calc_dynamic_head(t, {0, 0, z});
        const double weight = bottom / layers / phases;
        kinetic += 0.5 * water.density * u.squaredNorm() * weight;
        power += water.density * water.gravity * head * u.x() * weight;
      }
    }
    const double potential = 0.5 * wave.energy_density();
    EXPECT_NEAR(kinetic, potential, 2e-4 * potential) << depth;
    const double flux = wave.energy_density() * calc_group_velocity(omega, water);
    EXPECT_NEAR(power, flux, 2e-4 * flux) << depth;
  }
}

}  // namespace
}  // namespace blocklift::dynamics
