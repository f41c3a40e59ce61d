// What is said of cases that cannot be.
#include <filesystem>
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

TEST(LiftCaseErrors, UnknownKey) {
  EXPECT_EQ(complaints_about_case("settle: 10 s", "setle: 10 s"),
            "case.yaml:20:1: error: lift case has no key \"setle\"\n"
            "    its keys are case, title, document, gravity, load, cranes, spreaders, ropes, "
            "rope_weight, sling_tolerance, ground, ground_contact, ... (27 in all); did you mean "
            "\"settle\"?\n"
            "1 error\n");
}

TEST(LiftCaseErrors, WrongUnit) {
  EXPECT_EQ(complaints_about_case("speed: 15 m/min", "speed: 15 m"),
            "case.yaml:18:48: error: speed \"15 m\" is a length; a speed or an angular speed is "
            "due, for example \"3 m/min\" or \"0.5 deg/s\"\n1 error\n");
  EXPECT_EQ(complaints_about_case("length: 2 m}\n  R2", "length: 2}\n  R2"),
            "case.yaml:9:60: error: length \"2\" has no unit; a length is due, for example \"12 m\""
            "\n1 error\n");
}

TEST(LiftCaseErrors, MissingModel) {
  EXPECT_EQ(complaints_about_case("model: gantry", "model: gantri"),
            "case.yaml:6:12: error: there is no crane model \"gantri\"\n"
            "    the crane models are gantry; did you mean \"gantry\"?\n"
            "    looked for in .\n"
            "1 error\n");
}

TEST(LiftCaseErrors, MissingModelWithAnotherFolderOrKind) {
  EXPECT_EQ(complaints_about_case("from: C1.left, to: L1, model: ropes/tackle",
                                  "from: C1.left, to: L1, model: slings/tacle"),
            "case.yaml:9:38: error: there is no rope model \"slings/tacle\"\n"
            "    the rope models are ropes/tackle; did you mean \"ropes/tackle\"?\n"
            "    looked for in .\n"
            "1 error\n");
  EXPECT_EQ(complaints_about_case("from: C1.left, to: L1, model: ropes/tackle",
                                  "from: C1.left, to: L1, model: gantry"),
            "case.yaml:9:38: error: there is no rope model \"gantry\"\n"
            "    the rope models are ropes/tackle\n"
            "    looked for in .\n"
            "    \"gantry\" is a crane\n"
            "1 error\n");
}

TEST(LiftCaseErrors, ModelOfAnotherKind) {
  SampleLift lift;
  lift.crane = test::sample_rope;
  EXPECT_EQ(complaints_about(lift),
            "gantry/crane.yaml:1:7: error: this file describes a rope; a crane is due\n"
            "    case.yaml:6:12 names it as the model of a crane\n1 error\n");
}

TEST(LiftCaseErrors, ModelThatLiesBesideTheCase) {
  const test::TemporaryFolder folder;
  SampleLift().write(folder);
  folder.write("hoist.yaml", "# of the yard\nkind: crane  # the small one\n");
  folder.write("winch.yaml", "\"kind\": 'crane'\n");
  folder.write("notes.yaml", "kinds: crane\nkind of: crane\n");
  folder.write("case.yaml", with(SampleLift().lift_case, "model: gantry", "model: hoists"));
  Diagnostics diagnostics;
  ModelLibrary library({});
  EXPECT_FALSE(read_lift_case("case.yaml", library, diagnostics));
  EXPECT_EQ(diagnostics.to_text(),
            "case.yaml:6:12: error: there is no crane model \"hoists\"\n"
            "    the crane models are gantry, hoist, winch; did you mean \"hoist\"?\n"
            "    looked for in .\n"
            "1 error\n");
}

TEST(LiftCaseErrors, NegativeMass) {
  SampleLift lift;
  lift.crane = with(lift.crane, "mass: 100 t", "mass: -100 t");
  lift.block = with(lift.block, "mass: 10 t", "mass: -10 t");
  EXPECT_EQ(complaints_about(lift),
            "gantry/crane.yaml:5:11: error: mass \"-100 t\" must be at least 0\n"
            "plate.yaml:4:7: error: mass \"-10 t\" must be greater than 0\n"
            "2 errors\n");
}

