// Slow drift from mean forces, and the current's drag by coefficients.
#include "dynamics/marine/loads/slow_drift.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/current_load.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;
constexpr double drift_gravity = 10.0;

/// D = (100 w cos h, 60 sin h, 10 sin 2h) for headings every 5 degrees.
std::shared_ptr<HydrodynamicDatabase> drifting() {
  auto database = std::make_shared<HydrodynamicDatabase>();
  database->water = {1000, drift_gravity};
  database->body_names = {"A"};
  database->reference_points = {{4, 5, 0}};
  database->frequencies = {0.5, 1.0, 1.5};
  for (int h = 0; h < 72; ++h) database->headings.push_back(h * pi / 36);
  for (const double w : database->frequencies) {
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(6, 72);
    for (int h = 0; h < 72; ++h) {
      D(surge, h) = 100 * w * std::cos(database->headings[h]);
      D(sway, h) = 60 * std::sin(database->headings[h]);
      D(yaw, h) = 10 * std::sin(2 * database->headings[h]);
    }
    database->mean_drift.push_back(D);
  }
  return database;
}

SlowDrift slow_drift(const std::vector<WaveComponent>& waves) {
  return SlowDrift({"A",
                    {1, Pose::identity()},
                    drifting(),
                    0,
                    std::make_shared<const Sea>(Sea{
                        WaveField(Water{.density = 1000, .gravity = drift_gravity}, waves), {}})});
}

TEST(SlowDrift, OneWaveGivesItsMeanForce) {
  constexpr double amplitude = 1.5, heading = 0.6;
  const SlowDrift drift = slow_drift({{amplitude, 0.8, heading, 0.3}});
  test::OneBody body;
  for (const double yaw_angle : {0.0, 1.1, -2.0}) {
    body.q.head<3>() = Vector3(3, -8, 0);
    body.q.tail<4>() = quaternion_from_rotation(rotation_about(Vector3::UnitZ(), yaw_angle));
    body.v << 0.1, -0.2, 0.3, 1, 2, -1;
    for (const double time : {0.0, 3.3}) {
      body.time = time;
      body.update();
      const double h = heading - yaw_angle, square = amplitude * amplitude;
      const Vector3 force = rotation_about(Vector3::UnitZ(), yaw_angle) *
                            Vector3(80 * std::cos(h), 60 * std::sin(h), 0) * square;
      const ForceVector F = drift.calc_force(body.state());
      EXPECT_LT((F.force - force).norm(), 2e-3 * 100 * square);
      EXPECT_NEAR(F.moment.z(), 10 * std::sin(2 * h) * square, 5e-3 * 10 * square);
      test::expect_balanced(body, drift);
    }
  }
}

// D1 a1^2 + D2 a2^2 + 2 a1 a2 sqrt(D1 D2) cos of the difference, and nothing else.
TEST(SlowDrift, TwoWavesBeatAsNewmanHasIt) {
  const SlowDrift drift = slow_drift({{2.0, 0.5, 0.0, 0.2}, {1.0, 1.0, 0.0, 0.7}});
  test::OneBody body;
  body.q.head<3>() = Vector3(6, 0, 0);
  for (const double time : {0.0, 1.0, 4.5, 11.0}) {
    body.time = time;
    body.update();
    const double difference = 0.5 * time - (0.7 - 0.2) - (1.0 - 0.25) / drift_gravity * 6.0;
    const double expected = 4.0 * 50 + 100 + 2.0 * 2.0 * std::sqrt(50 * 100) * std::cos(difference);
    EXPECT_NEAR(drift.calc_force(body.state()).force.x(), expected, 1e-9 * expected);
  }
  // From ahead it pulls.
  const SlowDrift back = slow_drift({{2.0, 0.5, pi, 0.2}});
  EXPECT_NEAR(back.calc_force(body.state()).force.x(), -200, 1e-9);
}

TEST(SlowDrift, RefusesADatabaseWithout) {
  auto database = drifting();
  database->mean_drift.clear();
  EXPECT_THAT(
      [&] {
        SlowDrift({"A", {1, Pose::identity()}, database, 0, std::make_shared<const Sea>()});
      },
      ThrowsMessage<ModelError>(HasSubstr("no mean drift")));
  EXPECT_THAT(
      [] {
        slow_drift({{1, 2.0, 0, 0}});
      },
      ThrowsMessage<ModelError>(HasSubstr("0.5 to 1.5 rad/s")));
}

// rho/2 V^2 S C at the relative flow's heading, mirrored on the other side.
TEST(CurrentLoad, FollowsItsCoefficients) {
  CurrentLoad::Definition d;
  d.name = "c";
  d.reference = {1, {1, 0, -2}};
  d.coefficients = {500,
                    500,
                    0,
                    100,
                    {{0, 0.1, 0, 0, 0, 0}, {pi / 2, 0, 0.8, 0, 0, 0.05}, {pi, -0.1, 0, 0, 0, 0}}};
  d.sea = std::make_shared<const Sea>(
      Sea{WaveField(Water{.density = 1000}), Current::uniform(1.5, 0.9)});
  const CurrentLoad load(d);
  test::OneBody body;
  body.update();
  const double share = 0.9 / (pi / 2), q = 0.5 * 1000 * 1.5 * 1.5;
  ForceVector F = load.calc_force(body.state());
  EXPECT_NEAR(F.force.x(), q * 500 * 0.1 * (1 - share), 1e-6);
  EXPECT_NEAR(F.force.y(), q * 500 * 0.8 * share, 1e-6);
  EXPECT_NEAR(F.moment.z(), q * 500 * 100 * 0.05 * share, 1e-4);
  test::expect_balanced(body, load);
  // With the water it feels nothing.
  body.v.tail<3>() = 1.5 * Vector3(std::cos(0.9), std::sin(0.9), 0);
  body.update();
  EXPECT_NEAR(load.calc_force(body.state()).force.norm(), 0.0, 1e-9);
  d.sea = nullptr;
  EXPECT_THROW(CurrentLoad{d}, ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics
