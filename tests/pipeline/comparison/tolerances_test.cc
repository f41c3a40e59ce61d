#include "pipeline/comparison/tolerances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

std::string refusal_of_tolerances(const std::string& given) {
  try {
    read_tolerances(given);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(Tolerances, MeanFiguresByWholeKeys) {
  const char* stress = "structure.simultaneous.stress_increase_percent";
  for (const char* name :
       {"stress_increase", "stress_increase_percent", "structure", "structure.simultaneous",
        "simultaneous.stress_increase", "structure.*.stress_increase", "*"})
    EXPECT_TRUE(matches_figure(name, stress)) << name;
  for (const char* name : {"increase", "struct", "simultaneous", "stress", "increase_percent", "?"})
    EXPECT_FALSE(matches_figure(name, stress)) << name;
  EXPECT_TRUE(matches_figure("ropes.R1", "ropes.R1.max_static_tension_N"));
  EXPECT_FALSE(matches_figure("ropes.R1", "ropes.R10.max_static_tension_N"));
}

TEST(Tolerances, AreSharesOrDifferences) {
  const auto tolerances = read_tolerances("stress_increase=2%, ropes.R1=5 kN,period=0.1 s");
  ASSERT_EQ(tolerances.size(), 3u);
  EXPECT_EQ(tolerances[0].name, "stress_increase");
  EXPECT_TRUE(tolerances[0].is_share);
  EXPECT_DOUBLE_EQ(tolerances[0].limit.value, 0.02);
  EXPECT_EQ(tolerances[1].name, "ropes.R1");
  EXPECT_FALSE(tolerances[1].is_share);
  EXPECT_DOUBLE_EQ(tolerances[1].limit.value, 5000);
  EXPECT_EQ(tolerances[2].text, "0.1 s");
}

TEST(Tolerances, AreReadFromAFileWithTheirLines) {
  const test::TemporaryFolder folder;
  folder.write("gate.yaml", "stress_increase: 2%\nropes.*.max_dynamic_tension: 5 kN\n");
  const auto tolerances = read_tolerances("gate.yaml");
  ASSERT_EQ(tolerances.size(), 2u);
  EXPECT_EQ(tolerances[1].mark.line, 2);
  folder.write("bad.yaml", "ropes: 2%\nchecks: much\nverdict: -1%\n");
  const std::string refusal = refusal_of_tolerances("bad.yaml");
  EXPECT_THAT(refusal, HasSubstr("bad.yaml:2:1: error: the tolerance of checks: "));
  EXPECT_THAT(refusal, HasSubstr("bad.yaml:3:1: error: the tolerance of verdict is -1%"));
  EXPECT_THAT(refusal_of_tolerances("nowhere.yaml"), HasSubstr("nowhere.yaml"));
}

TEST(Tolerances, AreRefusedWhereTheySayNothing) {
  EXPECT_THAT(refusal_of_tolerances("ropes=2%,checks"), HasSubstr("\"checks\" has no tolerance"));
  EXPECT_THAT(refusal_of_tolerances("=2%"), HasSubstr("a tolerance has no figure"));
  EXPECT_THAT(refusal_of_tolerances("ropes="), HasSubstr("the tolerance of ropes"));
}

}  // namespace
}  // namespace blocklift::pipeline
