#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/results/doubts/doubts.h"
#include "tests/pipeline/small_lift.h"

// What is doubted of slings, hooks and wind without a run: 8 t (78.5 kN) on four slings of 30 t
// and two hooks of 8 t of a crane of 12 t.

namespace blocklift::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class DoubtsOfBearing : public ::testing::Test {
 protected:
  void set_mass(double mass) {
    auto block = std::make_shared<BlockModel>(*lift_case_.load.model);
    block->mass = Located<double>{mass, {}};
    lift_case_.load.model = std::move(block);
  }
  std::vector<std::string> doubts() const { return list_doubts(lift_case_); }

  LiftCase lift_case_ = test::read_small_lift();
};

TEST_F(DoubtsOfBearing, AreNoneOfASoundLift) { EXPECT_THAT(doubts(), IsEmpty()); }

// 0.356 x 16 mm2 x 1770 MPa is 10.1 kN: four slings of 4 mm have half of the weight.
TEST_F(DoubtsOfBearing, SlingsOfAnotherLift) {
  for (given::Rope& rope : lift_case_.ropes) rope.rope.breaking_load = 10.1e3;
  EXPECT_THAT(doubts(), ElementsAre("The load weighs 78 kN, and its slings break under 40.4 kN "
                                    "together; usually they do under 5 times its weight."));
  // Twice the weight is doubted, more is not.
  for (given::Rope& rope : lift_case_.ropes) rope.rope.breaking_load = 39.2e3;
  EXPECT_EQ(doubts().size(), 1U);
  for (given::Rope& rope : lift_case_.ropes) rope.rope.breaking_load = 39.3e3;
  EXPECT_THAT(doubts(), IsEmpty());
}

// The crane's 12 t are less than its two hooks have.
TEST_F(DoubtsOfBearing, LoadBeyondItsHooks) {
  set_mass(12e3);
  EXPECT_THAT(doubts(), IsEmpty());
  set_mass(13e3);
  EXPECT_THAT(doubts(), ElementsAre("The load weighs 128 kN, and the hooks that hold it may carry "
                                    "117.7 kN together."));
  // What stands bears a part of itself.
  lift_case_.ground_contact.emplace();
  EXPECT_THAT(doubts(), IsEmpty());
}

// A line that was copied and not changed: the load would hang on three lugs.
TEST_F(DoubtsOfBearing, TwoSlingsOnOneLugWhileAnotherHasNone) {
  const auto four = lift_case_.ropes;
  lift_case_.ropes[1].path.back() = four[0].path.back();
  const std::string lug = four[0].lug(), bare = four[1].lug();
  EXPECT_THAT(doubts(),
              ElementsAre(StartsWith("Ropes " + four[0].name.value + ", " + four[1].name.value +
                                     " all hold lug " + lug + ", and none holds " + bare + ".")));
  // With a sling of its own at the other lug two on one are no matter, nor is a lug that is bare.
  lift_case_.ropes.push_back(four[1]);
  EXPECT_THAT(doubts(), IsEmpty());
  lift_case_.ropes = {four[0], four[2], four[3]};
  EXPECT_THAT(doubts(), IsEmpty());
}

TEST_F(DoubtsOfBearing, WindInWhichNoCraneWorks) {
  lift_case_.wind->speed = 28;
  EXPECT_THAT(doubts(), IsEmpty());
  lift_case_.wind->speed = 100;
  EXPECT_THAT(doubts(), ElementsAre(StartsWith("The wind blows with 100 m/s; cranes work in up")));
}

}  // namespace
}  // namespace blocklift::pipeline