TEST(LiftCaseErrors, ImpossibleInertia) {
  SampleLift lift;
  lift.crane = with(lift.crane, "[4 m, 3 m, 4 m]", "[4 m, 3 m, 6 m]");
  EXPECT_EQ(
      complaints_about(lift),
      "gantry/crane.yaml:7:24: error: body gantry has an inertia that no distribution of mass "
      "has: principal moments 900, 1600 and 3600 t m^2\n"
      "    none may be negative or larger than the sum of the other two\n1 error\n");
}

TEST(LiftCaseErrors, RopeToALugThatDoesNotExist) {
  EXPECT_EQ(complaints_about_case("to: L2", "to: L7"),
            "case.yaml:10:28: error: rope R2 ends at lug \"L7\", which block plate does not have\n"
            "    its lugs are L1, L2; did you mean \"L1\"?\n1 error\n");
}

TEST(LiftCaseErrors, RopeFromAHookThatDoesNotExist) {
  EXPECT_EQ(complaints_about_case("from: C1.right", "from: C1.rigth"),
            "case.yaml:10:14: error: rope R2 begins at \"C1.rigth\", but crane C1 has no hoist "
            "\"rigth\"\n"
            "    its hoists are C1.left, C1.right; did you mean \"C1.right\"?\n1 error\n");
  EXPECT_EQ(complaints_about_case("from: C1.right", "from: C2.right"),
            "case.yaml:10:14: error: rope R2 begins at \"C2.right\", but the case has no crane "
            "\"C2\"\n"
            "    its cranes are C1; did you mean \"C1\"?\n1 error\n");
  EXPECT_EQ(complaints_about_case("from: C1.right", "from: C1.gantry"),
            "case.yaml:10:14: error: rope R2 begins at body \"C1.gantry\" without saying where\n"
            "    give the point: {body: C1.gantry, point: [0 m, 0 m, 0 m]}\n1 error\n");
}

TEST(LiftCaseErrors, WinchThatPullsItsRopeThroughTheSheave) {
  EXPECT_EQ(
      complaints_about_case("by: -2 m", "by: -5.5 m"),
      "case.yaml:15:19: error: winch C1.left would pull its rope through the sheave in stage "
      "\"hoist up\": its length would go from 5 m to -0.5 m\n"
      "    its range is 1 m to 9 m, and it starts the operation at 5 m\n"
      "case.yaml:15:28: error: winch C1.right would pull its rope through the sheave in stage "
      "\"hoist up\": its length would go from 5 m to -0.5 m\n"
      "    its range is 1 m to 9 m, and it starts the operation at 5 m\n"
      "2 errors\n");
  // Moves add up.
  EXPECT_EQ(complaints_about_case("by: -2 m}",
                                  "by: -2 m}\n      - {drives: [C1.left], to: 0.5 m, "
                                  "delay: 60 s}"),
            "case.yaml:16:19: error: C1.left would go from 3 m to 0.5 m in stage \"hoist up\", "
            "outside its range\n"
            "    its range is 1 m to 9 m, and it starts the operation at 5 m\n"
            "1 error\n");
}

std::string complaints_about_spreader(const std::string& old_passage,
                                      const std::string& new_passage) {
  SampleLift lift = test::spreader_lift();
  lift.lift_case = with(lift.lift_case, old_passage, new_passage);
  return complaints_about(lift);
}

TEST(LiftCaseErrors, EyesOfAFrameAtABar) {
  EXPECT_EQ(complaints_about_spreader("to: B1.upper_b", "to: B1.upper_2"),
            "case.yaml:18:27: error: rope U2 ends at \"B1.upper_2\", which is no eye of spreader "
            "B1\n    numbered eyes are those of a frame, which has a width; the eyes of a bar are "
            "B1.upper_a, B1.upper_b, B1.lower_a, B1.lower_b\n1 error\n");
}

