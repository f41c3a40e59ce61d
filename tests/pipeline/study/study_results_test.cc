// What a study says of members that failed.
#include "pipeline/study/study_results.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

StudyResults results_with_failures(int failed, StudyDesign design) {
  constexpr int count = 40;
  StudyFile study;
  study.name = "spread";
  study.design = design;
  StudyVariable variable;
  variable.name = {"w", {}};
  Eigen::MatrixXd values(count, 1);
  std::vector<Member> members;
  for (int i = 0; i < count; ++i) {
    values(i, 0) = i;
    variable.values.push_back({{static_cast<double>(i), {}}, {}});
    Member member;
    member.number = i;
    if (i < failed)
      member.failure = "case.yaml:1:1: error: too light\n    by far\n1 error\n";
    else
      member.figures = {{"load_N", 100 + std::sin(3.0 * i)}};
    members.push_back(member);
  }
  study.variables = {variable};
  return evaluate_study(study, values, members);
}

TEST(StudyResults, WarnThatStatisticsAreOfTheSurvivors) {
  const auto few = results_with_failures(2, StudyDesign::random);  // 5 %
  EXPECT_THAT(survivors_warning(few), ::testing::HasSubstr("2 of 40 members failed"));
  EXPECT_FALSE(has_too_many_failures(few));
  EXPECT_EQ(study_json(few)["warning"], survivors_warning(few));
  EXPECT_THAT(study_page(few), ::testing::HasSubstr("2 of 40 members failed"));
  EXPECT_TRUE(has_too_many_failures(results_with_failures(3, StudyDesign::random)));
  EXPECT_FALSE(study_json(results_with_failures(0, StudyDesign::random)).contains("warning"));
  EXPECT_FALSE(has_too_many_failures(results_with_failures(9, StudyDesign::grid)));
}

TEST(StudyResults, HaveARowForEachMember) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory("out");
  write_study(results_with_failures(1, StudyDesign::random), "out");
  std::ifstream stream("out/study.csv");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 41);
  EXPECT_THAT(text, ::testing::HasSubstr("case.yaml:1:1: error: too light; by far; 1 error\n"));
}

}  // namespace
}  // namespace blocklift::pipeline
