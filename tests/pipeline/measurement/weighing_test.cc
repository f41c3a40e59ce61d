#include "pipeline/measurement/weighing.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

constexpr double g = 9.81;
constexpr double mass = 80e3;
const Eigen::Vector3d centre(1.2, -0.7, 2.5);

/// Three upright slings at corners of a load that is turned by an angle about y; their tensions
/// follow from the balance by hand.
WeighingInstant hung(double angle, double error) {
  const std::vector<Eigen::Vector3d> lugs{{0, -3, 4}, {0, 3, 4}, {5, 0, 4}};
  WeighingInstant instant;
  instant.R_WB = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  Eigen::Matrix3d balance;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d lug = instant.R_WB * lugs[k];
    balance.col(k) << 1, lug.y(), -lug.x();
  }
  const Eigen::Vector3d r = instant.R_WB * centre;
  const Eigen::Vector3d tension =
      balance.inverse() * (mass * g * Eigen::Vector3d(1, r.y(), -r.x()));
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d force(0, 0, tension[k] + error);
    instant.force_W.push_back(force);
    instant.moment_W.emplace_back((instant.R_WB * lugs[k]).cross(force));
  }
  return instant;
}

TEST(Weigh, FindsMassAndCentreOfALoadThatTurns) {
  std::vector<WeighingInstant> instants;
  for (int i = 0; i < 40; ++i) instants.push_back(hung(0.01 * i, 0));
  const auto weighing = weigh(instants, g, 0);
  ASSERT_TRUE(weighing);
  EXPECT_NEAR(weighing->mass, mass, 1e-6);
  EXPECT_NEAR((weighing->centre_of_mass_B - centre).norm(), 0, 1e-9);
  EXPECT_FALSE(weighing->open_direction_B);
  EXPECT_NEAR(weighing->force_residual, 0, 1e-6);
}

TEST(Weigh, LeavesTheHeightOpenOfALoadThatKeepsItsAttitude) {
  const auto weighing = weigh(std::vector<WeighingInstant>(40, hung(0.2, 0)), g, 0);
  ASSERT_TRUE(weighing);
  EXPECT_NEAR(weighing->mass, mass, 1e-6);
  ASSERT_TRUE(weighing->open_direction_B);
  const Eigen::Vector3d upwards_B = hung(0.2, 0).R_WB.transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::abs(weighing->open_direction_B->dot(upwards_B)), 1, 1e-12);
  const Eigen::Vector3d apart = weighing->centre_of_mass_B - centre;
  EXPECT_NEAR(apart.cross(upwards_B).norm(), 0, 1e-9);
}

// A load that hangs tilted: at the height of its true centre the line has the true x and y, at that
// of its foot it has not.
TEST(Weigh, HasTheCentreWhereTheLineReachesItsHeight) {
  const auto weighing = weigh(std::vector<WeighingInstant>(40, hung(0.2, 0)), g, 0.01);
  ASSERT_TRUE(weighing);
  EXPECT_EQ(weighing->open_coordinate(), 2);
  EXPECT_GT(std::abs(weighing->centre_of_mass_B.x() - centre.x()), 0.1);
  const Weighing there = weighing->with_open_coordinate(centre.z());
  EXPECT_NEAR((there.centre_of_mass_B - centre).norm(), 0, 1e-8);
  EXPECT_EQ(there.mass, weighing->mass);
  EXPECT_FALSE(there.leaves_open(0) || there.leaves_open(1));
  // The line is seen obliquely there: across it, in x and z, over the cosine of the tilt.
  const double across = std::hypot(weighing->centre_deviation.x(), weighing->centre_deviation.z());
  EXPECT_NEAR(there.centre_deviation.x(), across / std::cos(0.2), 1e-9);
  EXPECT_NEAR(there.centre_deviation.y(), weighing->centre_deviation.y(), 1e-12);
  EXPECT_NEAR(there.centre_deviation.z(), 0, 1e-9);
}

TEST(Weigh, HasNothingToMoveWhereNothingIsOpen) {
  std::vector<WeighingInstant> instants;
  for (int i = 0; i < 40; ++i) instants.push_back(hung(0.01 * i, 0));
  const auto weighing = weigh(instants, g, 0);
  ASSERT_TRUE(weighing);
  EXPECT_FALSE(weighing->open_coordinate());
  EXPECT_EQ(weighing->with_open_coordinate(0).centre_of_mass_B, weighing->centre_of_mass_B);
}

TEST(Weigh, TakesTheErrorsOfCellsIntoItsUncertainty) {
  // Level and symmetric: the mass errs as the root of the squares of 1 % of each tension.
  const WeighingInstant instant = hung(0, 0);
  double squares = 0;
  for (const Eigen::Vector3d& force : instant.force_W) squares += force.squaredNorm();
  const auto weighing = weigh(std::vector<WeighingInstant>(40, instant), g, 0.01);
  ASSERT_TRUE(weighing);
  EXPECT_NEAR(weighing->mass_deviation, 0.01 * std::sqrt(squares) / g, 1e-6);
}

TEST(Weigh, TakesScatterIntoItsUncertainty) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 3000);
  std::vector<WeighingInstant> instants;
  for (int i = 0; i < 400; ++i) instants.push_back(hung(0.001 * i, noise(random)));
  const auto weighing = weigh(instants, g, 0);
  ASSERT_TRUE(weighing);
  // The mean of 400 sums of three equal errors.
  EXPECT_NEAR(weighing->mass_deviation, 3 * 3000 / g / 20, 25);
  EXPECT_LT(std::abs(weighing->mass - mass), 4 * weighing->mass_deviation);
}

TEST(Weigh, RefusesTooFewInstants) {
  EXPECT_FALSE(weigh(std::vector<WeighingInstant>(19, hung(0, 0)), g, 0));
}

}  // namespace
}  // namespace blocklift::pipeline