// Two spreaders that hang on one another hang on nothing.
TEST(LiftCaseErrors, SpreadersInARing) {
  SampleLift lift = test::spreader_lift();
  lift.lift_case = with(lift.lift_case, "spreaders:\n",
                        "spreaders:\n  B2: {length: 4 m, section: {pipe: [168.3 mm, 8 mm]}, "
                        "yield_stress: 355 MPa}\n");
  lift.lift_case = with(lift.lift_case, "U1: {from: C1.left,", "U1: {from: B2.lower_a,");
  lift.lift_case = with(lift.lift_case, "U2: {from: C1.left,", "U2: {from: B2.lower_b,");
  lift.lift_case = with(lift.lift_case, "  R1: {from",
                        "  V1: {from: B1.lower_a, to: B2.upper_a, model: ropes/tackle, length: 2 m}"
                        "\n  V2: {from: B1.lower_b, to: B2.upper_b, model: ropes/tackle, length: "
                        "2 m}\n  R1: {from");
  const std::string complaints = complaints_about(lift);
  for (const char* name : {"B1", "B2"})
    EXPECT_THAT(complaints, HasSubstr("the slings above spreader " + std::string(name) +
                                      " begin at spreaders that hang on nothing else\n    slings "
                                      "from above begin at a hook, or at a spreader that hangs on "
                                      "one"));
}

// What has no length by a mistake of its own is not measured besides.
TEST(LiftCaseErrors, SpreaderWhoseLengthHasNoUnit) {
  const std::string complaints = complaints_about_spreader("    length: 4 m\n", "    length: 4\n");
  EXPECT_THAT(complaints, HasSubstr("length \"4\" has no unit"));
  EXPECT_THAT(complaints, ::testing::Not(HasSubstr("nan")));
}

TEST(LiftCaseErrors, RopeThatStaysOnOneBody) {
  const std::string complaints =
      complaints_about_spreader("U2: {from: C1.left,", "U2: {from: B1.lower_a,");
  EXPECT_THAT(complaints, HasSubstr("rope U2 begins and ends at B1\n    a rope leads from one body "
                                    "to another"));
}

TEST(LiftCaseErrors, EyeThatASpreaderDoesNotHave) {
  EXPECT_EQ(
      complaints_about_spreader("to: B1.upper_b", "to: B1.uper_b"),
      "case.yaml:18:27: error: rope U2 ends at \"B1.uper_b\", which is no eye of spreader B1\n"
      "    its eyes are B1.upper_a, B1.upper_b, B1.lower_a, B1.lower_b; did you mean "
      "\"B1.upper_b\"?\n1 error\n");
}

TEST(LiftCaseErrors, SpreaderThatTheCaseDoesNotHave) {
  EXPECT_THAT(complaints_about_spreader("to: B1.upper_b", "to: B2.upper_b"),
              ::testing::AllOf(::testing::HasSubstr("the case has no crane or spreader \"B2\""),
                               ::testing::HasSubstr("its cranes and spreaders are C1, B1; did you "
                                                    "mean \"B1\"?")));
}

TEST(LiftCaseErrors, SlingsThatDoNotReachAroundASpreader) {
  EXPECT_EQ(
      complaints_about_spreader("upper_b, model: ropes/tackle, length: 2.5 m",
                                "upper_b, model: ropes/tackle, length: 1.5 m"),
      "case.yaml:17:68: error: slings U1 and U2 are too short: 2.5 m and 1.5 m from one point "
      "do not reach the eyes of spreader B1, which are 4 m apart\n1 error\n");
}

TEST(LiftCaseErrors, SpreaderThatHangsOnNothing) {
  EXPECT_EQ(complaints_about_spreader("spreaders:\n",
                                      "spreaders:\n"
                                      "  B2: {length: 2 m, section: {pipe: [100 mm, 5 mm]}, "
                                      "yield_stress: 235 MPa}\n"),
            "case.yaml:9:3: error: no sling ends at spreader B2\n"
            "    slings from above end at B2.upper_a and B2.upper_b, those to the load begin at "
            "B2.lower_a and B2.lower_b\n1 error\n");
}

