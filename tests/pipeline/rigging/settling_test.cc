// Choosing and running in turn, where what a choice asks for is written down.

#include "pipeline/rigging/settling.h"

#include <map>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

Settled settle_by(const Choice& first, const std::map<Choice, Choice>& asked, int most_runs = 10) {
  return settle([&] { return first; }, [&](const Choice& choice) { return asked.at(choice); },
                most_runs);
}

TEST(SettlingTest, EndsWhereARunAsksForItsOwnChoice) {
  const Settled settled = settle_by({3, 0}, {{{3, 0}, {2, 1}}, {{2, 1}, {2, 1}}});
  EXPECT_TRUE(settled.stands);
  EXPECT_FALSE(settled.went_round);
  EXPECT_EQ(settled.choice, (Choice{2, 1}));
  EXPECT_EQ(settled.runs, 3);
}

// The first is strong where the second is weak, and each asks for the other: both end strong.
TEST(SettlingTest, KeepsTheStrongerWhereChoicesAskForEachOther) {
  const Settled settled = settle_by({3, 0}, {{{3, 0}, {0, 3}}, {{0, 3}, {3, 0}}, {{3, 3}, {2, 2}}});
  EXPECT_TRUE(settled.stands);
  EXPECT_TRUE(settled.went_round);
  EXPECT_EQ(settled.choice, (Choice{3, 3}));
}

TEST(SettlingTest, SaysSoWhereNoChoiceStands) {
  int strongest = 0;
  const Settled settled = settle([] { return Choice{0}; },
                                 [&](const Choice& choice) {
                                   ++strongest;
                                   return Choice{choice[0] + 1};
                                 },
                                 5);
  EXPECT_FALSE(settled.stands);
  EXPECT_EQ(settled.runs, 5);
  EXPECT_EQ(strongest, 4);
}

}  // namespace
}  // namespace blocklift::pipeline
