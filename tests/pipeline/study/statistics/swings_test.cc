// Swings of figures whose slopes are known, and of those that nothing is known of.
#include "pipeline/study/statistics/swings.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/study/design/study_design.h"
#include "pipeline/study/pages/study_json.h"
#include "pipeline/study/pages/study_page.h"
#include "pipeline/study/pages/study_text.h"
#include "pipeline/study/results/study_results.h"

namespace blocklift::pipeline {
namespace {

constexpr double normal_95 = 1.6448536269514722;  // 95 % quantile of the standard normal law

Located<Measure> tonnes(double count) { return {{1000 * count, {0, 1, 0, 0}}, {}}; }

StudyVariable spread_mass(const std::string& name, SpreadLaw::Kind kind, double first,
                          double second) {
  StudyVariable variable;
  variable.name = {name, {}};
  variable.law.emplace();
  variable.law->kind = kind;
  const bool is_uniform = kind == SpreadLaw::Kind::uniform;
  (is_uniform ? variable.law->lowest : variable.law->mean) = tonnes(first);
  (is_uniform ? variable.law->highest : variable.law->deviation) = tonnes(second);
  return variable;
}

/// A mass of 8 t with a deviation of 0.2 t, and one from 1 t to 3 t.
StudyFile two_masses(StudyDesign design, int members) {
  StudyFile study;
  study.name = "swings";
  study.design = design;
  study.members = members;
  study.variables = {spread_mass("block", SpreadLaw::Kind::normal, 8, 0.2),
                     spread_mass("hook", SpreadLaw::Kind::uniform, 1, 3)};
  return study;
}

std::vector<int> all_of(const Eigen::MatrixXd& design) {
  std::vector<int> members(static_cast<std::size_t>(design.rows()));
  std::iota(members.begin(), members.end(), 0);
  return members;
}

std::vector<double> figure_of(const Eigen::MatrixXd& design,
                              const std::function<double(double, double)>& figure) {
  std::vector<double> values;
  for (const auto& row : design.rowwise()) values.push_back(figure(row[0], row[1]));
  return values;
}

TEST(Swings, OfALinearFigureAreItsSlopesTimesTheMiddleRangeOfTheLaws) {
  const StudyFile study = two_masses(StudyDesign::random, 12);
  const Eigen::MatrixXd design = make_design(study);
  const auto values =
      figure_of(design, [](double block, double hook) { return 500 + 9.81 * block - 3 * hook; });
  const Swings swings = find_swings(study, design, values, all_of(design));
  EXPECT_NEAR(swings.of[0].from, 8000 - 200 * normal_95, 1e-6);
  EXPECT_NEAR(swings.of[0].to, 8000 + 200 * normal_95, 1e-6);
  EXPECT_NEAR(swings.of[1].from, 1100, 1e-9);
  EXPECT_NEAR(swings.of[1].to, 2900, 1e-9);
  EXPECT_NEAR(swings.of[0].value, 9.81 * 400 * normal_95, 1e-6);
  EXPECT_NEAR(swings.of[1].value, -3 * 1800, 1e-6);
  EXPECT_NEAR(swings.linear_share, 1, 1e-12);
  // 6454 before -5400.
  EXPECT_THAT(swings.by_size(), ::testing::ElementsAre(0, 1));
  const auto other = figure_of(design, [](double block, double hook) { return block - 3 * hook; });
  EXPECT_THAT(find_swings(study, design, other, all_of(design)).by_size(),
              ::testing::ElementsAre(1, 0));
}

// Rank correlations would give the hook a part of what the block does.
TEST(Swings, OfInputsThatGoTogetherAreNotCountedTwice) {
  StudyFile study = two_masses(StudyDesign::random, 40);
  StudyCorrelation joined;
  joined.of = {{"block", {}}, {"hook", {}}};
  joined.is = 0.9;
  study.correlations = {joined};
  const Eigen::MatrixXd design = make_design(study);
  const auto values = figure_of(design, [](double block, double) { return 2 * block; });
  const Swings swings = find_swings(study, design, values, all_of(design));
  EXPECT_NEAR(swings.of[0].value, 2 * 400 * normal_95, 1e-6);
  EXPECT_NEAR(swings.of[1].value, 0, 1e-6);
}

/// A grid of one input, x at -1, 0 and 1.
StudyFile grid_of_one() {
  StudyFile study;
  study.design = StudyDesign::grid;
  StudyVariable variable;
  variable.name = {"x", {}};
  for (const double value : {-1.0, 0.0, 1.0}) variable.values.push_back({{value, {}}, {}});
  study.variables = {variable};
  return study;
}

// One input at -1, 0 and 1, three times each, and residuals that have nothing in common with it:
// the slope's error is s / sqrt(Sxx), 7 freedoms are left, and Student's 97.5 % quantile of 7 is
// 2.3646.
TEST(Swings, HaveTheIntervalOfAStraightLine) {
  const StudyFile study = grid_of_one();
  Eigen::MatrixXd design(9, 1);
  design.col(0) << -1, -1, -1, 0, 0, 0, 1, 1, 1;
  const std::vector<double> values{-3, -1, -2, 1, -1, 0, 1, 3, 2};  // 2 x and -1, 1, 0
  const Swings swings = find_swings(study, design, values, all_of(design));
  const double residual = std::sqrt(6.0 / 7), slope_error = residual / std::sqrt(6.0);
  EXPECT_EQ(swings.of[0].from, -1);
  EXPECT_EQ(swings.of[0].to, 1);
  EXPECT_NEAR(swings.of[0].value, 4, 1e-12);
  EXPECT_NEAR(swings.of[0].high - 4, 2 * 2.364624 * slope_error, 1e-5);
  EXPECT_NEAR(4 - swings.of[0].low, 2 * 2.364624 * slope_error, 1e-5);
  EXPECT_NEAR(swings.linear_share, 24.0 / 30, 1e-12);
}

// One freedom is left of three members: Student's quantile is that of Cauchy's law, 12.706. Nothing
// is said on the terminal of what such a law lacks.
TEST(Swings, OfThreeMembersHaveAWideIntervalInSilence) {
  const StudyFile study = grid_of_one();
  const Eigen::MatrixXd design = Eigen::Vector3d(-1, 0, 1);
  ::testing::internal::CaptureStderr();
  const Swings swings = find_swings(study, design, {-1, -2, 3}, {0, 1, 2});  // 2 x and 1, -2, 1
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_NEAR(swings.of[0].value, 4, 1e-12);
  EXPECT_NEAR(swings.of[0].high - 4, 2 * 12.706205 * std::sqrt(3), 1e-4);
}

TEST(Swings, AreNotKnownWhereMembersDoNotTellInputsApart) {
  const StudyFile study = two_masses(StudyDesign::random, 2);
  Eigen::MatrixXd design(4, 2);
  design << 8000, 1000, 8100, 1500, 8200, 2000, 8300, 2500;  // the hook goes with the block
  const std::vector<double> values{1, 2, 4, 8};
  const Swings together = find_swings(study, design, values, all_of(design));
  EXPECT_TRUE(std::isnan(together.of[0].value));
  EXPECT_TRUE(std::isnan(together.of[1].value));
  EXPECT_TRUE(std::isnan(together.linear_share));
  // Two lifts for three numbers: a mean and two slopes.
  design(1, 1) = 2900;
  EXPECT_TRUE(std::isnan(find_swings(study, design, {1, 2}, {0, 1}).of[0].value));
  EXPECT_TRUE(std::isfinite(find_swings(study, design, values, all_of(design)).of[0].value));
  // An input that could vary and did not: its swing is not known, that of the other is.
  design.col(1).setConstant(2000);
  const Swings one = find_swings(study, design, {1, 2, 3, 4}, all_of(design));
  EXPECT_NEAR(one.of[0].value, 4 * normal_95, 1e-9);
  EXPECT_TRUE(std::isnan(one.of[1].value));
  EXPECT_THAT(one.by_size(), ::testing::ElementsAre(0, 1));
}

TEST(Swings, OfAFigureThatStaysAreZero) {
  const StudyFile study = two_masses(StudyDesign::random, 8);
  const Eigen::MatrixXd design = make_design(study);
  const Swings swings = find_swings(study, design, std::vector<double>(8, 7.5), all_of(design));
  EXPECT_NEAR(swings.of[0].value, 0, 1e-9);
  EXPECT_EQ(swings.linear_share, 1);
}

TEST(MiddleRange, OfListedValuesLeavesATwentiethOutAtEachEnd) {
  StudyVariable variable;
  for (int value = 40; value > 0; --value)
    variable.values.push_back({{static_cast<double>(value), {}}, {}});
  EXPECT_EQ(middle_range(variable), std::pair(2.0, 39.0));
  variable.values.resize(20);  // 21 to 40
  EXPECT_EQ(middle_range(variable), std::pair(21.0, 40.0));
  variable.values.resize(1);
  EXPECT_EQ(middle_range(variable), std::pair(40.0, 40.0));
}

/// Members of two masses with the figure load_N = 9.81 (block + hook) and one that stays.
StudyResults weighed(StudyDesign design) {
  StudyFile study = two_masses(design, 20);
  study.figures = {{"load_N", {}}, {"periods_s", {}}};
  const Eigen::MatrixXd values = make_design(two_masses(StudyDesign::random, 20));
  std::vector<Member> members;
  for (int number = 0; number < 20; ++number) {
    Member member;
    member.number = number;
    member.figures = {{"load_N", 9.81 * values.row(number).sum()}, {"periods_s", 4}};
    members.push_back(member);
  }
  return evaluate_study(study, values, members);
}

// 2 * 1.645 * 0.2 t and 90 % of 2 t: 6.454 kN and 17.66 kN.
TEST(Swings, StandInJsonTextAndPageTheLargestFirst) {
  const StudyResults results = weighed(StudyDesign::random);
  const auto json = study_json(results)["figures"][0];
  EXPECT_EQ(json["swings"].begin().key(), "hook");
  EXPECT_NEAR(json["swings"]["block"]["swing"].get<double>(), 9.81 * 400 * normal_95, 1e-6);
  EXPECT_NEAR(json["swings"]["hook"]["swing"].get<double>(), 9.81 * 1800, 1e-6);
  EXPECT_NEAR(json["swings"]["hook"]["to"].get<double>(), 2900, 1e-9);
  EXPECT_NEAR(json["linear_share"].get<double>(), 1, 1e-12);
  const std::string text = study_text(results), page = study_page(results);
  EXPECT_THAT(text, ::testing::ContainsRegex("load +kN +hook +1100 kg +2900 kg +\\+17\\.7\n"
                                             " +block +7671 kg +8329 kg +\\+6\\.45\n"));
  EXPECT_THAT(page, ::testing::HasSubstr("<td>hook</td><td>1100 kg</td><td>2900 kg</td>"));
  EXPECT_THAT(page, ::testing::HasSubstr("<td>+17.66 (17.66 to 17.66)</td>"));
  EXPECT_THAT(page, ::testing::HasSubstr("Straight lines explain 100.0 % of its variance"));
  EXPECT_LT(page.find("<td>hook</td><td>1100"), page.find("<td>block</td><td>7671"));
  // The bar of the largest fills its half.
  EXPECT_THAT(page, ::testing::HasSubstr("left:50.0%;width:50.0%"));
  EXPECT_THAT(page, ::testing::Not(::testing::HasSubstr("nan")));
}

TEST(Swings, OfAGridHaveNoIntervalAndOfASearchThereAreNone) {
  EXPECT_THAT(study_page(weighed(StudyDesign::grid)), ::testing::HasSubstr("<td>+17.66</td>"));
  const auto of_search = study_json(weighed(StudyDesign::search))["figures"][0];
  EXPECT_TRUE(of_search["swings"].empty());
  EXPECT_TRUE(of_search["linear_share"].is_null());
}

}  // namespace
}  // namespace blocklift::pipeline