TEST(LiftCaseErrors, SpreaderOfAThinOrImpossibleWall) {
  EXPECT_EQ(complaints_about_spreader("[168.3 mm, 8 mm]", "[168.3 mm, 2 mm]"),
            "case.yaml:11:14: error: the wall of spreader B1 is too thin: diameter over thickness "
            "is 84.2\n    up to 59.6 a wall of this steel yields before it buckles "
            "(EN 1993-1-1, table 5.2, class 3)\n1 error\n");
  EXPECT_THAT(complaints_about_spreader("[168.3 mm, 8 mm]", "[168.3 mm, 90 mm]"),
              HasSubstr("a wall of 90 mm is thicker than half of the section's 168.3 mm"));
  EXPECT_THAT(complaints_about_spreader("pipe: [168.3 mm, 8 mm]", ""),
              HasSubstr("has 0 shapes, and one is due"));
}

TEST(LiftCaseErrors, FramesHaveOtherEyesThanBars) {
  const std::string frame = "  B1:\n    length: 4 m\n    width: 2 m\n";
  EXPECT_THAT(complaints_about_spreader("  B1:\n    length: 4 m\n", frame),
              HasSubstr("\"B1.upper_a\", which is no eye of spreader B1\n    its eyes are "
                        "B1.upper_1, B1.upper_2, B1.upper_3, B1.upper_4, B1.lower_1"));
  EXPECT_THAT(complaints_about_spreader(
                  "    length: 4 m\n    section:",
                  "    length: 4 m\n    cross_section: {pipe: [168.3 mm, 8 mm]}\n    section:"),
              HasSubstr("spreader B1 has a cross_section and no width\n    a frame has a width"));
  EXPECT_THAT(
      complaints_about_spreader("    length: 4 m\n    section:",
                                "    length: 4 m\n    width: 2 m\n    cross_section: {pipe: "
                                "[168.3 mm, 2 mm]}\n    section:"),
      HasSubstr("the wall of spreader B1 is too thin"));
}

TEST(LiftCaseErrors, SpreaderWithAnothersName) {
  EXPECT_THAT(complaints_about_spreader("  B1:\n",
                                        "  load: {length: 2 m, section: {pipe: [100 mm, "
                                        "5 mm]}, yield_stress: 235 MPa}\n  B1:\n"),
              HasSubstr("a spreader cannot be named \"load\""));
}

// From rest to rest over 2 m at 0.1 m/s, 0.1 m/s2, 0.2 m/s3: 2/0.1 + 0.1/0.1 + 0.1/0.2 = 21.5 s
// where the acceleration limit is reached; here sqrt(0.1/0.2) = 0.707 s > 0.5 s, so it is.
TEST(LiftCaseErrors, OperationThatOverlapsItself) {
  EXPECT_EQ(
      complaints_about_case("by: -2 m}",
                            "by: -2 m}\n      - {drives: [C1.left], by: 1 m, delay: 10 s}"),
      "case.yaml:16:19: error: the operation overlaps itself: C1.left would begin this move at "
      "15 s, but its move in line 15 lasts until 26.5 s\n"
      "    give the move a delay of at least 21.500 s, or a stage of its own\n1 error\n");
  EXPECT_EQ(complaints_about_case("{drives: [C1.travel], by: 10 m, speed: 15 m/min}",
                                  "{drives: [C1.travel, C1.traverse], by: 4 m}"),
            "case.yaml:19:19: error: the operation overlaps itself: C1.traverse follows C1.travel "
            "and has a move of its own in line 18\n1 error\n");
}

TEST(LiftCaseErrors, DriveThatDoesNotExist) {
  EXPECT_EQ(
      complaints_about_case("drives: [C1.travel]", "drives: [C1.travle]"),
      "case.yaml:18:19: error: stage \"carry\" moves \"C1.travle\", which is no drive or winch "
      "of the case\n"
      "    its drives and winches are C1.travel, C1.traverse, C1.left, C1.right; did you mean "
      "\"C1.travel\"?\n"
      "1 error\n");
  EXPECT_EQ(complaints_about_case("follows: C1.travel", "follows: C1.left"),
            "case.yaml:19:42: error: C1.traverse follows C1.left, which does not move in stage "
            "\"carry\"\n"
            "1 error\n");
}

