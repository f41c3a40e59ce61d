// What is said of a database whose panels or runs are not known to be fine and long enough.

#include <limits>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "pipeline/build/keel_clearance.h"
#include "pipeline/hydrodynamics/hydrodynamic_report.h"

namespace blocklift::pipeline {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

dynamics::HydrodynamicDatabase two_bodies() {
  dynamics::HydrodynamicDatabase database;
  database.body_names = {"pontoon", "ship"};
  database.change_from_coarser = Eigen::VectorXd::Constant(12, 0.001);
  return database;
}

TEST(DoubtAboutPanels, IsNoneWhereTheyAreFineOrNothingIsKnown) {
  dynamics::HydrodynamicDatabase database = two_bodies();
  EXPECT_THAT(doubt_about_panels(database), IsEmpty());
  database.change_from_coarser = {};
  EXPECT_THAT(doubt_about_panels(database), IsEmpty());
}

TEST(DoubtAboutPanels, NamesTheWorstMode) {
  dynamics::HydrodynamicDatabase database = two_bodies();
  database.change_from_coarser[8] = 0.4;
  EXPECT_THAT(doubt_about_panels(database), HasSubstr("of ship in heave changes by 40 %"));
}

// Its size alone does not tell that of the radiation force: roll of a flat section is such a mode.
TEST(DoubtAboutExcitation, NamesTheWorstMode) {
  dynamics::HydrodynamicDatabase database = two_bodies();
  EXPECT_THAT(doubt_about_excitation(database), IsEmpty());
  database.excitation_change_from_coarser = Eigen::VectorXd::Constant(12, 0.1);
  EXPECT_THAT(doubt_about_excitation(database), IsEmpty());
  database.excitation_change_from_coarser[9] = 0.43;
  EXPECT_THAT(doubt_about_panels(database), IsEmpty());
  EXPECT_THAT(doubt_about_excitation(database),
              HasSubstr("waves on ship in roll changes by 43 % of its largest"));
  // Of panels without a solution another doubt speaks.
  database.excitation_change_from_coarser[9] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(doubt_about_excitation(database), IsEmpty());
}

TEST(DoubtAboutPanels, ThinksOfGapsWhereAForceChangesByMoreThanItself) {
  dynamics::HydrodynamicDatabase database = two_bodies();
  database.change_from_coarser[8] = 0.9;
  EXPECT_THAT(doubt_about_panels(database), Not(HasSubstr("gap or moonpool")));
  database.change_from_coarser[8] = 2.7;
  EXPECT_THAT(doubt_about_panels(database), HasSubstr("gap or moonpool"));
}

TEST(DoubtAboutRuns, NamesTheWorstModeAndWhatHelps) {
  dynamics::HydrodynamicDatabase database = two_bodies();
  EXPECT_THAT(doubt_about_runs(database), IsEmpty());
  database.cut_off_by_end = Eigen::VectorXd::Constant(12, 0.03);
  EXPECT_THAT(doubt_about_runs(database), IsEmpty());
  database.cut_off_by_end[1] = 0.19;
  EXPECT_THAT(doubt_about_runs(database),
              HasSubstr("about 19 % of the radiation force of pontoon in sway"));
  EXPECT_THAT(doubt_about_runs(database), HasSubstr("lid"));
}

TEST(DoubtAboutPanels, SaysThatCoarserOnesHaveNoSolution) {
  dynamics::HydrodynamicDatabase database = two_bodies();
  database.change_from_coarser.tail<6>().setConstant(std::numeric_limits<double>::infinity());
  EXPECT_THAT(doubt_about_panels(database), HasSubstr("have no solution for ship"));
}

// Panels of 4 m over 1 m of water make 20,363 t of added mass in heave of 17,087 t.
TEST(DoubtAboutKeel, IsOfPanelsWiderThanTheWaterUnderThem) {
  const dynamics::Hull barge =
      dynamics::make_barge({.length = 40, .breadth = 16, .depth = 8}, {10, 4, 2, 1}, "barge");
  const auto afloat = dynamics::Pose::translation({0, 0, -4});
  EXPECT_THAT(doubt_about_keel("barge", barge, afloat, 5.0),
              AllOf(HasSubstr("keel of barge are 1 m of water"), HasSubstr("are 4 m wide"),
                    HasSubstr("panels of 1 m or less")));
  EXPECT_THAT(doubt_about_keel("barge", barge, afloat, 8.0), IsEmpty());
  EXPECT_THAT(doubt_about_keel("barge", barge, afloat, 7.9), Not(IsEmpty()));
  constexpr double deep = std::numeric_limits<double>::infinity();
  EXPECT_THAT(doubt_about_keel("barge", barge, afloat, deep), IsEmpty());
}

TEST(DoubtAboutKeel, IsOfHullsThatPanelsCompute) {
  const auto hull = std::make_shared<const dynamics::Hull>(
      dynamics::make_barge({.length = 40, .breadth = 16, .depth = 8}, {10, 4, 2, 1}, "barge"));
  RadiationProblem problem;
  problem.water.depth = 5.0;
  problem.bodies = {{"pontoon", hull, dynamics::Pose::translation({0, 0, -4})}};
  EXPECT_THAT(doubt_about_keels(problem), HasSubstr("keel of pontoon"));
  problem.given = std::make_shared<const dynamics::HydrodynamicDatabase>();
  EXPECT_THAT(doubt_about_keels(problem), IsEmpty());
}

}  // namespace
}  // namespace blocklift::pipeline
