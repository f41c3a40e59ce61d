#include "dynamics/marine/waves/waves.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/force/random_source.h"
#include "dynamics/marine/waves/current.h"
#include "dynamics/marine/waves/wave_kernel.h"
#include "dynamics/marine/waves/wave_spectrum.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double two_pi = 2 * std::numbers::pi;
const Water deep_sea = {.density = 1025, .gravity = 9.81};

WaveField short_crested(double depth) {
  const Water water = {.density = 1025, .gravity = 9.81, .depth = depth};
  return realise(WaveSpectrum::jonswap(2, 8), water,
                 {.heading = 0.7, .spreading_exponent = 2.0, .components = 40, .seed = 3});
}

// The paper's wave: 0.628 rad/s is a length of 156 m in deep water.
TEST(Dispersion, DeepShallowAndBetween) {
  EXPECT_NEAR(two_pi / calc_wave_number(0.628, deep_sea), 156.3, 0.1);
  for (const double depth : {0.1, 1.0, 10.0, 50.0, 1e3, 1e5}) {
    const Water water = {.gravity = 9.81, .depth = depth};
    for (double omega = 1e-3; omega < 20; omega *= 1.3) {
      const double k = calc_wave_number(omega, water);
      EXPECT_NEAR(9.81 * k * std::tanh(k * depth), omega * omega, 1e-13 * omega * omega);
      const double step = 1e-5 * omega;
      const double numeric =
          2 * step /
          (calc_wave_number(omega + step, water) - calc_wave_number(omega - step, water));
      EXPECT_NEAR(calc_group_velocity(omega, water), numeric, 1e-6 * numeric);
    }
  }
  EXPECT_NEAR(calc_wave_number(0.01, {.gravity = 9.81, .depth = 1}), 0.01 / std::sqrt(9.81), 1e-6);
  EXPECT_THROW(calc_wave_number(-1, deep_sea), ModelError);
}

TEST(Waves, RegularWaveIsThatOfThePaper) {
  const double A = 0.5, omega = 0.628, b = std::numbers::pi / 4;
  const WaveField wave(deep_sea, {{A, omega, b, 0}});
  const double k = omega * omega / 9.81;
  const Vector3 p(30, -12, -4);
  const double t = 3.7;
  const double theta = k * (p.x() * std::cos(b) + p.y() * std::sin(b)) - omega * t;
  const double eta = A * std::cos(theta);
  EXPECT_NEAR(wave.calc_elevation(t, p.x(), p.y()), eta, 1e-14);
  // Wheeler: the exponent counts from the wave's surface.
  EXPECT_NEAR(wave.calc_dynamic_head(t, p), A * std::exp(k * (-4 - eta)) * std::cos(theta), 1e-14);
  EXPECT_NEAR(wave.calc_velocity(t, p).z(), A * omega * std::exp(k * (-4 - eta)) * std::sin(theta),
              1e-14);
}

// The second consistency rule: the whole pressure vanishes at the surface of any sea.
TEST(Waves, PressureVanishesAtTheSurface) {
  for (const double depth : {8.0, 40.0, std::numeric_limits<double>::infinity()}) {
    const WaveField sea = short_crested(depth);
    for (int i = 0; i < 50; ++i) {
      const double x = 7.0 * i, y = -3.0 * i, t = 0.9 * i;
      const double eta = sea.calc_elevation(t, x, y);
      EXPECT_NEAR(sea.calc_dynamic_head(t, {x, y, eta}) - eta, 0, 1e-13);
    }
  }
}

// On the calm line of small waves: continuity (div u = 0), Euler (du/dt = -grad p_d/rho), the
// bottom, and the surface. Amplitudes of 1e-6 make the stretching negligible (second order).
TEST(Waves, SatisfyTheFieldEquations) {
  const Water water = {.density = 1025, .gravity = 9.81, .depth = 15};
  const WaveField sea(water, {{1e-6, 0.9, 0.4, 1.0}, {2e-6, 1.3, -1.0, 2.0}});
  const Vector3 p(3, 5, -6);
  const double t = 2, step = 1e-3;
  const auto head_slope = [&](int axis) {
    const Vector3 e = step * Vector3::Unit(axis);
    return (sea.calc_dynamic_head(t, p + e) - sea.calc_dynamic_head(t, p - e)) / (2 * step);
  };
  double divergence = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 e = step * Vector3::Unit(axis);
    divergence += (sea.calc_velocity(t, p + e) - sea.calc_velocity(t, p - e))[axis] / (2 * step);
    EXPECT_NEAR(sea.calc_acceleration(t, p)[axis], -9.81 * head_slope(axis), 1e-11);
  }
  EXPECT_NEAR(divergence, 0, 1e-11);
  const Vector3 rate =
      (sea.calc_velocity(t + step, p) - sea.calc_velocity(t - step, p)) / (2 * step);
  EXPECT_LT((rate - sea.calc_acceleration(t, p)).norm(), 1e-11);
  EXPECT_NEAR(sea.calc_velocity(t, {3, 5, -15}).z(), 0, 1e-12);
  const double rise =
      (sea.calc_elevation(t + step, 3, 5) - sea.calc_elevation(t - step, 3, 5)) / (2 * step);
  EXPECT_NEAR(sea.calc_velocity(t, {3, 5, 0}).z(), rise, 1e-11);
}