TEST(LiftCaseErrors, MoveBeyondTheLimitsOfItsDrive) {
  EXPECT_EQ(complaints_about_case("speed: 15 m/min", "speed: 45 m/min"),
            "case.yaml:18:48: error: speed 45 m/min is more than C1.travel can do\n"
            "    its largest speed is 30 m/min\n"
            "1 error\n");
  EXPECT_EQ(complaints_about_case("speed: 15 m/min", "duration: 10 s").substr(0, 47),
            "case.yaml:18:51: error: C1.travel: a move over ");
  EXPECT_EQ(complaints_about_case("by: 10 m", "by: 10 deg"),
            "case.yaml:18:35: error: C1.travel moves by a length, but the move goes by an angle\n"
            "1 error\n");
}

TEST(LiftCaseErrors, FollowerThatCannotFollow) {
  EXPECT_EQ(complaints_about_case("[10 m, 2 m]]", "[8 m, 2 m]]"),
            "case.yaml:19:60: error: the table ends at 8 m, but C1.travel travels 10 m in stage "
            "\"carry\"\n1 error\n");
  EXPECT_EQ(complaints_about_case("[[0 m, 0 m], [5 m, 1 m]", "[[1 m, 0 m], [5 m, 1 m]"),
            "case.yaml:19:60: error: the table must begin with zero travel of both\n"
            "    for example [0 m, 0 m]\n1 error\n");
  EXPECT_EQ(complaints_about_case("[5 m, 1 m], [10 m, 2 m]", "[5 m, 3 m], [10 m, 6 m]"),
            "case.yaml:19:19: error: C1.traverse would go from 5 m to 11 m in stage \"carry\", "
            "outside its range\n"
            "    its range is 1 m to 9 m, and it starts the operation at 5 m\n1 error\n");
  // The spline's slope at its end is 3/2 * 3.9/5 = 1.17, the leader's acceleration 0.1 m/s^2.
  EXPECT_EQ(
      complaints_about_case("[5 m, 1 m], [10 m, 2 m]", "[5 m, 3.9 m], [10 m, 0 m]"),
      "case.yaml:19:19: error: C1.traverse would need an acceleration of 0.117 m/s^2 to follow "
      "C1.travel\n"
      "    its largest acceleration is 0.1 m/s^2; let the leader go slower or smooth the table"
      "\n1 error\n");
}

TEST(LiftCaseErrors, StartThatIsMissingOrImpossible) {
  EXPECT_EQ(complaints_about_case("{travel: 0 m, traverse: 5 m, left: 5 m, right: 5 m}",
                                  "{travel: 60 m, traverse: 5 deg, left: 5 m, rihgt: 5 m}"),
            "case.yaml:5:3: error: crane C1 gives no start for its hoist right\n"
            "    add right: 30 m to its start\n"
            "case.yaml:7:21: error: drive C1.travel starts at 60 m, outside its range\n"
            "    its range is -50 m to 50 m\n"
            "case.yaml:7:37: error: the start of drive C1.traverse is an angle; a length is due\n"
            "case.yaml:7:55: error: crane C1 has no drive or hoist \"rihgt\"\n"
            "    its drives and hoists are travel, traverse, left, right; did you mean \"right\"?\n"
            "4 errors\n");
}

TEST(LiftCaseErrors, HoistsThatCannotBeEqualised) {
  const auto complaints = [](const std::string& hoists) {
    return complaints_about_case("    model: gantry\n",
                                 "    model: gantry\n    equalised: " + hoists + "\n");
  };
  EXPECT_EQ(complaints("[left, rihgt]"),
            "case.yaml:7:23: error: crane C1 has no hoist \"rihgt\"\n"
            "    its hoists are left, right; did you mean \"right\"?\n1 error\n");
  EXPECT_EQ(complaints("[left, left]"),
            "case.yaml:7:16: error: hoist C1.left cannot be equalised with itself\n"
            "    two hoists are due: equalised: [left, right]\n1 error\n");
  EXPECT_EQ(complaints("[left, right]"),
            "case.yaml:7:16: error: hoists left and right of crane C1 have different tackles\n"
            "    one rope runs through both where they are equalised, so both name the same rope\n"
            "1 error\n");
}

