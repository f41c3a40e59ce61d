// What a study says of members that failed.
#include "pipeline/study/results/study_results.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/study/pages/study_files.h"
#include "pipeline/study/pages/study_json.h"
#include "pipeline/study/pages/study_page.h"
#include "pipeline/study/pages/study_text.h"
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
  EXPECT_EQ(failure_of_run(few), "");
  EXPECT_EQ(study_json(few)["warning"], survivors_warning(few));
  EXPECT_THAT(study_page(few), ::testing::HasSubstr("2 of 40 members failed"));
  EXPECT_THAT(failure_of_run(results_with_failures(3, StudyDesign::random)),
              ::testing::HasSubstr("3 of 40 members failed"));
  EXPECT_FALSE(study_json(results_with_failures(0, StudyDesign::random)).contains("warning"));
  // Of a grid every member is asked for.
  EXPECT_THAT(
      failure_of_run(results_with_failures(1, StudyDesign::grid)),
      ::testing::HasSubstr("1 of 40 members of the grid failed; the first, member 0: case"));
  EXPECT_EQ(failure_of_run(results_with_failures(0, StudyDesign::grid)), "");
  EXPECT_EQ(failure_of_run(results_with_failures(9, StudyDesign::search)), "");
}

// A grid lays its values out; what is drawn tells of all such lifts.
TEST(StudyResults, OfAGridAreNoSample) {
  const auto grid = results_with_failures(0, StudyDesign::grid);
  EXPECT_TRUE(study_json(grid)["figures"][0]["quantiles"].empty());
  EXPECT_TRUE(study_json(grid)["figures"][0]["extremes"].empty());
  EXPECT_THAT(study_page(grid), ::testing::HasSubstr("these lifts are no sample"));
  EXPECT_THAT(study_page(grid), ::testing::Not(::testing::HasSubstr("share of members")));
  EXPECT_THAT(study_text(grid), ::testing::Not(::testing::HasSubstr("95 %")));
  const auto random = results_with_failures(0, StudyDesign::random);
  EXPECT_EQ(study_json(random)["figures"][0]["quantiles"].size(), 5U);
  EXPECT_THAT(study_page(random), ::testing::HasSubstr("share of members above"));
  // 40 of 72 lifts.
  EXPECT_THAT(study_text(random), ::testing::HasSubstr("95 %"));
  EXPECT_THAT(study_text(random), ::testing::HasSubstr("72 lifts"));
}

/// Members of a sample with the figures a, which all have, and b.
StudyResults results_of(StudyDesign design, int asked, Eigen::MatrixXd values,
                        const std::function<double(Eigen::Index)>& a,
                        const std::function<double(Eigen::Index)>& b) {
  StudyFile study;
  study.name = "spread";
  study.design = design;
  study.members = asked;
  study.figures = {{"a_N", {}}, {"b_N", {}}};
  for (Eigen::Index v = 0; v < values.cols(); ++v) {
    StudyVariable variable;
    variable.name = {"v" + std::to_string(v), {}};
    variable.law.emplace();
    variable.law->mean = {{1, {}}, {}};
    study.variables.push_back(variable);
  }
  std::vector<Member> members;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    Member member;
    member.number = static_cast<int>(i);
    if (std::isnan(a(i))) member.failure = "fell";
    if (member.failure.empty()) member.figures = {{"a_N", a(i)}};
    if (member.failure.empty() && !std::isnan(b(i))) member.figures.emplace_back("b_N", b(i));
    members.push_back(member);
  }
  return evaluate_study(study, std::move(values), members);
}

// A figure that a member which ran does not have has no statistics, and that is said; its values
// are in the table.
TEST(StudyResults, SayWhichFiguresTheyLeaveOut) {
  const test::TemporaryFolder folder;
  const auto lacking = results_of(
      StudyDesign::random, 20, Eigen::MatrixXd::Random(20, 1),
      [](Eigen::Index i) { return static_cast<double>(i); },
      [](Eigen::Index i) { return i < 3 ? std::nan("") : 7.5; });
  ASSERT_EQ(lacking.spreads.size(), 1U);
  EXPECT_THAT(
      left_out_warnings(lacking),
      ::testing::ElementsAre("3 of 20 members that ran have no figure b_N: it has no statistics"));
  EXPECT_THAT(study_page(lacking), ::testing::HasSubstr("have no figure b_N"));
  EXPECT_EQ(study_json(lacking)["left_out"].size(), 1U);
  std::filesystem::create_directory("out");
  write_study(lacking, "out");
  std::ifstream stream("out/study.csv");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(text, ::testing::HasSubstr(",a_N,b_N,failure\n"));
  EXPECT_THAT(text, ::testing::HasSubstr(",19,7.5,\n"));
  EXPECT_THAT(text, ::testing::HasSubstr(",2,,\n"));
}

// A lift that fails takes its base member with it and no more; where few are left, words stand in
// place of indices. A figure that stays has neither.
TEST(StudyResults, HaveSobolIndicesOfTheBaseMembersThatRan) {
  constexpr int base = 10;
  const auto of = [&](int failed) {
    return results_of(
        StudyDesign::sensitivity, base, Eigen::MatrixXd::Random(3 * base, 1),
        [&](Eigen::Index i) {
          return i < failed ? std::nan("") : std::sin(5.0 * static_cast<double>(i));
        },
        [](Eigen::Index) { return 3.0; });
  };
  EXPECT_TRUE(left_out_warnings(of(0)).empty());
  EXPECT_THAT(study_page(of(0)), ::testing::Not(::testing::HasSubstr("nan")));
  const auto two = of(2);
  EXPECT_THAT(left_out_warnings(two),
              ::testing::ElementsAre(
                  "Sobol' indices are of 8 of 10 base members: of the others a lift failed"));
  EXPECT_THAT(study_page(two), ::testing::HasSubstr("<h2>Sobol' indices"));
  const auto three = of(3);
  EXPECT_THAT(left_out_warnings(three),
              ::testing::ElementsAre(::testing::HasSubstr("there are no Sobol' indices")));
  EXPECT_THAT(study_page(three), ::testing::Not(::testing::HasSubstr("<h2>Sobol' indices")));
  EXPECT_TRUE(study_json(three)["sobol_indices"]["a_N"]["v0"]["total"].is_null());
}

TEST(StudyResults, OfOneMemberHaveNoDeviation) {
  const auto one = results_of(
      StudyDesign::random, 1, Eigen::MatrixXd::Ones(1, 1), [](Eigen::Index) { return 4.0; },
      [](Eigen::Index) { return 0.0; });
  EXPECT_TRUE(study_json(one)["figures"][0]["deviation"].is_null());
  EXPECT_EQ(study_json(one)["figures"][0]["mean"], 4);
  for (const std::string& text : {study_page(one), study_text(one)})
    EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("nan")));
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
