#include <gtest/gtest.h>

#include "pipeline/terminal/progress_bar.h"

namespace blocklift::pipeline {
namespace {

TEST(ProgressText, SaysWhatHasPassedAndWhatIsLeft) {
  EXPECT_EQ(progress_text("solving", 0.4, 61, 20, "12 of 30"),
            "solving 40 %, 61 s, about 30 s left, 12 of 30");
  EXPECT_EQ(progress_text("solving", 0.5, 1000, 600, ""),
            "solving 50 %, 17 min, about 10 min left");
}

TEST(ProgressText, GuessesNothingTooEarlyOrAtTheEnd) {
  EXPECT_EQ(progress_text("mesh", 0.01, 30, 30, ""), "mesh 1 %, 30 s");
  EXPECT_EQ(progress_text("mesh", 0.5, 3, 1, ""), "mesh 50 %, 3 s");
  EXPECT_EQ(progress_text("mesh", 1.0, 30, 30, ""), "mesh 100 %, 30 s");
  EXPECT_EQ(progress_text("mesh", 1.5, 30, 30, ""), "mesh 100 %, 30 s");
}

}  // namespace
}  // namespace blocklift::pipeline
