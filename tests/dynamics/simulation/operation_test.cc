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
