// Rows, failures and patterns of the verification suite's frame.
#include "pipeline/verification/verification.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

VerificationCase of_rows(std::vector<VerificationRow> rows) {
  return {.name = "heavy-top", .stage = "dynamics", .source = "a book", .compute = [rows] {
            return rows;
          }};
}

TEST(VerificationRow, ErrorIsTheDistanceToTheReference) {
  EXPECT_TRUE(compare("x", "m", 2.0, 2.25, 0.25).pass());
  EXPECT_FALSE(compare("x", "m", 2.0, 2.26, 0.25).pass());
  EXPECT_EQ(compare("x", "m", -2.0, -2.25, 0.1).error, 0.25);
  EXPECT_TRUE(bound("r", "m", -1e-12, 1e-12).pass());
}

TEST(VerificationRow, WhatIsNoNumberFails) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(compare("x", "m", 2.0, nan, 1e9).pass());
  EXPECT_FALSE(compare("x", "m", nan, 2.0, 1e9).pass());
  EXPECT_FALSE(compare("x", "m", 2.0, 2.0, nan).pass());
}

TEST(VerificationCase, RowsHaveTheirOwnSourceOrTheCases) {
  const auto rows = run(of_rows({compare("x", "m", 1, 1, 0), compare("y", "m", 1, 1, 0, "ours")}));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].source, "a book");
  EXPECT_EQ(rows[1].source, "ours");
}

TEST(VerificationCase, WhatIsThrownIsARowThatFails) {
  const auto rows = run({.name = "x", .stage = "dynamics", .source = "a book", .compute = []() {
                           throw std::runtime_error("the rope broke");
                           return std::vector<VerificationRow>();
                         }});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].pass());
  EXPECT_EQ(rows[0].quantity, "runs to its end");
  EXPECT_EQ(rows[0].note, "the rope broke");
}

TEST(VerificationCase, ComputingNothingIsAFailure) {
  const auto rows = run(of_rows({}));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].pass());
}

TEST(VerificationCase, PatternsAreGlobsOrParts) {
  const VerificationCase top = of_rows({});
  for (const char* pattern : {"heavy-top", "top", "dynamics", "dynamics/heavy", "heavy-*", "*",
                              "dynamics/*", "h?avy-top", "[gh]eavy*"})
    EXPECT_TRUE(matches(top, pattern)) << pattern;
  for (const char* pattern : {"structure", "heavy*bottom", "top*", "Heavy", "structure/*"})
    EXPECT_FALSE(matches(top, pattern)) << pattern;
}

}  // namespace
}  // namespace blocklift::pipeline
