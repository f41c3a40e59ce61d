#include "pipeline/study/statistics/sobol_indices.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/study/design/study_design.h"
#include "tests/pipeline/study/varied_lengths.h"

namespace blocklift::pipeline {
namespace {

// Ishigami and Homma (1990), closed forms in Saltelli et al. (2008), Global Sensitivity Analysis,
// section 4.5, a = 7, b = 0.1. The estimates' own error at this size is a hundredth.
TEST(SobolIndices, AreThoseOfIshigami) {
  constexpr double pi = std::numbers::pi;
  const StudyFile study =
      test::study_of(StudyDesign::sensitivity, 8192,
                     {test::uniform_length(-pi, pi), test::uniform_length(-pi, pi),
                      test::uniform_length(-pi, pi)});
  const Eigen::MatrixXd design = make_design(study);
  Eigen::VectorXd figure(design.rows());
  for (Eigen::Index i = 0; i < design.rows(); ++i)
    figure[i] = std::sin(design(i, 0)) + 7 * std::pow(std::sin(design(i, 1)), 2) +
                0.1 * std::pow(design(i, 2), 4) * std::sin(design(i, 0));
  const Sensitivity found = find_sensitivity(design, figure, *study.members);
  const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
  for (Eigen::Index v = 0; v < 3; ++v) {
    EXPECT_NEAR(found.first[v], first[v], 0.03) << v;
    EXPECT_NEAR(found.total[v], total[v], 0.03) << v;
    EXPECT_LT(found.first_low[v], found.first[v]);
    EXPECT_GT(found.first_high[v], found.first[v]);
  }
}

// What does nothing has no index, however few the members; a figure that stays has none at all.
TEST(SobolIndices, InertVariablesHaveNoIndex) {
  const StudyFile study = test::study_of(StudyDesign::sensitivity, 32,
                                         {test::uniform_length(0, 1), test::uniform_length(0, 1)});
  const Eigen::MatrixXd design = make_design(study);
  const Eigen::VectorXd figure = (1000 + design.col(0).array().square()).matrix();
  const Sensitivity found = find_sensitivity(design, figure, *study.members);
  EXPECT_NEAR(found.total[1], 0, 1e-9);
  EXPECT_NEAR(found.first[1], 0, 1e-9);
  EXPECT_NEAR(found.total[0], 1, 1e-9);
  EXPECT_NEAR(found.first[0], 1, 1e-9);
  const Eigen::VectorXd still = Eigen::VectorXd::Constant(design.rows(), 3);
  EXPECT_TRUE(find_sensitivity(design, still, *study.members).total.array().isNaN().all());
}

// A correlation lies between -1 and 1, whatever the bootstrap draws: of few base members, of a
// figure that is nearly always the same, of one that is 1 in a single lift.
TEST(SobolIndices, IntervalsOfIndicesLieWhereIndicesCan) {
  const auto within = [](const Eigen::VectorXd& values, double low, double high) {
    for (const double value : values)
      if (!std::isnan(value)) {
        EXPECT_GE(value, low);
        EXPECT_LE(value, high);
      }
  };
  for (const int members : {fewest_for_sobol_indices, 20}) {
    const StudyFile study =
        test::study_of(StudyDesign::sensitivity, members,
                       {test::uniform_length(0, 1), test::uniform_length(0, 1)});
    const Eigen::MatrixXd design = make_design(study);
    Eigen::VectorXd rare = Eigen::VectorXd::Zero(design.rows()), once = rare;
    for (Eigen::Index i = 0; i < design.rows(); ++i) rare[i] = design(i, 0) > 0.9 ? 1 : 0;
    once[1] = 1;
    const Eigen::VectorXd even = design.col(0) + 0.1 * design.col(1);
    for (const Eigen::VectorXd& figure : {rare, once, even}) {
      const Sensitivity found = find_sensitivity(design, figure, members);
      for (const auto* first : {&found.first, &found.first_low, &found.first_high})
        within(*first, -1, 1);
      for (const auto* total : {&found.total, &found.total_low, &found.total_high})
        within(*total, 0, 2);
    }
    // Sample B is the same in all lifts: its first index is none.
    EXPECT_TRUE(find_sensitivity(design, once, members).first.array().isNaN().all());
    EXPECT_TRUE((find_sensitivity(design, even, members).first_low.array() <=
                 find_sensitivity(design, even, members).first_high.array())
                    .all());
  }
}

// What is left is what the study has with the other base members alone.
TEST(SobolIndices, BaseMembersWithAFailedLiftAreLeftOut) {
  constexpr int members = 40, variables = 2;
  const StudyFile study = test::study_of(StudyDesign::sensitivity, members,
                                         {test::uniform_length(0, 1), test::uniform_length(0, 1)});
  const Eigen::MatrixXd design = make_design(study);
  const auto figure_of = [](const Eigen::MatrixXd& of) {
    return Eigen::VectorXd(of.col(0).cwiseProduct(of.col(0) + of.col(1)));
  };
  Eigen::VectorXd figure = figure_of(design);
  // One lift of base member 3 and all of member 7.
  figure[2 * members + 3] = std::nan("");
  for (int k = 0; k < variables + 2; ++k) figure[k * members + 7] = std::nan("");
  const Sensitivity found = find_sensitivity(design, figure, members);
  EXPECT_EQ(found.members, members - 2);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index row = 0; row < design.rows(); ++row)
    if (row % members != 3 && row % members != 7) kept.push_back(row);
  const Eigen::MatrixXd rest = design(kept, Eigen::all);
  const Sensitivity alone = find_sensitivity(rest, figure_of(rest), members - 2);
  EXPECT_LT((found.total - alone.total).norm(), 1e-12);
  EXPECT_LT((found.first_low - alone.first_low).norm(), 1e-12);
  // Too few are left.
  for (Eigen::Index i = 0; i < 34; ++i) figure[i] = std::nan("");
  const Sensitivity none = find_sensitivity(design, figure, members);
  EXPECT_EQ(none.members, 6);
  EXPECT_TRUE(none.total.array().isNaN().all());
}

}  // namespace
}  // namespace blocklift::pipeline
