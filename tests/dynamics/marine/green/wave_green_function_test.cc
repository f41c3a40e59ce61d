#include "dynamics/marine/green/wave_green_function.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/algebra/gauss_legendre.h"
#include "dynamics/errors.h"
#include "dynamics/marine/green/deep_water_integral.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr double g0 = 9.81, depth = 20.0;  ///< m/s2, m

/// Integral from one m to another in pieces of a length at most, 16 points to each; a pole may lie
/// in the middle of a single piece.
template <class Function>
double integrate(double from, double to, double longest, const Function& f) {
  static const QuadratureRule rule = make_gauss_legendre(16);
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / longest)));
  const double half = 0.5 * (to - from) / pieces;
  double sum = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      sum += half * rule.weights[i] * f(from + half * (2 * piece + 1 + rule.points[i]));
    }
  }
  return sum;
}

/// PV of the integral from 0 over f with a pole at k, as far as `end`: from either side of the pole
/// the values are taken together, which leaves no pole.
template <class Function>
double integrate_past(double k, double end, double longest, const Function& f) {
  const double beside = integrate(0.0, k, longest, [&](double d) { return f(k - d) + f(k + d); });
  return beside + (end > 2.0 * k ? integrate(2.0 * k, end, longest, f) : 0.0);
}

TEST(DeepWaterIntegral, AgreesWithItsDefinition) {
  const DeepWaterIntegral& tables = DeepWaterIntegral::tables();
  for (const double Y : {0.06, 0.3, 1.0, 2.5, 6.0, 12.0, 17.0, 17.9, 18.1, 30.0, 100.0}) {
    for (const double X : {0.0, 0.01, 0.2, 1.0, 3.0, 7.0, 12.0, 18.0, 18.9, 19.1, 35.0}) {
      const double exact =
          integrate_past(1.0, 2.0 + 40.0 / Y, std::min(0.25, 4.0 / (X + Y)),
                         [&](double t) { return std::exp(-t * Y) * ::j0(t * X) / (t - 1.0); });
      const double rho = std::hypot(X, Y), decay = std::exp(-Y);
      double found = 0.0;
      if (rho < DeepWaterIntegral::near) {
        found = tables.at_near(X, Y, rho, decay, ::j0(X), ::j1(X)).value;
      } else {
        found = -tables.at_far(X, Y, rho).value;
        if (Y < DeepWaterIntegral::no_waves) found -= pi * decay * ::y0(X);
      }
      EXPECT_NEAR(found, exact, 5e-8) << "X " << X << ", Y " << Y;
    }
  }
}

/// G without 1/r by its definition: W&L (1960) 13.18 with exp(i w t).
Complex by_quadrature(double w, double R, double z, double zeta) {
  const double h = depth, K = w * w / g0, k = calc_wave_number(w, {1000.0, g0, h});
  // Multiplied by exp(-m h) above and below.
  const auto integrand = [&](double m) {
    const double both =
        0.5 * (std::exp(m * (z + zeta)) + std::exp(m * (z - zeta - 2 * h)) +
               std::exp(m * (zeta - z - 2 * h)) + std::exp(-m * (z + zeta + 4 * h)));
    const double down = std::exp(-2.0 * m * h);
    return 2.0 * (m + K) * both / (m * (1.0 - down) - K * (1.0 + down)) * ::j0(m * R);
  };
  const double end = 45.0 / -(z + zeta);
  const double real =
      integrate_past(k, std::max(end, 2.5 * k), std::min(0.6 / h, 4.0 / (R + h)), integrand);
  const auto profile = [&](double height) {
    return (std::exp(k * height) + std::exp(-k * (height + 2 * h))) / (1.0 + std::exp(-2 * k * h));
  };
  const double slope = k * h > 300.0 ? 0.0 : std::pow(k / std::cosh(k * h), 2);
  const double residue =
      2.0 * pi * k * k / (slope * h + K) * profile(z) * profile(zeta) * ::j0(k * R);
  return {real + 1.0 / std::hypot(R, z + zeta + 2 * h), -residue};
}

