// Searches over functions whose best is known by hand, through the same door as lifts.
#include "pipeline/study/search/search.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/study/design/study_design.h"

namespace blocklift::pipeline {
namespace {

constexpr Exponents metres{1, 0, 0, 0}, plain{};

StudyVariable variable_between(const std::string& name, double lowest, double highest) {
  StudyVariable variable;
  variable.name = {name, {}};
  variable.between = {{{lowest, metres}, {}}, {{highest, metres}, {}}};
  return variable;
}

/// (x - 0.3)^2 + (y + 0.2)^2 as "cost", x + y as "sum", over x and y from -1 to 1 m.
Member bowl(const Eigen::VectorXd& values, int number) {
  const double x = values[0], y = values[1];
  return {
      number, {}, {{"cost", (x - 0.3) * (x - 0.3) + (y + 0.2) * (y + 0.2)}, {"sum", x + y}}, {}};
}

StudyFile bowl_study(int members) {
  StudyFile study;
  study.design = StudyDesign::search;
  study.members = members;
  study.variables = {variable_between("x", -1, 1), variable_between("y", -1, 1)};
  study.minimise = Located<std::string>{"cost", {}};
  return study;
}

SearchResults search(const StudyFile& study, const EvaluateMember& evaluate) {
  const Eigen::MatrixXd sample = make_design(study);
  std::vector<Member> members;
  for (Eigen::Index m = 0; m < sample.rows(); ++m)
    members.push_back(evaluate(sample.row(m).transpose(), static_cast<int>(m)));
  return search_members(study, sample, std::move(members), evaluate);
}

FigureBound at_least(const std::string& figure, double value, const Exponents& exponents = plain) {
  FigureBound bound;
  bound.figure = {figure, {}};
  bound.at_least = Located<Measure>{{value, exponents}, {}};
  return bound;
}

FigureBound at_most(const std::string& figure, double value) {
  FigureBound bound;
  bound.figure = {figure, {}};
  bound.at_most = Located<Measure>{{value, plain}, {}};
  return bound;
}

// The bottom of a bowl, which the second search finds as well; steps end at a thousandth of 2 m, of
// whose square the cost is off.
TEST(Search, FindsTheBottomOfABowl) {
  const SearchResults found = search(bowl_study(200), bowl);
  EXPECT_TRUE(found.is_feasible);
  EXPECT_TRUE(found.is_converged);
  EXPECT_NEAR(found.value, 0, 1e-4);
  EXPECT_NEAR(found.design(found.best, 0), 0.3, 0.01);
  EXPECT_NEAR(found.design(found.best, 1), -0.2, 0.01);
  ASSERT_TRUE(found.elsewhere.has_value());
  EXPECT_NEAR(*found.elsewhere, 0, 1e-3);
  EXPECT_THAT(found.at_edge, ::testing::ElementsAre(0, 0));
  // Each set of values is tried once, and all are kept.
  ASSERT_EQ(static_cast<std::size_t>(found.design.rows()), found.members.size());
  for (Eigen::Index a = 0; a < found.design.rows(); ++a)
    for (Eigen::Index b = 0; b < a; ++b) EXPECT_NE(found.design.row(a), found.design.row(b));
}

// By Lagrange: on x + y = 0.5 the nearest place to (0.3, -0.2) is (0.5, 0), at a cost of 0.08.
TEST(Search, KeepsToABoundThatBinds) {
  StudyFile study = bowl_study(200);
  study.subject_to = {at_least("sum", 0.5)};
  const SearchResults found = search(study, bowl);
  EXPECT_TRUE(found.is_feasible);
  EXPECT_NEAR(found.value, 0.08, 1e-3);
  EXPECT_GE(found.bounds.at(0).value, 0.5 * (1 - 1e-8));
  EXPECT_TRUE(found.bounds.at(0).is_active);
  EXPECT_FALSE(found.bounds.at(0).is_exceeded);
  const std::vector<double> so_far = best_so_far(study, found);
  EXPECT_EQ(so_far.back(), found.value);
  for (std::size_t m = 1; m < so_far.size(); ++m) {
    if (std::isfinite(so_far[m - 1])) {
      EXPECT_LE(so_far[m], so_far[m - 1]);
    }
  }
}

// A box hangs on two hoists 3.2 m apart, whose hooks weigh 2.943 kN, at a place x from the left one.
// The heaviest one loads both to their limits of 60 and 45 kN: 99.114 kN, at 3.2 m 42.057 / 99.114.
// Both searches end there, on the inner side of both limits.
TEST(Search, FindsTheHeaviestLoadThatTwoHoistsBear) {
  StudyFile study = bowl_study(120);
  study.variables = {variable_between("weight", 70, 120), variable_between("x", 1, 2.2)};
  study.minimise.reset();
  study.maximise = Located<std::string>{"both", {}};
  study.subject_to = {at_most("left", 60), at_most("right", 45)};
  const SearchResults found = search(study, [](const Eigen::VectorXd& values, int number) {
    const double weight = values[0], of_right = values[1] / 3.2, hook = 2.943;
    return Member{number,
                  {},
                  {{"left", weight * (1 - of_right) + hook},
                   {"right", weight * of_right + hook},
                   {"both", weight + 2 * hook}},
                  {}};
  });
  EXPECT_TRUE(found.is_feasible);
  EXPECT_NEAR(found.value, 105, 0.003);
  EXPECT_NEAR(found.design(found.best, 1), 3.2 * 42.057 / 99.114, 1e-3);
  ASSERT_TRUE(found.elsewhere.has_value());
  EXPECT_NEAR(*found.elsewhere, 105, 0.003);
  for (const BoundOfSearch& bound : found.bounds) EXPECT_TRUE(bound.is_active) << bound.figure;
}

// The same bound as a force that may be no less than zero, in newtons.
TEST(Search, CountsABoundOfZeroByTheSizeOfItsFigure) {
  StudyFile study = bowl_study(200);
  study.subject_to = {at_least("slack", 0)};
  const SearchResults found = search(study, [](const Eigen::VectorXd& values, int number) {
    Member member = bowl(values, number);
    member.figures.emplace_back("slack", 1e5 * (values[0] + values[1] - 0.5));
    return member;
  });
  EXPECT_TRUE(found.is_feasible);
  EXPECT_NEAR(found.value, 0.08, 2e-3);
  EXPECT_TRUE(found.bounds.at(0).is_active);
  EXPECT_FALSE(found.bounds.at(0).is_exceeded);
  EXPECT_EQ(best_so_far(study, found).back(), found.value);
}

// The largest sum lies in the corner; what cannot be met is said with the member that comes
// nearest.
TEST(Search, EndsAtEdgesAndSaysWhatCannotBe) {
  StudyFile study = bowl_study(100);
  study.minimise.reset();
  study.maximise = Located<std::string>{"sum", {}};
  const SearchResults corner = search(study, bowl);
  EXPECT_NEAR(corner.value, 2, 0.01);
  EXPECT_THAT(corner.at_edge, ::testing::ElementsAre(1, 1));
  study.subject_to = {at_least("sum", 3)};
  const SearchResults none = search(study, bowl);
  EXPECT_FALSE(none.is_feasible);
  EXPECT_TRUE(none.bounds.at(0).is_exceeded);
  EXPECT_FALSE(none.bounds.at(0).is_active);
  EXPECT_NEAR(none.value, 2, 0.05);
  for (const double value : best_so_far(study, none)) EXPECT_TRUE(std::isnan(value));
}

// Members that fail are as bad as can be; few members end before the search does.
TEST(Search, FailedMembersAndFewOfThem) {
  const auto half = [](const Eigen::VectorXd& values, int number) {
    return values[1] > -0.3 ? bowl(values, number) : Member{number, "fell", {}, {}};
  };
  const SearchResults found = search(bowl_study(150), half);
  EXPECT_NEAR(found.value, 0, 1e-3);
  const SearchResults short_one = search(bowl_study(16), bowl);
  EXPECT_FALSE(short_one.is_converged);
  EXPECT_FALSE(short_one.elsewhere.has_value());
  EXPECT_LE(short_one.members.size(), 16U);
}

// Along one value both searches halve the same steps: the second ends at the bottom by members that
// the first has left there.
TEST(Search, ASecondSearchOverKnownGroundEndsWhereItArrives) {
  StudyFile study = bowl_study(40);
  study.variables = {variable_between("x", 4.9, 5.1)};
  const SearchResults found = search(study, [](const Eigen::VectorXd& values, int number) {
    return Member{number, {}, {{"cost", std::abs(values[0] - 4.9996)}}, {}};
  });
  EXPECT_NEAR(found.value, 0, 2e-4);  // the last steps are a thousandth of 0.2 m
  ASSERT_TRUE(found.elsewhere.has_value());
  EXPECT_NEAR(*found.elsewhere, 0, 2e-4);
}

TEST(Search, RefusesABoundOfAnotherDimension) {
  StudyFile study = bowl_study(100);
  study.subject_to = {at_least("sum", 0.5, metres)};
  EXPECT_THROW(search(study, bowl), InputError);
  study.subject_to = {at_least("sum_m", 0.5, plain)};
  EXPECT_THROW(search(study, bowl), InputError);
}

}  // namespace
}  // namespace blocklift::pipeline