TEST(Waves, ManyPointsAtOnceAreTheSame) {
  for (const double depth : {12.0, std::numeric_limits<double>::infinity()}) {
    const WaveField sea = short_crested(depth);
    RandomSource random(9);
    std::array<Vector3, 36> points;
    std::array<double, 36> elevation, head;
    for (Vector3& p : points) {
      p = {400 * random.uniform() - 200, 400 * random.uniform() - 200, 3 - 14 * random.uniform()};
    }
    for (const double t : {0.0, 11.3, 20000.0}) {
      sea.calc_surface(t, points, elevation, head);
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(elevation[i], sea.calc_elevation(t, points[i].x(), points[i].y()), 1e-10);
        EXPECT_NEAR(head[i], sea.calc_dynamic_head(t, points[i]),
                    WaveSum::depth_error * sea.significant_height());
      }
    }
  }
}

// One wave at a time against cosh(k (z + h))/cosh(k h): the carriers' error, whatever the depth.
TEST(WaveSum, DepthIsWithinTheStatedError) {
  for (const double depth : {0.3, 3.0, 20.0, std::numeric_limits<double>::infinity()}) {
    double worst = 0;
    for (double k = 0.05; k < 5; k *= 1.31) {
      std::vector<WaveSum::Wave> waves = {
          {0, 0.04, 0, 0, 1, 0}, {1, k, 0, 0, 1, 0}, {0, 6, 0, 0, 1, 0}};
      const WaveSum sum(waves, depth);
      for (double z = 1e-3; z < std::min(depth, 200.0); z *= 1.17) {
        const double zero = 0, below = -z;
        // Without stretching: a scale so small that the surface stays at zero.
        double elevation, head;
        sum.calc_surface(0, 1e-9, 1, &zero, &zero, &below, &elevation, &head);
        const double exact =
            (std::exp(-k * z) + std::exp(k * (z - 2 * depth))) / (1 + std::exp(-2 * k * depth));
        worst = std::max(worst, std::abs(1e9 * head - exact));
        EXPECT_NEAR(1e9 * elevation, 1, 1e-13);
      }
    }
    EXPECT_LT(worst, std::isinf(depth) ? 1.3e-6 : WaveSum::depth_error);
    EXPECT_GT(worst, 1e-8);
  }
}

// Any number of points and of waves, long- and short-crested, from one direction or many; few waves
// are summed one by one and many together, and both are the sea.
TEST(WaveSum, IsTheSeaForAnyNumber) {
  RandomSource random(6);
  for (const int components : {2, 7, 8, 9, 61, 500}) {
    const WaveField sea =
        realise(WaveSpectrum::jonswap(2, 8), deep_sea, {.components = components});
    EXPECT_EQ(sea.has_many_components(), components >= 8);
    for (const std::size_t count : {1U, 7U, 8U, 19U}) {
      std::vector<double> x(count), y(count), z(count), elevation(count), head(count), alone(count);
      for (std::size_t i = 0; i < count; ++i) {
        x[i] = 300 * random.uniform();
        y[i] = 300 * random.uniform();
        z[i] = -9 * random.uniform();
      }
      sea.calc_surface(7.7, count, x.data(), y.data(), z.data(), elevation.data(), head.data());
      sea.calc_elevations(7.7, count, x.data(), y.data(), alone.data());
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_NEAR(elevation[i], sea.calc_elevation(7.7, x[i], y[i]), 1e-11);
        EXPECT_NEAR(alone[i], elevation[i], 1e-12);
        EXPECT_NEAR(head[i], sea.calc_dynamic_head(7.7, {x[i], y[i], z[i]}), 1e-5);
      }
    }
  }
}

// The vectorised functions against the C library's.
TEST(WaveKernel, IsAccurate) {
  RandomSource random(4);
  std::array<double, 1000> x, y{}, z, sum;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = (random.uniform() - 0.5) * (i % 2 ? 2e5 : 20);
    z[i] = -800 * random.uniform() * random.uniform();
  }
  const double one = 1, zero = 0;
  WaveTerms terms = {1, &one, &one, &one, &zero, &zero, &zero};
  sum.fill(0);
  add_wave_elevation(terms, 0, 1, x.size(), x.data(), y.data(), sum.data());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(sum[i], std::cos(x[i]), 1e-15);
  sum.fill(0);
  terms.kx = &zero;
  add_wave_head(terms, std::numeric_limits<double>::infinity(), 0, 1, x.size(), x.data(), y.data(),
                z.data(), sum.data());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double exact = std::exp(std::max(z[i], -700.0));
    EXPECT_NEAR(sum[i], exact, 1e-15 * exact);
  }
}

