#include "dynamics/marine/green/damping_beyond.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/errors.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;

// B = w^2 exp(-w) has K = (4/pi) (1 - 3 t^2)/(1 + t^2)^3.
double damping_at(double w) { return w * w * std::exp(-w); }
double memory_at(double t) {
  return 4.0 / std::numbers::pi * (1.0 - 3.0 * t * t) / std::pow(1.0 + t * t, 3);
}
/// A - A_inf = -(1/w) int K sin(w t) dt, by Simpson's rule.
double added_mass_at(double w) {
  constexpr int steps = 20000;
  constexpr double step = 0.01;
  double sum = 0.0;
  for (int n = 1; n < steps; ++n) {
    sum += (n % 2 == 1 ? 4.0 : 2.0) * memory_at(step * n) * std::sin(w * step * n);
  }
  return -sum * step / 3.0 / w;
}

/// Two modes that move alike, the second with half the force, known from 0.2 rad/s to `highest`.
DampingBeyond continue_from(double highest) {
  MatrixXd share(2, 2);
  share << 1.0, 0.5, 0.5, 0.25;
  std::vector<double> band, at;
  std::vector<MatrixXd> damping;
  constexpr int count = 1000;
  for (int i = 0; i <= count; ++i) {
    band.push_back(0.2 + (highest - 0.2) * i / count);
    damping.emplace_back(damping_at(band.back()) * share);
  }
  MatrixXd added_mass(2, 8);
  for (int k = 0; k < 8; ++k) {
    at.push_back(0.25 + (highest - 0.3) * k / 7.0);
    added_mass.col(k) = added_mass_at(at.back()) * share.diagonal();
  }
  return {std::move(band), std::move(damping), at, added_mass};
}

TEST(DampingBeyond, IntegralsOfDampingGiveMemoryAndAddedMass) {
  std::vector<double> frequencies;
  std::vector<MatrixXd> damping;
  for (int i = 0; i <= 4000; ++i) {
    frequencies.push_back(0.01 * i);
    damping.emplace_back(MatrixXd::Constant(1, 1, damping_at(frequencies.back())));
  }
  const auto K = integrate_damping(frequencies, damping, 0.5, 41);
  for (std::size_t n = 0; n < K.size(); ++n) {
    EXPECT_NEAR(K[n](0, 0), memory_at(0.5 * static_cast<double>(n)), 2e-5) << n;
  }
  // At a node, between two, and far from where the damping is. B is linear between samples 0.01
  // apart: off by 2e-5, of which A has twice as much where w is small.
  const std::vector<double> at = {0.25, 1.0, 2.345, 30.0};
  const auto A = integrate_added_mass(frequencies, damping, at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    EXPECT_NEAR(A[k](0, 0), added_mass_at(at[k]), 6e-5) << at[k];
  }
}

// An eighth of the damping lies beyond 5 rad/s, and two thirds beyond 2 rad/s, where it is at its
// peak. Added mass below tells how much there is: it follows again, whatever the shape beyond.
TEST(DampingBeyond, AddedMassTellsWhatIsBeyond) {
  for (const double highest : {5.0, 2.0}) {
    const DampingBeyond beyond = continue_from(highest);
    const std::vector<double> at = {0.25, 0.6, 1.0, 0.75 * highest};
    const auto A = integrate_added_mass(beyond.frequencies(), beyond.damping(), at);
    for (std::size_t k = 0; k < at.size(); ++k) {
      EXPECT_NEAR(A[k](0, 0), added_mass_at(at[k]), 0.01 * added_mass_at(0.25)) << at[k];
    }
  }
  const DampingBeyond beyond = continue_from(5.0);
  const auto K = integrate_damping(beyond.frequencies(), beyond.damping(), 0.25, 80);
  for (std::size_t n = 0; n < K.size(); ++n) {
    EXPECT_NEAR(K[n](0, 0), memory_at(0.25 * static_cast<double>(n)), 0.03 * memory_at(0.0)) << n;
  }
  EXPECT_NEAR(beyond.rises()[0], 2.0 - 0.2, 0.02);
}

// The sum over all frequencies, whatever moves, takes energy out; a negative eigenvalue in the
// band, of the size of panels' errors, is nothing afterwards.
TEST(DampingBeyond, NoEnergyComesOutOfTheWater) {
  std::vector<double> band;
  std::vector<MatrixXd> damping;
  for (int i = 0; i <= 200; ++i) {
    const double w = 0.5 + 0.01 * i;
    MatrixXd B(3, 3);
    B << 1.0, 1.001 * std::cos(3.0 * w), 0.0, 1.001 * std::cos(3.0 * w), 1.0, 0.0, 0.0, 0.0, -1e-3;
    band.push_back(w);
    damping.push_back(damping_at(w) * B);
  }
  const DampingBeyond beyond(band, damping, {0.6, 1.0}, MatrixXd::Zero(3, 2));
  EXPECT_EQ(beyond.frequencies().front(), 0.0);
  EXPECT_GT(beyond.frequencies().back(), 50.0);
  for (std::size_t k = 0; k < beyond.frequencies().size(); ++k) {
    MatrixXd vectors = beyond.damping()[k];
    EXPECT_GE(decompose_symmetric(vectors)[0], -1e-14) << beyond.frequencies()[k];
  }
  EXPECT_LT(beyond.damping().back().norm(), 1e-3);
  EXPECT_THROW(DampingBeyond({1.0, 2.0}, {MatrixXd::Ones(1, 1), MatrixXd::Ones(1, 1)}, {}, {}),
               ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics
