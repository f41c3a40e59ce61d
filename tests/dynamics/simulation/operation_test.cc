#include "dynamics/simulation/operation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const MotionLimits limits{1.0, 1.0, 1.0};

OperationBuilder two_winches() {
  OperationBuilder builder;
  builder.add_winch("front", 0, 20.0);
  builder.add_winch("rear", 1, 20.0);
  return builder;
}

TEST(Operation, StagesMovesAndFollowers) {
  OperationBuilder builder = two_winches();
  builder.add_stage("lower", 1.0, 10.0);
  const RestToRestMove move(1.0, 4.0, limits);
  builder.add_move("front", move);
  // The curve need not begin at zero: travel counts from the leader's start.
  builder.add_follower("rear", "front", 1.0, 10.0, NaturalSpline({0, 2, 4}, {1, 3, 5}));
  const Operation operation = builder.build(30.0);
  EXPECT_EQ(operation.breakpoints().front(), 0.0);
  EXPECT_EQ(operation.breakpoints().back(), 30.0);
  EXPECT_TRUE(std::is_sorted(operation.breakpoints().begin(), operation.breakpoints().end()));
  const auto length = [&](std::size_t winch, double t) {
    return operation.winches()[winch].length.evaluate(t).position;
  };
  EXPECT_NEAR(length(0, 0.5), 20.0, 1e-12);
  EXPECT_NEAR(length(1, 0.5), 20.0, 1e-12);
  EXPECT_NEAR(length(0, 30.0), 24.0, 1e-12);
  EXPECT_NEAR(length(1, 30.0), 24.0, 1e-12);
  EXPECT_NEAR(length(1, 3.0), length(0, 3.0), 1e-12);
}

// A winch that runs away pays out its speed times the time until it is caught, whatever it did
// before, and stands there.
TEST(Operation, AWinchRunsAway) {
  OperationBuilder builder = two_winches();
  builder.add_move("front", RestToRestMove(1.0, -4.0, limits));
  builder.add_runaway("front", 2.0, 3.0, 0.5, 0.4);
  const MotionProfile length = builder.build(30.0).winches()[0].length;
  EXPECT_NEAR(length.evaluate(4.0).velocity, 0.5, 1e-12);
  EXPECT_EQ(length.evaluate(20.0).velocity, 0.0);
  const MotionProfile own = MotionProfile::stopped(
      MotionProfile::sequence(20.0, {RestToRestMove(1.0, -4.0, limits)}), 2.0, 0.4);
  EXPECT_NEAR(length.evaluate(20.0).position, own.evaluate(20.0).position + 3.0 * 0.5, 1e-12);
  EXPECT_THAT([&] { builder.add_runaway("front", 5.0, 1.0, 1.0, 1.0); },
              ThrowsMessage<ModelError>(HasSubstr("stopped twice")));
}

// Leader and follower that are stopped by one clock keep to their table, stand where they are, and
// go on from there.
TEST(Operation, MovesAreStoppedTogether) {
  OperationBuilder builder = two_winches();
  builder.add_stage("lower", 1.0, 3.5);
  builder.add_move("front", RestToRestMove(1.0, 8.0, limits));
  builder.add_follower("rear", "front", 1.0, 20.0, NaturalSpline({0, 8}, {0, 2}));
  builder.stop_moves(1.0, 3.0, 0.5);
  builder.add_stage("hoist", 3.5, 10.0);
  builder.add_move("front", RestToRestMove(3.5, -1.0, limits));
  const Operation operation = builder.build(30.0);
  const MotionProfile& front = operation.winches()[0].length;
  const MotionProfile& rear = operation.winches()[1].length;
  for (const double t : {2.0, 3.2, 3.5})
    EXPECT_NEAR(rear.evaluate(t).position - 20, (front.evaluate(t).position - 20) / 4, 1e-12) << t;
  EXPECT_NEAR(front.evaluate(3.5).velocity, 0.0, 1e-12);
  // Half of the clock's last half second runs.
  EXPECT_NEAR(front.evaluate(3.5).position,
              20 + RestToRestMove(1.0, 8.0, limits).evaluate(3.25).position, 1e-12);
  EXPECT_NEAR(front.evaluate(30.0).position, front.evaluate(3.5).position - 1.0, 1e-12);
  EXPECT_NEAR(rear.evaluate(30.0).position, rear.evaluate(3.5).position, 1e-12);
}

TEST(Operation, RefusesOverlappingMoves) {
  OperationBuilder builder = two_winches();
  const RestToRestMove move(1.0, 4.0, limits);
  builder.add_move("front", move);
  EXPECT_THAT(
      [&] {
        builder.add_move("front", {move.end() - 0.5, 1.0, limits});
      },
      ThrowsMessage<ModelError>(HasSubstr("\"front\" is moved")));
  EXPECT_NO_THROW(builder.add_move("front", RestToRestMove(move.end(), 1.0, limits)));
  builder.add_follower("rear", "front", 0.0, move.end(), NaturalSpline({0, 4}, {0, 1}));
  EXPECT_THAT(
      [&] {
        builder.add_move("rear", {3.0, 1.0, limits});
      },
      ThrowsMessage<ModelError>(HasSubstr("\"rear\" is moved")));
}

TEST(Operation, RefusesWhatCannotBe) {
  OperationBuilder builder = two_winches();
  EXPECT_THAT([&] { builder.add_winch("front", 0, 5.0); },
              ThrowsMessage<ModelError>(HasSubstr("\"front\"")));
  EXPECT_THAT(
      [&] {
        builder.add_move("middle", {0.0, 1.0, limits});
      },
      ThrowsMessage<ModelError>(HasSubstr("the drives are front, rear")));
  EXPECT_THAT(
      [&] {
        builder.add_follower("rear", "front", 0, 9, NaturalSpline({0, 1}, {0, 1}));
      },
      ThrowsMessage<ModelError>(HasSubstr("does not move between")));
  builder.add_stage("first", 0.0, 10.0);
  EXPECT_THAT([&] { builder.add_stage("second", 9.0, 12.0); },
              ThrowsMessage<ModelError>(HasSubstr("before the one before it ends")));
  EXPECT_THAT([&] { builder.build(5.0); }, ThrowsMessage<ModelError>(HasSubstr("lasts")));
  builder.add_move("front", {0.0, -25.0, limits});
  EXPECT_THAT([&] { builder.build(100.0); },
              ThrowsMessage<ModelError>(HasSubstr("winch \"front\" would pull its rope in")));
}

TEST(Operation, DrivesOnlyWhatIsDeclaredAsDriven) {
  MechanismBuilder mechanism_builder;
  mechanism_builder.add_body(
      {.name = "trolley", .joint = {.kind = JointKind::prismatic}, .mass = 1.0});
  const Mechanism mechanism = mechanism_builder.build();
  OperationBuilder builder;
  EXPECT_THAT([&] { builder.add_joint_drive(mechanism, "traverse", 1, 0.0); },
              ThrowsMessage<ModelError>(HasSubstr("declare it as driven")));
}

}  // namespace
}  // namespace blocklift::dynamics
