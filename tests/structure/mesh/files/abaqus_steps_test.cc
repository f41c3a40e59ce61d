// Steps of decks of Abaqus, and what each keeps of those before it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/files/abaqus/reader.h"
#include "tests/structure/mesh/files/abaqus_plate.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

TEST(AbaqusSteps, StepsGoOnFromOneAnother) {
  const Deck deck = abaqus(abaqus_square_plate + R"(*NSET, NSET=TURNED
4
*TRANSFORM, NSET=TURNED, TYPE=R
0., 1., 0., -1., 0., 0.
*BOUNDARY
1, ENCASTRE
*STEP, NAME=First
*STATIC
*CLOAD
2, 3, 100.
4, 1, 50.
*DLOAD
Plate, P, 1000.
*OUTPUT, FIELD
*END STEP
*STEP, NAME=Second
*STATIC
*CLOAD
2, 3, 30.
*BOUNDARY
2, 1, 2, .1
*DLOAD
, GRAV, 9.81, 0., 0., -2.
*END STEP
*STEP, NAME=Third, PERTURBATION
*STATIC
*CLOAD
3, 1, 5.
*END STEP
)");
  ASSERT_EQ(deck.load_cases.size(), 3U);
  EXPECT_EQ(deck.load_cases[1].title, "Second");
  const LoadSet &first = deck.load_sets[0], &second = deck.load_sets[1], &third = deck.load_sets[2];
  expect_near(first.point_loads.at(0).force, Vector3(0, 0, 100), 1e-12);
  expect_near(first.point_loads.at(1).force, Vector3(0, 50, 0), 1e-12);
  expect_near(second.point_loads.at(0).force, Vector3(0, 0, 30), 1e-12);
  EXPECT_EQ(second.point_loads.size(), 2U);
  EXPECT_DOUBLE_EQ(second.plate_loads.at(0).pressure[0], 1000);
  expect_near(second.gravity, Vector3(0, 0, -9.81), 1e-12);
  EXPECT_EQ(third.point_loads.size(), 1U);
  EXPECT_TRUE(third.plate_loads.empty());
  EXPECT_EQ(deck.support_sets[0].supports.size(), 1U);
  EXPECT_EQ(deck.support_sets[1].supports.size(), 2U);
  EXPECT_DOUBLE_EQ(deck.support_sets[1].supports[1].value[1], 0.1);
  // A perturbation moves no further what the step before it has moved.
  EXPECT_EQ(deck.support_sets[2].supports.size(), 2U);
  EXPECT_EQ(deck.support_sets[2].supports[1].value[1], 0);
  EXPECT_THAT(entry(deck, "*OUTPUT").left_out, ::testing::HasSubstr("printed"));
}

// A perturbation after a step with NLGEOM has the stiffness of what that has strained.
TEST(AbaqusSteps, PerturbationsOfWhatIsStrainedAreNoLoadCases) {
  const auto deck_of = [](const std::string& of_first) {
    return abaqus(abaqus_square_plate + "*BOUNDARY\n1, ENCASTRE\n*STEP" + of_first +
                  "\n*STATIC\n*CLOAD\n2, 3, 100.\n*END STEP\n*STEP, PERTURBATION\n*STATIC\n"
                  "*CLOAD\n3, 1, 5.\n*END STEP\n");
  };
  EXPECT_EQ(deck_of("").load_cases.size(), 2U);
  EXPECT_EQ(deck_of(", NLGEOM=NO").load_cases.size(), 2U);
  const Deck strained = deck_of(", NLGEOM");
  ASSERT_EQ(strained.load_cases.size(), 1U);
  EXPECT_EQ(strained.load_cases[0].label, 1);
  const auto says = [&](const DeckRemark& remark) {
    return remark.text.find("step 2 is no load case: a perturbation begins") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(strained.remarks.begin(), strained.remarks.end(), says));
}

