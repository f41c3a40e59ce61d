#include "pipeline/files/lift_case/lift_case.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/files/lift_case/lift_case_complaints.h"

namespace blocklift::pipeline {
namespace {

using test::complaints_about;
using test::complaints_about_case;
using test::SampleLift;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

TEST(LiftCaseTest, CarriesEverythingThatTheFilesSay) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  const LiftCase lift = read_lift_case(".");
  EXPECT_EQ(lift.name, "small-lift");
  EXPECT_DOUBLE_EQ(lift.gravity, 9.81);
  ASSERT_EQ(lift.cranes.size(), 1U);
  const CraneModel& crane = *lift.cranes[0].model;
  EXPECT_DOUBLE_EQ(crane.bodies[1].inertia_matrix()(0, 1), 1000);
  EXPECT_DOUBLE_EQ(crane.bodies[0].inertia_matrix()(1, 1), 100e3 * 9);
  EXPECT_EQ(crane.joints[0].parent.value, "world");
  EXPECT_DOUBLE_EQ(crane.drives[0].speed.value.value, 0.5);
  EXPECT_DOUBLE_EQ(crane.hoists[0].rope.breaking_load, 1e6);
  EXPECT_DOUBLE_EQ(crane.hoists[1].rope.breaking_load, 100e3 * 9.80665);
  EXPECT_TRUE(std::isinf(crane.hoists[1].crane_stiffness));
  EXPECT_DOUBLE_EQ(lift.cranes[0].find_start("left")->value.value, 5);
  ASSERT_EQ(lift.ropes.size(), 2U);
  EXPECT_EQ(lift.ropes[1].lug(), "L2");
  EXPECT_EQ(lift.ropes[1].path[0].body_name(lift.cranes), "C1.right");
  EXPECT_DOUBLE_EQ(lift.ropes[1].path[1].point.z(), 1.2);
  EXPECT_EQ(lift.load.model->plates[1].at.size(), 3U);
  EXPECT_DOUBLE_EQ(lift.checks.rope_safety_factor, 5);
  EXPECT_EQ(lift.structure.element_degree, 3);
  EXPECT_DOUBLE_EQ(lift.dynamics.sample_interval, 0.05);
  EXPECT_DOUBLE_EQ(*lift.compare->ropes[1].value.dynamic_load, 6000 * 9.80665);
}

TEST(LiftCaseTest, ARopeMayEndAtALugThatIsACopy) {
  SampleLift lift;
  const std::string& block = lift.block;
  const std::size_t pad = block.find("  right_pad:"), lug = block.find("  L2:");
  lift.block = block.substr(0, pad) + block.substr(block.find("lugs:"), lug - block.find("lugs:")) +
               block.substr(block.find('\n', lug) + 1) +
               "repeat:\n  - {parts: [left_pad, L1], count: 1, step: [4 m, 0 m, 0 m]}\n";
  lift.lift_case = with(lift.lift_case, "to: L2", "to: L1.1");
  const TemporaryFolder folder;
  lift.write(folder);
  const LiftCase read = read_lift_case(".");
  EXPECT_EQ(read.ropes[1].lug(), "L1.1");
  EXPECT_LT((read.ropes[1].path.back().point - Vector3(4, 0, 1.2)).norm(), 1e-12);
}

TEST(LiftCaseTest, ReadsALoadTable) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.lift_case = test::sample_load_table_case;
  lift.write(folder);
  const LiftCase lift_case = read_lift_case("case.yaml");
  EXPECT_DOUBLE_EQ(lift_case.load_table->direction_at("L1").z(), 1);
  EXPECT_DOUBLE_EQ(lift_case.load_table->static_loads[0].value, 5000 * 9.80665);
  EXPECT_DOUBLE_EQ(lift_case.load_table->static_loads[1].value, 50e3);
}