// The sample's left hook block with other keys, and where R1 begins.
std::string complaints_about_hook(const std::string& block, const std::string& from,
                                  const std::string& crane_lines = "") {
  SampleLift lift;
  lift.crane = with(lift.crane, "{mass: 500 kg, wind_area: 1 m^2}", block);
  lift.lift_case = with(lift.lift_case, "R1: {from: C1.left,", "R1: {from: " + from + ",");
  lift.lift_case = with(lift.lift_case, "    model: gantry\n", "    model: gantry\n" + crane_lines);
  return complaints_about(lift);
}

TEST(LiftCaseErrors, HooksWithoutTheirHorns) {
  const std::string turning =
      "{mass: 500 kg, turning: {falls_apart: 1 m, radius_of_gyration: 0.4 m, horns: 0.5 m}}";
  EXPECT_EQ(complaints_about_hook(turning, "C1.left.b"), "");
  EXPECT_EQ(complaints_about_hook("{mass: 500 kg}", "C1.left.a"),
            "case.yaml:9:14: error: rope R1 begins at \"C1.left.a\", but hook C1.left has no "
            "horns\n"
            "    it has some with turning: {horns: 0.4 m, ...} in the hook_block of the crane's "
            "model; without them slings begin at C1.left\n1 error\n");
  EXPECT_EQ(complaints_about_hook(turning, "C1.left.c"),
            "case.yaml:9:14: error: rope R1 begins at \"C1.left.c\", which is no horn of hook "
            "C1.left\n"
            "    its horns are C1.left.a, C1.left.b; did you mean \"C1.left.a\"?\n1 error\n");
  EXPECT_THAT(complaints_about_hook(turning, "C1.left", "    equalised: [left, right]\n"),
              HasSubstr("the hook block of hoist C1.left turns, and is equalised"));
}

TEST(LiftCaseErrors, HooksHeavierThanTheirBlocks) {
  EXPECT_THAT(
      complaints_about_hook("{mass: 500 kg, turning: {falls_apart: 1 m, radius_of_gyration: 0.4 m, "
                            "bearing: {hook_mass: 600 kg, radius_of_gyration: 0.2 m}}}",
                            "C1.left"),
      HasSubstr("error: the hook weighs 600 kg, and its block with it 500 kg\n    hook_mass is a "
                "part of the block's mass"));
}

TEST(LiftCaseErrors, WeightOfRopesThatHaveNone) {
  const auto complaints = [](const std::string& lines, const std::string& rope_lines) {
    SampleLift lift;
    lift.rope += rope_lines;
    lift.lift_case = with(lift.lift_case, "settle: 10 s\n", "settle: 10 s\n" + lines);
    return complaints_about(lift);
  };
  EXPECT_EQ(complaints("rope_weight: true\n", "mass: 50 kg/m\n"), "");
  EXPECT_EQ(complaints("rope_weight: false\n", ""), "");
  EXPECT_THAT(complaints("rope_weight: true\n", ""),
              HasSubstr("error: no rope has a mass by which it would hang\n    add mass to the "
                        "models of slings and tackles that run from point to point"));
  EXPECT_THAT(complaints("rope_weight: true\ndynamics: {flexibility: static}\n", "mass: 50 kg/m\n"),
              HasSubstr("error: ropes hang by their weight, and the block is flexible"));
}

TEST(LiftCaseErrors, BendsThatCannotBe) {
  const auto complaints = [](const std::string& bend, const std::string& rope_lines) {
    SampleLift lift;
    lift.rope += rope_lines;
    lift.lift_case =
        with(lift.lift_case, "R2: {from: C1.right, to: L2, model: ropes/tackle,",
             "R2: {from: C1.right, to: L2, bend_diameter: " + bend + ", model: ropes/tackle,");
    return complaints_about(lift);
  };
  EXPECT_EQ(complaints("300 mm", "diameter: 40 mm\n"), "");
  EXPECT_EQ(complaints("300 mm", ""),
            "case.yaml:10:47: error: the model of rope R2 has no diameter, which its bend diameter "
            "is held against\n    add diameter to the rope's model\n1 error\n");
  EXPECT_EQ(complaints("30 mm", "diameter: 40 mm\n"),
            "case.yaml:10:47: error: rope R2 of 0.04 m is bent round 0.03 m\n"
            "    a rope is not bent round less than its own diameter\n1 error\n");
}