TEST(Waves, GrowAlongTheRamp) {
  const WaveField wave(deep_sea, {{1, 1, 0, 0}}, {.start = 10, .duration = 20});
  EXPECT_EQ(wave.calc_elevation(9, 0, 0), 0);
  EXPECT_NEAR(wave.calc_elevation(20, 0, 0), 0.5 * std::cos(-20), 1e-14);
  EXPECT_NEAR(wave.calc_elevation(31, 0, 0), std::cos(-31), 1e-14);
}

TEST(Waves, StillWaterAndWrongNumbers) {
  const WaveField still(deep_sea);
  EXPECT_EQ(still.calc_elevation(3, 1, 2), 0);
  EXPECT_EQ(still.calc_velocity(3, {1, 2, -3}).norm(), 0);
  EXPECT_THAT(
      [] {
        WaveField(deep_sea, {{-1, 1, 0, 0}});
      },
      ThrowsMessage<ModelError>(HasSubstr("wave component 0 has the amplitude -1")));
  EXPECT_THAT(
      [] {
        WaveField({.depth = -3}, {{1, 1, 0, 0}});
      },
      ThrowsMessage<ModelError>(HasSubstr("water depth is -3")));
}

// 0.142 of 15.6 m (omega 2 rad/s) is 2.2 m.
TEST(Waves, BreakWhenSteep) {
  require_not_breaking(WaveField(deep_sea, {{1.0, 2, 0, 0}}));
  EXPECT_THAT(
      [] {
        require_not_breaking(WaveField(deep_sea, {{1.2, 2, 0, 0}}));
      },
      ThrowsMessage<ModelError>(HasSubstr("breaks: at most 2.1")));
  // Hs 4 m at Tp 8 s: Tz about 6.1 s, steepness 0.07. Hs 6 m: 0.1, too much.
  const auto sea = [](double Hs) { return realise(WaveSpectrum::jonswap(Hs, 8), deep_sea, {}); };
  require_not_breaking(sea(4));
  EXPECT_THAT([&] { require_not_breaking(sea(7)); },
              ThrowsMessage<ModelError>(HasSubstr("significant height of 6.9")));
}

// Gamma functions give the moments of A w^-5 exp(-B w^-4): m0 = A/4B, m1 = A Gamma(3/4)/(4 B^3/4),
// m2 = sqrt(pi) A/(4 sqrt B). The second moment's tail beyond 1e4 peaks is 1e-8 of it.
TEST(WaveSpectrum, MomentsOfTheIssc) {
  const double Hs = 3, T1 = 7.5;
  const WaveSpectrum spectrum = WaveSpectrum::issc(Hs, T1);
  const double B = std::pow(two_pi / (T1 * std::tgamma(0.75)), 4), A = B * Hs * Hs / 4;
  EXPECT_NEAR(spectrum.moment(0), Hs * Hs / 16, 1e-10);
  EXPECT_NEAR(two_pi * spectrum.moment(0) / spectrum.moment(1), T1, 1e-7);
  EXPECT_NEAR(spectrum.moment(2), std::sqrt(std::numbers::pi) * A / (4 * std::sqrt(B)), 1e-7);
  for (const double w : {0.4, 0.9, 2.0}) {
    EXPECT_NEAR(spectrum.density(w), A * std::pow(w, -5) * std::exp(-B * std::pow(w, -4)),
                1e-9 * spectrum.density(w));
  }
}

TEST(WaveSpectrum, FullyDevelopedAndJonswap) {
  // Pierson and Moskowitz: alpha g^2 at high frequency.
  const WaveSpectrum sea = WaveSpectrum::fully_developed(3, 9.81);
  EXPECT_NEAR(sea.density(20) * std::pow(20, 5), 0.0081 * 9.81 * 9.81, 1e-4);
  EXPECT_NEAR(sea.significant_height(), 3, 1e-9);
  const WaveSpectrum jonswap = WaveSpectrum::jonswap(2.5, 9, 3.3);
  EXPECT_NEAR(jonswap.significant_height(), 2.5, 1e-9);
  // The peak rises by gamma over the unenhanced shape, at 2/3 of its area (DNV: 1 - 0.287 ln 3.3).
  const double ratio =
      jonswap.density(two_pi / 9) / WaveSpectrum::pierson_moskowitz(2.5, 9).density(two_pi / 9);
  EXPECT_NEAR(ratio, 3.3 * (1 - 0.287 * std::log(3.3)), 0.02);
  // Tz/Tp of the DNV-RP-C205, 3.5.5.4, for gamma 3.3: 0.6673 + 0.05037 g - 0.006230 g^2 + 0.0003341
  // g^3.
  const double Tz = two_pi * std::sqrt(jonswap.moment(0) / jonswap.moment(2));
  EXPECT_NEAR(Tz / 9, 0.6673 + 0.05037 * 3.3 - 0.00623 * 10.89 + 0.0003341 * 35.937, 2e-3);
  const auto range = jonswap.range(1e-3);
  EXPECT_NEAR(jonswap.energy_between(range[0], range[1]), 0.998 * jonswap.moment(0),
              1e-5 * jonswap.moment(0));
}