// What is given again in a later step takes the place of what was there; within a step loads add
// up, forces on a node's freedom too. OP = NEW, which preprocessors write at each block of a step,
// drops the steps before alone.
TEST(AbaqusSteps, LaterStepsChangeLoads) {
  const Deck deck = abaqus(abaqus_square_plate + R"(*SURFACE, NAME=TOP
PLATE, SPOS
*STEP
*STATIC
*BOUNDARY
1, 1, 6
*CLOAD
2, 3, 100.
3, 3, 7.
*CLOAD
2, 3, -40.
*DLOAD
PLATE, P, 1000.
PLATE, P, 500.
, GRAV, 9.81, 0., 0., -1.
*DSLOAD
TOP, P, 7.
*END STEP
*STEP
*STATIC
*DLOAD
PLATE, P, 400.
, GRAV, 3., 0., 1., 0.
*CLOAD
3, 3, 8.
*END STEP
*STEP
*STATIC
*BOUNDARY, OP=NEW
1, 1, 3
*BOUNDARY, OP=NEW
4, 3, 3
*CLOAD, OP=NEW
3, 3, 10.
*CLOAD, OP=NEW
4, 3, 20.
*DLOAD, OP=NEW
PLATE, P, 5.
*DLOAD, OP=NEW
PLATE, P, 6.
*END STEP
)");
  ASSERT_EQ(deck.load_sets.size(), 3U);
  const auto pressure = [&](std::size_t step) {
    double sum = 0;
    for (const PlateLoad& load : deck.load_sets[step].plate_loads) sum += load.pressure[0];
    return sum;
  };
  EXPECT_DOUBLE_EQ(pressure(0), 1500 - 7);
  EXPECT_DOUBLE_EQ(pressure(1), 400 - 7);
  expect_near(deck.load_sets[1].gravity, Vector3(0, 3, 0), 1e-12);
  EXPECT_DOUBLE_EQ(pressure(2), 11 - 7);
  EXPECT_TRUE(deck.load_sets[2].gravity.isZero());
  EXPECT_DOUBLE_EQ(deck.load_sets[0].point_loads.at(0).force.z(), 60);
  EXPECT_DOUBLE_EQ(deck.load_sets[1].point_loads.at(0).force.z(), 60);
  EXPECT_DOUBLE_EQ(deck.load_sets[1].point_loads.at(1).force.z(), 8);
  EXPECT_EQ(deck.load_sets[2].point_loads.size(), 2U);
  EXPECT_EQ(deck.support_sets.at(2).supports.size(), 2U);
}

// A load case has what is there at the end of its step: a period of 2, a table that ends at 4, one
// that begins later, one by the time of all steps. Forces of the first step by CalculiX 2.20 on a
// cube: 50, 12.5 and a quarter; in the second the quarter has become a half there.
TEST(AbaqusSteps, AmplitudesAreTakenAtTheEndOfTheStep) {
  const std::string tables = R"(*AMPLITUDE, NAME=RAMP
0., 0., 4., 1.
*AMPLITUDE, NAME=ALL, TIME=TOTAL TIME
0., 0., 1., 0., 5., 1.
*AMPLITUDE, NAME=WAVE, DEFINITION=PERIODIC
1, 5., 0., 0.
0., 1.
)";
  const Deck deck = abaqus(abaqus_square_plate + tables + R"(*BOUNDARY
1, ENCASTRE
*STEP
*STATIC
1., 2.
*CLOAD, AMPLITUDE=RAMP
2, 3, 100.
*CLOAD, AMPLITUDE=RAMP, TIME DELAY=1.5
3, 3, 100.
*DLOAD, AMPLITUDE=ALL
Plate, P, 1000.
*BOUNDARY, AMPLITUDE=RAMP
4, 3, 3, .1
*END STEP
*STEP
*STATIC
*CLOAD, AMPLITUDE=ALL
2, 3, 100.
*END STEP
)");
  ASSERT_EQ(deck.load_sets.size(), 1U);
  EXPECT_DOUBLE_EQ(deck.load_sets[0].point_loads.at(0).force.z(), 50);
  EXPECT_DOUBLE_EQ(deck.load_sets[0].point_loads.at(1).force.z(), 12.5);
  EXPECT_DOUBLE_EQ(deck.load_sets[0].plate_loads.at(0).pressure[0], 250);
  EXPECT_DOUBLE_EQ(deck.support_sets.at(0).supports.at(1).value[2], 0.05);
  ASSERT_FALSE(deck.remarks.empty());
  EXPECT_THAT(
      deck.remarks.back().text,
      ::testing::HasSubstr("step 2 is no load case: what steps before gave with AMPLITUDE"));

  const auto said = [&](const std::string& name) {
    return complaints_of_abaqus(abaqus_square_plate + tables +
                                "*STEP\n*STATIC\n*CLOAD, AMPLITUDE=" + name +
                                "\n2, 3, 100.\n*END STEP\n");
  };
  EXPECT_THAT(said("WAVE"), ::testing::HasSubstr("amplitude WAVE has DEFINITION"));
  EXPECT_THAT(said("GONE"), ::testing::HasSubstr("amplitude GONE does not exist"));
}

}  // namespace
}  // namespace blocklift::structure::test