// A mistake in one table hushes what another lacks no more; what a table lacks because it could not
// be read is not said once more.
TEST(LiftCaseErrors, OneMistakeDoesNotHushAnother) {
  const std::string other = "settle: 10 m\n";
  const std::string faults =
      complaints_about_case("settle: 10 s\n", other + "faults: [{at: 5 s}]\n");
  EXPECT_THAT(faults, HasSubstr("the fault says not what goes wrong"));
  EXPECT_THAT(faults, ::testing::EndsWith("2 errors\n"));
  EXPECT_THAT(
      complaints_about_case("settle: 10 s\n", "settle: 10 s\nfaults: [{at: 5 s, parts: {}}]\n"),
      ::testing::EndsWith("\n1 error\n"));

  const std::string modes =
      complaints_about_case("settle: 10 s\n", other + "dynamics: {elastic_modes: 5}\n");
  EXPECT_THAT(modes, HasSubstr("the block has no natural modes"));
  EXPECT_THAT(modes, ::testing::EndsWith("2 errors\n"));
  EXPECT_THAT(
      complaints_about_case("settle: 10 s\n",
                            "settle: 10 s\ndynamics: {flexibility: mdal, elastic_modes: 5}\n"),
      ::testing::EndsWith("\n1 error\n"));

  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "settle: 10 s\n", other);
  lift.rope = with(lift.rope, "axial_stiffness: 200 MN\n", "");
  EXPECT_THAT(complaints_about(lift), HasSubstr("neither axial_stiffness nor tension_curve"));
}

// A value whose parameter has been complained of is not missed.
TEST(LiftCaseErrors, ParameterThatCannotBeReadIsToldOnce) {
  SampleLift lift;
  lift.crane = with(lift.crane, "bodies:\n", "parameters: {stiffness: 200 MNN}\nbodies:\n");
  lift.crane = with(lift.crane, "axial_stiffness: 200 MN", "axial_stiffness: = stiffness");
  const std::string complaints = complaints_about(lift);
  EXPECT_THAT(complaints, HasSubstr("200 MNN"));
  EXPECT_THAT(complaints, ::testing::EndsWith("1 error\n"));
}

TEST(LiftCaseErrors, FaultsThatCannotBe) {
  const auto complaints = [](const std::string& faults) {
    return complaints_about_case("settle: 10 s\n", "settle: 10 s\nfaults:\n  - " + faults + "\n");
  };
  EXPECT_EQ(complaints("{at: 5 s}"),
            "case.yaml:22:5: error: the fault says not what goes wrong\n"
            "    give parts, ropes that break, stops, drives that come to a stand, or runs_away, "
            "winches that pay out\n1 error\n");
  EXPECT_EQ(
      complaints("{at: 5 s, parts: [R11], stops: [C1.trvel]}"),
      "case.yaml:22:23: error: the fault parts \"R11\", which the case does not have\n"
      "    its ropes and hoists are R1, R2, C1.left, C1.right; did you mean \"R1\"?\n"
      "case.yaml:22:37: error: the fault stops \"C1.trvel\", which the case does not have\n"
      "    its drives and winches are C1.travel, C1.traverse, C1.left, C1.right, all; did you "
      "mean \"C1.travel\"?\n2 errors\n");
  EXPECT_THAT(complaints("{at: 5000 s, parts: [R1]}"),
              ::testing::HasSubstr("after the end of the operation"));
  // How long an operation lasts is not known while one of its moves is wrong.
  EXPECT_THAT(complaints_about_case("settle: 10 s\n",
                                    "  - stage: wrong\n    moves:\n      - {drives: [C1.lift], by: "
                                    "1 m}\nsettle: 10 s\nfaults:\n  - {at: 5000 s, parts: [R1]}\n"),
              ::testing::Not(::testing::HasSubstr("after the end of the operation")));
  EXPECT_THAT(complaints("{at: 5 s, stops: [all, C1.travel]}"),
              ::testing::HasSubstr("\"C1.travel\" stops twice"));
}

