#include "dynamics/marine/radiation/response_amplitude.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_shapes.h"

namespace blocklift::dynamics {
namespace {

// A box of L x B x T: C33 = L B, C44 = V GM_T, C55 = V GM_L over rho g, nothing else.
TEST(FloatingStiffness, OfABoxFollowsFromItsMetacentres) {
  const double L = 40, B = 12, T = 3, KG = 4;
  const HullClusters box(make_barge({.length = L, .breadth = B, .depth = 6}, {8, 4, 3, 1}));
  const Hydrostatics rest = calc_hydrostatics(box, Pose::translation({0, 0, -T}));
  const auto C = calc_floating_stiffness_over_rho_g(rest, {0, 0, KG});
  const double V = L * B * T;
  Eigen::Matrix<double, 6, 6> exact = Eigen::Matrix<double, 6, 6>::Zero();
  exact(2, 2) = L * B;
  exact(3, 3) = V * (T / 2 + B * B / (12 * T) - KG);
  exact(4, 4) = V * (T / 2 + L * L / (12 * T) - KG);
  EXPECT_LT((C - exact).norm(), 1e-12 * exact.norm());
}

// The centre of mass forward of the middle by e: heave and pitch couple by L B e, and the centre of
// buoyancy hangs by e behind, which weighs nothing about the level axes in the first order.
TEST(FloatingStiffness, MovesWithTheCentreOfMass) {
  const double L = 40, B = 12, T = 3, e = 1.5;
  const HullClusters box(make_barge({.length = L, .breadth = B, .depth = 6}, {8, 4, 3, 1}));
  const Hydrostatics rest = calc_hydrostatics(box, Pose::translation({0, 0, -T}));
  const auto C = calc_floating_stiffness_over_rho_g(rest, {e, 0, 4});
  EXPECT_NEAR(C(2, 4), L * B * e, 1e-9);
  EXPECT_NEAR(C(4, 2), L * B * e, 1e-9);
  EXPECT_NEAR(C(4, 4), L * B * (L * L / 12 + e * e) + L * B * T * (T / 2 - 4), 1e-8);
}

HydrodynamicDatabase single_mode_database() {
  HydrodynamicDatabase database;
  database.body_names = {"body"};
  database.frequencies = {0.5, 1.0, 2.0};
  database.headings = {0.0};
  for (int k = 0; k < 3; ++k) {
    database.added_mass.emplace_back(3.0 * Eigen::MatrixXd::Identity(6, 6));
    database.damping.emplace_back(0.4 * Eigen::MatrixXd::Identity(6, 6));
    database.froude_krylov.emplace_back(Eigen::MatrixXcd::Constant(6, 1, 2.0));
    database.diffraction.emplace_back(Eigen::MatrixXcd::Constant(6, 1, {0.0, 1.0}));
  }
  database.hydrostatic_stiffness = Eigen::MatrixXd::Zero(6, 6);
  database.hydrostatic_stiffness(2, 2) = 10.0;
  return database;
}

TEST(ResponseAmplitude, IsThatOfOneOscillator) {
  const HydrodynamicDatabase database = single_mode_database();
  const auto response = calc_response_amplitudes(database, 2.0 * Eigen::MatrixXd::Identity(6, 6));
  for (std::size_t k = 0; k < 3; ++k) {
    const double w = database.frequencies[k];
    const std::complex<double> exact =
        std::complex(2.0, 1.0) / std::complex(10.0 - 5.0 * w * w, 0.4 * w);
    EXPECT_LT(std::abs(response[k](2, 0) - exact), 1e-14);
  }
  EXPECT_THROW(calc_response_amplitudes(database, Eigen::MatrixXd::Identity(3, 3)), ModelError);
}

TEST(ResponseAmplitude, NaturalPeriod) {
  const HydrodynamicDatabase database = single_mode_database();
  const Eigen::MatrixXd mass = 2.0 * Eigen::MatrixXd::Identity(6, 6);
  EXPECT_NEAR(calc_natural_period(database, mass, 2), 2 * std::numbers::pi / std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isnan(calc_natural_period(database, mass, 0)));
}

}  // namespace
}  // namespace blocklift::dynamics