TEST(LiftCaseTest, SheavesOnTheLoadAreRefused) {
  EXPECT_EQ(complaints_about_case("R1: {from: C1.left, to: L1",
                                  "R1: {from: C1.left, through: [L1], to: L2"),
            "case.yaml:9:33: error: rope R1 runs over a sheave on the load, whose force on the "
            "block would be missing from its stress\n"
            "    ropes begin or end at lugs; sheaves stand on cranes, hooks or the world\n"
            "1 error\n");
}

TEST(LiftCaseTest, FrictionAsksForSheavesAndComesOnce) {
  const std::string rope = "R1: {from: C1.left, to: L1";
  EXPECT_EQ(complaints_about_case(rope, "R1: {sheave_friction: 0.1, from: C1.left, to: L1"),
            "case.yaml:9:25: error: the rope has friction at its sheaves, and none of them\n"
            "    name the hooks, pins or sheaves that it runs over: through: [...]\n"
            "1 error\n");
  EXPECT_THAT(complaints_about_case(rope,
                                    "R1: {sheave_friction: -0.1, through: [{body: C1.gantry, "
                                    "point: [1 m, 5 m, 8 m]}], from: C1.left, to: L1"),
              ::testing::AllOf(HasSubstr("case.yaml:9:25: error:"), HasSubstr("-0.1"),
                               HasSubstr("1 error\n")));
  EXPECT_THAT(complaints_about_case(rope,
                                    "R1: {sheave_friction: 0.1, sheave_efficiency: 90 %, through: "
                                    "[{body: C1.gantry, point: [1 m, 5 m, 8 m]}], from: C1.left, "
                                    "to: L1"),
              HasSubstr("error: the rope has both a friction and an efficiency of its sheaves"));
}

/// The sample's slings and left tackle with that in place of their stiffness.
std::string complaints_about_stretch(const std::string& keys, const std::string& case_lines = "") {
  SampleLift lift;
  lift.rope = with(lift.rope, "axial_stiffness: 200 MN\n", keys);
  lift.lift_case += case_lines;
  return complaints_about(lift);
}

TEST(LiftCaseTest, RopesStretchByOneStiffnessOrACurve) {
  const auto curve = [](const std::string& points) {
    return complaints_about_stretch("tension_curve: " + points + "\n");
  };
  EXPECT_EQ(curve("[[0 %, 0 t], [1 %, 20 t], [2 %, 60 t]]"), "");
  EXPECT_EQ(curve("[[0, 0], [1 %, 10 %], [4 %, 100 %]]"), "");
  EXPECT_THAT(complaints_about_stretch(""),
              HasSubstr("the rope has neither axial_stiffness nor tension_curve"));
  EXPECT_THAT(complaints_about_stretch(
                  "axial_stiffness: 200 MN\ntension_curve: [[0 %, 0 t], [1 %, 20 t]]\n"),
              HasSubstr("the rope has both axial_stiffness and tension_curve"));
  EXPECT_THAT(curve("[[0 %, 1 t], [1 %, 20 t]]"),
              HasSubstr("tackle.yaml:2:16: error: tension_curve does not begin at no strain"));
  EXPECT_THAT(curve("[[0 %, 0 t], [1 %, 20 t], [2 %, 20 t]]"),
              HasSubstr("tension_curve does not rise from point 2 to the next"));
  EXPECT_THAT(curve("[[0 %, 0 t], [1 %, 20 t], [2 %, 30 t]]"),
              HasSubstr("tension_curve is less steep from point 2 on than before"));
  EXPECT_THAT(curve("[[0 %, 0 t], [20 t, 1 %]]"),
              HasSubstr("a point begins with a strain from 0 to 100 %"));
  EXPECT_THAT(curve("[[0 %, 0 %], [1 %, 120 %]]"),
              HasSubstr("a share of the breaking load from 0 to 100 %"));
}

