// How far vessels that share their water come from the places against each other that it was
// computed for.
#include "dynamics/simulation/misplacement.h"

#include <numbers>

#include <gtest/gtest.h>

namespace blocklift::dynamics {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Two barges and a ship, free in a world without weight, and a history of three samples 10 s
/// apart.
class MisplacementTest : public ::testing::Test {
 protected:
  MisplacementTest() {
    arrangement_.bodies = {{"B1", {1, Pose::identity()}, {0, -30}, 60, 20},
                           {"B2", {2, Pose::identity()}, {0, 30}, 60, 20},
                           {"ship", {3, turned(-90, {0, 0, 2})}, {80, 0}, 90, 12}};
    arrangement_.lowered_body = 2;
    arrangement_.mark = {3, Vector3::Zero()};
    for (int sample = 0; sample < 3; ++sample) {
      history_.time[sample] = 10 * sample;
      put(sample, 1, 0, {0, -30, 0});
      put(sample, 2, 0, {0, 30, 0});
      put(sample, 3, 90, {80, 0, -2});
    }
  }

  static Pose turned(double degrees, const Vector3& p) {
    return {rotation_about(Vector3::UnitZ(), degrees * degree), p};
  }

  static LiftSystem system() {
    MechanismBuilder builder;
    for (const char* name : {"B1", "B2", "ship"}) {
      builder.add_body({.name = name,
                        .joint = {.kind = JointKind::free},
                        .mass = 1,
                        .I_BBcm_B = Matrix3::Identity()});
    }
    const Mechanism mechanism = builder.build();
    return LiftSystem({.mechanism = mechanism,
                       .operation = OperationBuilder().build(1.0),
                       .q_start = mechanism.zero_configuration(),
                       .v_start = Eigen::VectorXd::Zero(mechanism.nv())});
  }

  void put(Eigen::Index sample, int body, double heading, const Vector3& p) {
    auto row = history_.bodies[body - 1].pose.row(sample);
    row.head<3>() = p.transpose();
    row.tail<4>() = quaternion_from_rotation(turned(heading, p).R).transpose();
  }

  /// The whole arrangement turned about the origin and shifted.
  void turn_all(Eigen::Index sample, double degrees, const Vector3& shift) {
    const Pose X = turned(degrees, shift);
    put(sample, 1, degrees, X.apply({0, -30, 0}));
    put(sample, 2, degrees, X.apply({0, 30, 0}));
    put(sample, 3, degrees + 90, X.apply({80, 0, -2}));
  }

  Misplacement find() const { return find_misplacement(arrangement_, history_); }

  Arrangement arrangement_;
  History history_{system(), 3, false};
};

TEST_F(MisplacementTest, IsNoneWhereAllMoveAndTurnTogether) {
  turn_all(1, 70, {200, -50, 0});
  turn_all(2, 190, {-20, 500, 0});
  const Misplacement misplacement = find();
  ASSERT_EQ(misplacement.pairs.size(), 3u);
  for (const PairMisplacement& pair : misplacement.pairs) {
    EXPECT_EQ(pair.samples, 3);
    EXPECT_LT(pair.at_ends.value, 1e-11);
    EXPECT_FALSE(pair.is_beyond());
  }
  EXPECT_NEAR(misplacement.group_turn.value, 170 * degree, 1e-12);  // the short way round
  EXPECT_EQ(misplacement.group_turn.time, 20);
}

TEST_F(MisplacementTest, IsTheChangeOfPlaceAndHeadingBetweenTwo) {
  put(1, 2, 0, {0.6, 29.2, 0});
  put(2, 1, -4, {0, -30, 0});
  const Misplacement misplacement = find();
  const PairMisplacement& pair = misplacement.pairs[0];
  EXPECT_NEAR(pair.turn.value, 4 * degree, 1e-12);
  EXPECT_EQ(pair.turn.time, 20);
  // Their line of 60 m is seen from axes that turn by half of it.
  EXPECT_NEAR(pair.distance.value, 2 * 60 * std::sin(1 * degree), 1e-12);
  EXPECT_NEAR(pair.at_ends.value, pair.distance.value + 30 * 4 * degree, 1e-12);
  EXPECT_DOUBLE_EQ(pair.limit, 4.0);
  EXPECT_EQ(pair.samples_beyond, 1);
  EXPECT_TRUE(pair.is_beyond());
  EXPECT_NEAR(misplacement.pairs[2].distance.value, 1.0, 1e-12);  // B2 and the ship, at 10 s
  EXPECT_EQ(misplacement.pairs[2].distance.time, 10);
  EXPECT_DOUBLE_EQ(misplacement.pairs[2].limit, 2.4);
  EXPECT_FALSE(misplacement.pairs[2].is_beyond());
}

TEST_F(MisplacementTest, OfABodyThatIsLoweredCountsInTheWaterAlone) {
  put(0, 3, 0, {-60, 100, 0.1});
  put(1, 3, 90, {80, 0.3, -0.1});
  Misplacement misplacement = find();
  EXPECT_EQ(misplacement.pairs[0].samples, 3);
  EXPECT_EQ(misplacement.pairs[1].samples, 2);
  EXPECT_NEAR(misplacement.pairs[1].distance.value, 0.3, 1e-12);
  EXPECT_FALSE(misplacement.pairs[1].is_beyond());
  for (int sample = 0; sample < 3; ++sample) put(sample, 3, 10, {0, 100, 4});
  misplacement = find();
  EXPECT_EQ(misplacement.pairs[1].samples, 0);
  EXPECT_FALSE(misplacement.pairs[1].is_beyond());
}

TEST_F(MisplacementTest, IsHeldAgainstShortWavesToo) {
  arrangement_.wave_length = 16;
  EXPECT_DOUBLE_EQ(find().pairs[0].limit, 0.4);
}

}  // namespace
}  // namespace blocklift::dynamics