/// All of it but 1/r.
Complex by_tables(const WaveGreenFunction& green, double R, double z, double zeta) {
  return green.at(R, green.level(z), green.level(zeta)).g + 1.0 / std::hypot(R, z + zeta) +
         1.0 / std::hypot(R, z + zeta + 2 * depth);
}

double frequency_of(double kh) { return std::sqrt(g0 * kh / depth * std::tanh(kh)); }

class WavesOfAnyLength : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(KH, WavesOfAnyLength,
                         ::testing::Values(0.05, 0.4, 1.0, 3.0, 8.0, 15.0, 19.0, 21.0, 30.0, 45.0,
                                           100.0));

// From long waves in shallow water to short ones that do not feel the bottom, past the wave numbers
// at which the tables are made in another way.
TEST_P(WavesOfAnyLength, TheTablesAgreeWithTheDefinition) {
  const double w = frequency_of(GetParam()), K = w * w / g0;
  for (const double deepest : {4.0, depth}) {
    const WaveGreenFunction green({1000.0, g0, depth}, w, 130.0, deepest);
    for (const double R : {0.01, 0.3, 2.0, 9.0, 31.0, 129.0}) {
      for (const double a : {0.02, 0.3, 1.0}) {
        for (const double b : {0.1, 0.7, 1.0}) {
          const double z = -a * deepest, zeta = -b * deepest;
          const Complex exact = by_quadrature(w, R, z, zeta);
          const double scale = std::max({K, 1.0 / depth, 1.0 / std::hypot(R, z + zeta)});
          EXPECT_LT(std::abs(by_tables(green, R, z, zeta) - exact), 1e-6 * scale)
              << "R " << R << ", z " << z << ", zeta " << zeta;
        }
      }
    }
  }
}

// The source's potential has no sources but itself, is still at the bottom, and keeps the
// condition at the surface; derivatives are those of the values.
TEST_P(WavesOfAnyLength, TheConditionsHold) {
  const double w = frequency_of(GetParam());
  const WaveGreenFunction green({1000.0, g0, depth}, w, 130.0, depth);
  const double K = green.deep_wave_number();
  for (const double R : {0.8, 7.0, 60.0}) {
    for (const double zeta : {-0.5, -3.0, -14.0}) {
      const WaveGreenFunction::Level source = green.level(zeta);
      const double scale = std::pow(std::max({K, 1.0 / depth, 1.0 / std::hypot(R, zeta)}), 2);
      const WaveGreenFunction::Value top = green.at(R, green.level(0.0), source);
      const double r = std::hypot(R, zeta), bottom = std::hypot(R, zeta + 2 * depth);
      // 1/r + 1/r1 has no slope in z = 0.
      const Complex slope = top.along_z + 2.0 * K / r - (zeta + 2 * depth) / std::pow(bottom, 3);
      EXPECT_LT(std::abs(slope - K * (top.g + 2.0 / r + 1.0 / bottom)), 2e-6 * scale);
      const WaveGreenFunction::Value down = green.at(R, green.level(-depth), source);
      const double image = std::hypot(R, zeta - depth);
      EXPECT_LT(std::abs(down.along_z + 2.0 * K / image - (zeta - depth) / std::pow(image, 3)),
                2e-6 * scale);

      const double z = -2.0, d = 1e-3 / std::max(1.0, K);
      const auto at = [&](double distance, double height, double below) {
        return green.at(distance, green.level(height), green.level(below));
      };
      const WaveGreenFunction::Value value = at(R, z, zeta);
      const double cut = 2.0 * K / std::hypot(R, z + zeta);
      const double loose = 1e-5 * scale;
      EXPECT_LT(std::abs((at(R + d, z, zeta).g - at(R - d, z, zeta).g) / (2 * d) - value.along_R),
                loose);
      EXPECT_LT(
          std::abs((at(R, z + d, zeta).g - at(R, z - d, zeta).g) / (2 * d) - cut - value.along_z),
          loose);
      EXPECT_LT(std::abs((at(R, z, zeta + d).g - at(R, z, zeta - d).g) / (2 * d) - cut -
                         value.along_zeta),
                loose);
      EXPECT_LT(std::abs(at(R, zeta, z).g - value.g), 1e-12 * std::sqrt(scale));
      // Laplace's equation, of the slopes.
      const auto upright = [&](double height) {
        return at(R, height, zeta).along_z + 2.0 * K / std::hypot(R, height + zeta);
      };
      const Complex laplace = (at(R + d, z, zeta).along_R - at(R - d, z, zeta).along_R) / (2 * d) +
                              value.along_R / R + (upright(z + d) - upright(z - d)) / (2 * d);
      EXPECT_LT(std::abs(laplace), 2e-3 * scale * std::sqrt(scale));
    }
  }
}

