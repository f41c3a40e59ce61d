#include "pipeline/results/doubts/blow_doubts.h"

#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/small_lift.h"

// Whether a largest load follows a blow is told by events and tensions alone: those of the small
// lift are replaced by hand.

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DoubtsOfBlows : public ::testing::Test {
 protected:
  DoubtsOfBlows() {
    lift_.dynamic_result.events.clear();
    for (dynamics::History* history : {&lift_.static_history, &lift_.dynamic_result.history})
      for (dynamics::RopeHistory& of : history->ropes) of.tension.setConstant(10e3);
    peak_ = lift_.dynamic_history().sample_count() - 2;
    lift_.dynamic_result.history.ropes[static_cast<std::size_t>(rope_)].tension[peak_] = 25e3;
    when_ = lift_.dynamic_history().time[peak_];
  }

  void set_events(double slack_from, double taut_again, int contact) {
    lift_.dynamic_result.events = {{slack_from, contact, false}, {taut_again, contact, true}};
  }
  std::vector<std::string> doubts() const { return list_blow_doubts(lift_); }

  LiftRun lift_ = test::small_lift().run;
  const int rope_ = lift_.model.ropes.front().rope;
  const int other_ = lift_.model.ropes.back().rope;
  Eigen::Index peak_ = 0;
  double when_ = 0;
};

TEST_F(DoubtsOfBlows, NameThePeakAndTheRopeThatWasSlack) {
  EXPECT_THAT(doubts(), IsEmpty());
  set_events(when_ - 2, when_ - 1.5, other_);
  ASSERT_EQ(doubts().size(), 1U);
  EXPECT_THAT(doubts()[0],
              HasSubstr("The largest load of " + lift_.model.ropes.front().name + ", 25 kN at "));
  EXPECT_THAT(doubts()[0], HasSubstr(lift_.model.ropes.back().name + " was slack from "));
  const std::optional<Blow> blow = find_blow_before_peak(lift_, rope_);
  ASSERT_TRUE(blow);
  EXPECT_EQ(blow->rope, other_);
  EXPECT_DOUBLE_EQ(blow->taut_again, when_ - 1.5);
  // The others' largest load is that at rest.
  EXPECT_FALSE(find_blow_before_peak(lift_, other_));
}

// Two blows: the later one before the peak is named, none behind it.
TEST_F(DoubtsOfBlows, TakeTheLastBlowBeforeThePeak) {
  lift_.dynamic_result.events = {{when_ - 6, other_, false},  {when_ - 5, other_, true},
                                 {when_ - 3, rope_, false},   {when_ - 2, rope_, true},
                                 {when_ + 0.1, rope_, false}, {when_ + 0.2, rope_, true}};
  EXPECT_EQ(find_blow_before_peak(lift_, rope_)->rope, rope_);
  EXPECT_DOUBLE_EQ(find_blow_before_peak(lift_, rope_)->slack_from, when_ - 3);
}

TEST_F(DoubtsOfBlows, AreNoneOfOtherEvents) {
  const double reach = reach_of_blow;
  // Too long before, slack for too long, behind the peak.
  set_events(when_ - reach - 2, when_ - reach - 0.1, rope_);
  EXPECT_THAT(doubts(), IsEmpty());
  set_events(when_ - 1 - 1.01 * reach, when_ - 1, rope_);
  EXPECT_THAT(doubts(), IsEmpty());
  set_events(when_ + 0.01, when_ + 0.02, rope_);
  EXPECT_THAT(doubts(), IsEmpty());
  // A rope that was slack from the start and is taken up; a pad.
  lift_.dynamic_result.events = {{when_ - 1, rope_, true}};
  EXPECT_THAT(doubts(), IsEmpty());
  set_events(when_ - 2, when_ - 1, static_cast<int>(lift_.model.system.ropes().size()));
  EXPECT_THAT(doubts(), IsEmpty());
  // A mooring's snatch is its own.
  set_events(when_ - 2, when_ - 1, other_);
  EXPECT_TRUE(find_blow_before_peak(lift_, rope_));
  LiftRope& mooring = lift_.model.ropes.back();
  mooring.lug.clear();
  mooring.hoist.clear();
  EXPECT_FALSE(find_blow_before_peak(lift_, rope_));
  // A load that is as large at rest.
  set_events(when_ - 2, when_ - 1, rope_);
  EXPECT_EQ(doubts().size(), 1U);
  lift_.static_history.ropes[static_cast<std::size_t>(rope_)].tension[0] = 24e3;
  EXPECT_THAT(doubts(), IsEmpty());
}

}  // namespace
}  // namespace blocklift::pipeline
