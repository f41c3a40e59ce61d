// What the excitation has in the mean on a body that moves with the waves.
#include "dynamics/marine/loads/excitation_drift.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/diffraction_force.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using Amplitude = std::complex<double>;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int drift_headings = 24;
constexpr double drift_frequency = 0.8, gravity_of_drift = 10.0;  // rad/s, m/s2

/// A made-up body whose forces differ with the heading, a part of them the incident wave's.
HydrodynamicDatabase excited_body() {
  HydrodynamicDatabase database;
  database.water = {1000, gravity_of_drift};
  database.body_names = {"body"};
  database.reference_points = {{7, -4, 0}};
  database.frequencies = {drift_frequency};
  Eigen::MatrixXcd X(6, drift_headings);
  for (int j = 0; j < drift_headings; ++j) {
    const double theta = 2 * std::numbers::pi * j / drift_headings;
    database.headings.push_back(theta);
    for (int m = 0; m < 6; ++m) {
      X(m, j) = Amplitude(2.0 + std::cos(theta - m), std::sin(2 * theta + m));
    }
  }
  database.diffraction = {0.4 * X};
  database.froude_krylov = {0.6 * X};
  return database;
}

std::vector<Eigen::MatrixXcd> motions_of_body() {
  Eigen::MatrixXcd xi(6, drift_headings);
  for (int j = 0; j < drift_headings; ++j) {
    for (int m = 0; m < 6; ++m) xi(m, j) = std::polar(0.5 + 0.1 * m, 1.0 * m + 0.3 * j);
  }
  return {xi};
}

/// The mean over a period of what DiffractionForce exerts along the water, per square amplitude.
Eigen::Vector2d mean_of_element(const HydrodynamicDatabase& database, int heading) {
  constexpr double amplitude = 1e-5;
  constexpr int instants = 32;
  const double theta = database.headings[static_cast<std::size_t>(heading)];
  const double k = drift_frequency * drift_frequency / gravity_of_drift;
  DiffractionForce::Definition d;
  d.name = "body";
  d.frame = {1, Pose::identity()};
  d.database = std::make_shared<const HydrodynamicDatabase>(database);
  d.froude_krylov = FroudeKrylovPart::along_water;
  d.sea = std::make_shared<const Sea>(
      Sea{WaveField(database.water, {{amplitude, drift_frequency, theta, 0.0}}), {}});
  const DiffractionForce force(d);
  const Vector3& p = database.reference_points[0];
  // R lies in the world's origin, where the wave's phase is zero.
  const Eigen::VectorXcd xi =
      std::polar(amplitude, k * (std::cos(theta) * p.x() + std::sin(theta) * p.y())) *
      motions_of_body()[0].col(heading);
  test::OneBody body;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int i = 0; i < instants; ++i) {
    const double phase = 2 * std::numbers::pi * i / instants;
    const Eigen::VectorXd now = (xi * std::polar(1.0, phase)).real();
    body.time = phase / drift_frequency;
    body.q.head<3>() = now.head<3>();
    body.q.tail<4>() = quaternion_from_rotation(rotation_about(Vector3::UnitZ(), now[yaw]));
    body.update();
    mean += force.calc_force(body.state()).force.head<2>() / instants;
  }
  return mean / (amplitude * amplitude);
}

// Second method: the element itself, moved.
TEST(ExcitationDrift, IsTheMeanOfTheElement) {
  const HydrodynamicDatabase database = excited_body();
  const Eigen::MatrixXd drift = calc_excitation_drift(database, motions_of_body()).at(0);
  EXPECT_EQ(drift.bottomRows<4>().norm(), 0.0);
  for (const int heading : {0, 5, drift_headings - 1}) {
    const Eigen::Vector2d mean = mean_of_element(database, heading);
    EXPECT_GT(mean.norm(), 0.1);
    // What is left is of the third order, as slopes differ on either side of a heading: 4e-6.
    EXPECT_LT((drift.col(heading).head<2>() - mean).norm(), 1e-4 * mean.norm()) << heading;
  }
}

// A round body that yaws meets the waves from the same side: nothing comes of its yaw.
TEST(ExcitationDrift, OfARoundBodyIsThatOfItsPower) {
  HydrodynamicDatabase database = excited_body();
  for (int j = 0; j < drift_headings; ++j) {
    const double theta = database.headings[static_cast<std::size_t>(j)];
    const Amplitude along = Amplitude(3.0, 1.0);
    database.diffraction[0].col(j).head<2>() << along * std::cos(theta), along * std::sin(theta);
  }
  database.froude_krylov[0].setZero();
  database.reference_points = {Vector3::Zero()};
  const auto motions = motions_of_body();
  const Eigen::MatrixXd drift = calc_excitation_drift(database, motions).at(0);
  const double k = drift_frequency * drift_frequency / gravity_of_drift;
  for (int j = 0; j < drift_headings; ++j) {
    const double theta = database.headings[static_cast<std::size_t>(j)];
    const Amplitude way =
        std::cos(theta) * motions[0](surge, j) + std::sin(theta) * motions[0](sway, j);
    const double exact = 0.5 * k * (Amplitude(3.0, 1.0) * std::conj(way)).imag();
    const double along = std::cos(theta) * drift(surge, j) + std::sin(theta) * drift(sway, j);
    EXPECT_NEAR(along, exact, 1e-12);
    // Square to the way X is linear between headings 15 degrees apart, sin(h)/h of the slope.
    const double across = std::cos(theta) * drift(sway, j) - std::sin(theta) * drift(surge, j);
    EXPECT_NEAR(across, 0.0, 0.012 * 0.5 * std::sqrt(10.0));
  }
}

TEST(ExcitationDrift, RefusesOtherMotions) {
  HydrodynamicDatabase database = excited_body();
  EXPECT_THAT([&] { calc_excitation_drift(database, {}); },
              ThrowsMessage<ModelError>(HasSubstr("not those of the database")));
  database.body_names.push_back("other");
  EXPECT_THAT([&] { calc_excitation_drift(database, motions_of_body()); },
              ThrowsMessage<ModelError>(HasSubstr("not those of the database")));
}

// Each of several bodies has what it would have alone at its place.
TEST(ExcitationDrift, OfSeveralBodiesIsThatOfEach) {
  const HydrodynamicDatabase one = excited_body();
  const auto motions = motions_of_body();
  HydrodynamicDatabase other = one;
  other.reference_points = {{-30, 12, 0}};
  other.diffraction[0] *= 3.0;
  HydrodynamicDatabase both = one;
  both.body_names.emplace_back("other");
  both.reference_points.push_back(other.reference_points[0]);
  const auto above = [](const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
    Eigen::MatrixXcd joined(a.rows() + b.rows(), a.cols());
    joined << a, b;
    return joined;
  };
  both.diffraction[0] = above(one.diffraction[0], other.diffraction[0]);
  both.froude_krylov[0] = above(one.froude_krylov[0], other.froude_krylov[0]);
  const Eigen::MatrixXd drift =
      calc_excitation_drift(both, {above(motions[0], 2.0 * motions[0])}).at(0);
  const Eigen::MatrixXd of_one = calc_excitation_drift(one, motions).at(0);
  const Eigen::MatrixXd of_other = calc_excitation_drift(other, {2.0 * motions[0]}).at(0);
  EXPECT_GT(of_other.norm(), 1.0);
  EXPECT_LT((drift.topRows<6>() - of_one).norm(), 1e-12 * of_one.norm());
  EXPECT_LT((drift.bottomRows<6>() - of_other).norm(), 1e-12 * of_other.norm());
}

}  // namespace
}  // namespace blocklift::dynamics