// Far away nothing is left but the waves that go outwards.
TEST_P(WavesOfAnyLength, WavesGoOutwards) {
  const double w = frequency_of(GetParam());
  const WaveGreenFunction green({1000.0, g0, depth}, w, 400.0, 3.0);
  const double k = green.wave_number(), K = green.deep_wave_number(), R = 395.0;
  const WaveGreenFunction::Level a = green.level(-1.0), b = green.level(-2.5);
  const double strength = 2.0 * pi * k * k / ((k * k - K * K) * depth + K);
  const Complex waves =
      Complex(0.0, -strength * a.profile * b.profile) * Complex(::j0(k * R), -::y0(k * R));
  // Of short waves the local flow is left over deep water: 2 (1 + K z)(1 + K zeta)/(K^2 R^3).
  EXPECT_LT(std::abs(by_tables(green, R, -1.0, -2.5) + 1.0 / std::hypot(R, 1.5) - waves),
            1e-6 * std::max(K, 1.0 / depth));
}

// The limit of an impulse: images that change their sign in z = 0 and keep it at the bottom.
TEST(WaveGreenFunction, InfiniteFrequencyIsASumOfImages) {
  const WaveGreenFunction green({1000.0, g0, depth}, std::numeric_limits<double>::infinity(), 100.0,
                                depth);
  for (const double R : {0.5, 10.0, 90.0}) {
    for (const double z : {-0.5, -7.0, -19.0}) {
      const double zeta = -4.0;
      double sum = 0.0;
      constexpr int last = 4000;
      for (int n = -last; n <= last; ++n) {
        // The alternating sum, halved at its ends.
        const double sign = (n % 2 == 0 ? 1.0 : -1.0) * (std::abs(n) == last ? 0.5 : 1.0);
        sum += sign / std::hypot(R, z - zeta - 2 * n * depth) -
               sign / std::hypot(R, z + zeta - 2 * n * depth);
      }
      const double found = green.at(R, green.level(z), green.level(zeta)).g.real() +
                           1.0 / std::hypot(R, z - zeta) - 1.0 / std::hypot(R, z + zeta) +
                           1.0 / std::hypot(R, z + zeta + 2 * depth);
      EXPECT_NEAR(found, sum, 1e-8);
    }
  }
}

TEST(WaveGreenFunction, RefusesWhatIsOutOfTheWater) {
  const Water water{1000.0, g0, depth};
  EXPECT_THROW(WaveGreenFunction(water, 1.0, 10.0, 21.0), ModelError);
  EXPECT_THROW(WaveGreenFunction(water, 0.0, 10.0, 2.0), ModelError);
  EXPECT_THROW(WaveGreenFunction(water, 1.0, 0.0, 2.0), ModelError);
}

TEST(GaussLegendre, IntegratesPolynomialsExactly) {
  for (const int order : {1, 2, 5, 16, 121}) {
    const QuadratureRule rule = make_gauss_legendre(order);
    for (int power = 0; power < std::min(2 * order, 20); ++power) {
      double sum = 0.0;
      for (std::size_t i = 0; i < rule.points.size(); ++i) {
        sum += rule.weights[i] * std::pow(rule.points[i], power);
      }
      EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-13);
    }
  }
}

}  // namespace
}  // namespace blocklift::dynamics