TEST(LiftCaseTest, ACurveStandsForNeitherCatenariesNorFriction) {
  const std::string curve = "tension_curve: [[0 %, 0 t], [1 %, 20 t], [2 %, 60 t]]\n";
  EXPECT_THAT(complaints_about_stretch(curve + "mass: 5 kg/m\n", "rope_weight: true\n"),
              HasSubstr("rope R1 hangs by its weight, and has a tension_curve"));
  SampleLift lift;
  lift.rope = with(lift.rope, "axial_stiffness: 200 MN\n", curve);
  lift.lift_case = with(lift.lift_case, "from: C1.left, to: L1",
                        "sheave_friction: 0.1, through: [{body: C1.gantry, point: [1 m, 5 m, 8 "
                        "m]}], from: C1.left, to: L1");
  EXPECT_THAT(complaints_about(lift),
              HasSubstr("rope R1 has friction at its sheaves, and a tension_curve"));
}

TEST(LiftCaseTest, OperationMustLastAndNotForEver) {
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "settle: 10 s", "settle: 0 s");
  const std::size_t moves = lift.lift_case.find("    pause: 5 s");
  lift.lift_case.erase(moves, lift.lift_case.find("settle:") - moves);
  EXPECT_EQ(complaints_about(lift),
            "case.yaml:12:12: error: the operation takes no time\n"
            "    give it a move, a pause or a settle time\n"
            "1 error\n");
  EXPECT_EQ(complaints_about_case("pause: 5 s", "pause: 1e6 s"),
            "case.yaml:12:12: error: the operation lasts 1.00007e+06 s, with a sample every 0.05 s "
            "(sample_interval)\n"
            "    at most 500000 samples are recorded; shorten the pauses or lengthen the interval\n"
            "case.yaml:12:12: error: the operation lasts 1.00007e+06 s, with a sample every 1 s "
            "(static_interval)\n"
            "    at most 500000 samples are recorded; shorten the pauses or lengthen the interval\n"
            "2 errors\n");
}

TEST(LiftCaseTest, SamplesAreCloserThanTheBounceOfALoad) {
  EXPECT_EQ(complaints_about_case("settle: 10 s", "settle: 10 s\ndynamics: {sample_interval: 1 s}"),
            "case.yaml:21:29: error: sample_interval \"1 s\" must be from 0.0001 s to 0.2 s\n"
            "1 error\n");
}

TEST(LiftCaseTest, NaturalModesAreThoseOfAModalBlock) {
  EXPECT_EQ(complaints_about_case(
                "settle: 10 s", "settle: 10 s\ndynamics: {flexibility: static, elastic_modes: 5}"),
            "case.yaml:21:48: error: elastic_modes is given, and the block has no natural modes\n"
            "    they are those of flexibility: modal\n"
            "1 error\n");
}

TEST(LiftCaseTest, ReadsMeasuredTensions) {
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "  source: a yard\n",
                        "  source: a yard\n  series: {R2: {file: r2.csv, unit: t, offset: 5 s}}\n");
  const auto read = [&](const std::string& csv, std::optional<LiftCase>& lift_case) {
    const TemporaryFolder folder;
    lift.write(folder);
    folder.write("r2.csv", csv);
    Diagnostics diagnostics;
    ModelLibrary library({});
    lift_case = read_lift_case("case.yaml", library, diagnostics);
    return diagnostics.to_text();
  };
  std::optional<LiftCase> lift_case;
  ASSERT_EQ(read("# measured\ntime [s]; tension [t]\n0;5\n2.5;5.5\n", lift_case), "");
  const MeasuredSeries& series = lift_case->compare->series.at(0).value;
  EXPECT_EQ(series.time, (std::vector<double>{5, 7.5}));
  EXPECT_DOUBLE_EQ(series.tension[1], 5.5 * 9806.65);
  const auto says = [&](const std::string& csv, const std::string& part) {
    const std::string text = read(csv, lift_case);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says("0,5\n1,x\n", "r2.csv:2: \"x\" is not a finite number");
  says("0,5\n1,5,6\n", "3 values; 2 are due");
  says("2,5\n1,5\n", "the times do not ascend");
  says("", "the file has no rows");
  says("1\n2\n", "has 1 columns; time in s and the tension are due");
}

}  // namespace
}  // namespace blocklift::pipeline