TEST(WaveSpectrum, TablesAreLinear) {
  const WaveSpectrum table = WaveSpectrum::table({0.5, 1.0, 2.0}, {0, 2, 0});
  EXPECT_NEAR(table.moment(0), 1.5, 1e-9);
  EXPECT_NEAR(table.density(0.75), 1, 1e-12);
  EXPECT_EQ(table.density(2.5), 0);
  EXPECT_THAT(
      [] {
        WaveSpectrum::table({0.5, 0.4}, {1, 1});
      },
      ThrowsMessage<ModelError>(HasSubstr("must ascend")));
}

TEST(Realisation, KeepsTheEnergyAndIsReproducible) {
  const WaveSpectrum spectrum = WaveSpectrum::jonswap(3, 10);
  const WaveField one = realise(spectrum, deep_sea, {.seed = 7});
  const WaveField same = realise(spectrum, deep_sea, {.seed = 7});
  const WaveField other = realise(spectrum, deep_sea, {.seed = 8});
  EXPECT_EQ(one.calc_elevation(12.5, 3, 4), same.calc_elevation(12.5, 3, 4));
  EXPECT_NE(one.calc_elevation(12.5, 3, 4), other.calc_elevation(12.5, 3, 4));
  // 0.1 % of the energy is left out at each end.
  EXPECT_NEAR(one.significant_height(), 3 * std::sqrt(0.998), 1e-4);
  EXPECT_NEAR(one.energy_density(), 1025 * 9.81 * 0.998 * 9 / 16, 0.5);
}

// The first draws of std::mt19937_64, fixed by the standard through its 10000th value with the
// default seed, keep seas the same for ever.
TEST(RandomSource, FollowsTheStandardsEngine) {
  std::mt19937_64 engine(5489);
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042ULL);
  RandomSource source(5489);
  for (int i = 0; i < 9999; ++i) source.uniform();
  EXPECT_EQ(source.uniform(), static_cast<double>(9981545732273789042ULL >> 11) * 0x1p-53);
}

TEST(Realisation, GivesBackARecord) {
  RandomSource random(2);
  for (const std::size_t count : {64U, 65U}) {
    WaveRecord record = {.elevation = {}, .time_step = 0.5, .start_time = 100, .heading = 0.3};
    double mean = 0;
    for (std::size_t i = 0; i < count; ++i) {
      record.elevation.push_back(random.uniform());
      mean += record.elevation.back() / static_cast<double>(count);
    }
    const WaveField sea = realise(record, deep_sea);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(sea.calc_elevation(100 + 0.5 * static_cast<double>(i), 0, 0),
                  record.elevation[i] - mean, 1e-12);
    }
  }
  EXPECT_THAT(
      [] {
        realise(WaveRecord{.elevation = {1, 2, not_a_number, 3}, .time_step = 1}, deep_sea);
      },
      ThrowsMessage<ModelError>(HasSubstr("value 2 of a record")));
}

TEST(Current, FollowsItsProfile) {
  EXPECT_LT(
      (Current::uniform(2, std::numbers::pi / 2).calc_velocity(-30) - Vector3(0, 2, 0)).norm(),
      1e-15);
  const Current wind = Current::wind_driven(1, 0, 50);
  EXPECT_NEAR(wind.calc_velocity(-25).x(), 0.5, 1e-14);
  EXPECT_EQ(wind.calc_velocity(-60).x(), 0);
  EXPECT_EQ(wind.calc_velocity(3).x(), 1);
  const Current tidal = Current::tidal(1.5, 0, 40);
  for (double z = -40; z <= 0; z += 0.5) {
    EXPECT_NEAR(tidal.calc_velocity(z).x(), 1.5 * std::pow((40 + z) / 40, 1.0 / 7),
                0.015 * 1.5 + (z < -39.99 ? 1 : 0));
  }
  EXPECT_THAT(
      [] {
        Current({{2.0, 1.0, 0.0}});
      },
      ThrowsMessage<ModelError>(HasSubstr("not above zero")));
}

}  // namespace
}  // namespace blocklift::dynamics