TEST(LiftCaseErrors, NothingHoldsTheLoad) {
  EXPECT_EQ(complaints_about_case(
                "ropes:\n  R1: {from: C1.left, to: L1, model: ropes/tackle, length: 2 m}\n"
                "  R2: {from: C1.right, to: L2, model",
                "ropes:\n  R1: {from: C1.left, to: C1.right, model: ropes/tackle, length: 2 m}\n"
                "  R2: {from: C1.right, to: {body: world}, model"),
            "case.yaml:3:15: error: no rope holds the load\n"
            "    a rope that ends at one of its lugs does, or goes round its edges\n1 error\n");
}

TEST(LiftCaseErrors, NothingHangsWithoutGravity) {
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "gravity: 9.81 m/s^2", "gravity: 0 m/s^2");
  EXPECT_NE(complaints_about(lift).find("case.yaml:2:10: error: gravity"), std::string::npos);
}

TEST(LiftCaseErrors, CaseWithoutAnything) {
  SampleLift lift;
  lift.lift_case = "title: nothing\n";
  EXPECT_EQ(complaints_about(lift),
            "case.yaml:1:1: error: lift case lacks the key \"case\"\n"
            "    a name is due: its name\n"
            "case.yaml:1:1: error: lift case lacks the key \"load\"\n"
            "    the keys of a load are due: the block or vessel that is lifted\n"
            "case.yaml:1:1: error: the lift case lacks the key \"cranes\"\n"
            "    a case has cranes, ropes and operation, or a load_table\n"
            "case.yaml:1:1: error: the lift case lacks the key \"ropes\"\n"
            "    a case has cranes, ropes and operation, or a load_table\n"
            "case.yaml:1:1: error: the lift case lacks the key \"operation\"\n"
            "    a case has cranes, ropes and operation, or a load_table\n"
            "5 errors\n");
}

// What hangs on the load or on cranes is not complained of once more.
TEST(LiftCaseErrors, LoadOrCranesThatCannotBeRead) {
  SampleLift lift;
  lift.lift_case = R"(case: nothing
cranes: C1
ropes:
  R1:
    {from: C1.main, to: L1, length: 3 m,
     model: {axial_stiffness: 10 MN, damping_time: 1 ms, breaking_load: 1 MN}}
operation:
  - stage: hoist
    moves:
      - {drives: [C1.main], by: -1 m}
)";
  EXPECT_EQ(complaints_about(lift),
            "case.yaml:1:1: error: lift case lacks the key \"load\"\n"
            "    the keys of a load are due: the block or vessel that is lifted\n"
            "case.yaml:2:9: error: cranes is \"C1\"; names, each with the keys of a crane are due\n"
            "2 errors\n");
}

TEST(LiftCaseErrors, FolderWithoutACase) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  ModelLibrary library({});
  std::filesystem::create_directory("empty");
  EXPECT_FALSE(read_lift_case("empty", library, diagnostics));
  EXPECT_EQ(diagnostics.to_text(),
            "empty: error: this folder has no case.yaml\n"
            "    a lift case is a file, or a folder with the file case.yaml in it\n1 error\n");
}

// Whatever line is lost or cut short, the reader complains or takes it; it never breaks.
TEST(LiftCaseErrors, SurvivesAnyLostLine) {
  const auto without_line = [](const std::string& text, std::size_t line, bool cut) {
    std::string result;
    std::size_t begin = 0;
    for (std::size_t i = 0; begin < text.size(); ++i) {
      const std::size_t end = text.find('\n', begin) + 1;
      const std::string whole = text.substr(begin, end - begin);
      if (i != line) result += whole;
      if (i == line && cut) result += whole.substr(0, whole.size() / 2) + "\n";
      begin = end;
    }
    return result;
  };
  for (std::size_t line = 0; line < 35; ++line) {
    for (const bool cut : {false, true}) {
      SampleLift lift;
      lift.lift_case = without_line(test::sample_case, line, cut);
      complaints_about(lift);
      lift = SampleLift();
      lift.crane = without_line(test::sample_crane, line, cut);
      complaints_about(lift);
      lift = SampleLift();
      lift.block = without_line(test::sample_block, line, cut);
      complaints_about(lift);
    }
  }
}

}  // namespace
}  // namespace blocklift::pipeline
