// What is said of cases whose crane's or block's parts do not fit together.
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

TEST(LiftCaseErrors, CraneWhosePartsDoNotFit) {
  SampleLift lift;
  lift.crane = with(lift.crane, "child: trolley", "child: troley");
  lift.crane =
      with(lift.crane, "{joint: travel, speed: 30 m/min", "{joint: travel, speed: 3 deg/s");
  lift.crane = with(lift.crane, "rope: ropes/tackle", "rope: ropes/takle");
  EXPECT_EQ(complaints_about(lift),
            "gantry/crane.yaml:10:3: error: body trolley is the child of no joints\n"
            "    each body is the child of exactly one joint\n"
            "gantry/crane.yaml:13:54: error: joint traverse joins body \"troley\", which the crane "
            "does not have\n"
            "    its bodies are gantry, trolley; did you mean \"trolley\"?\n"
            "gantry/crane.yaml:15:34: error: speed of drive travel is an angular speed, but joint "
            "travel slides\n"
            "gantry/crane.yaml:22:11: error: there is no rope model \"ropes/takle\"\n"
            "    the rope models are ropes/tackle; did you mean \"ropes/tackle\"?\n"
            "    looked for in gantry, .\n"
            "4 errors\n");
}

TEST(LiftCaseErrors, BlockWhosePartsDoNotFit) {
  SampleLift lift;
  lift.block = with(lift.block, "spacing: 2 m", "spacing: 1.5 m");
  lift.block = with(lift.block, "pad: left_pad", "pad: lft_pad");
  lift.block = with(lift.block, "pin: [4 m, 0 m, 1.2 m]", "pin: [4 m, 0 m, 1.5 m]");
  lift.block =
      with(lift.block, "x: [0 m, 4 m], y: [-1 m, 1 m], thickness", "x: [4 m, 0 m], thickness");
  EXPECT_EQ(
      complaints_about(lift),
      "plate.yaml:7:11: error: plate bottom lacks the key \"y\"\n"
      "    it is the extent along y: [lower end, upper end]\n"
      "plate.yaml:7:35: error: extent x ends at 0 m, where it begins at 4 m\n"
      "    an extent is [lower end, upper end]\n"
      "plate.yaml:8:25: error: a spacing of 1.5 m does not divide the 4 m from 0 m to 4 m\n"
      "plate.yaml:15:13: error: lug L1 names pad \"lft_pad\", which the block does not have\n"
      "    its pads are left_pad, right_pad; did you mean \"left_pad\"?\n"
      "plate.yaml:16:104: error: the pin of lug L2 is at z = 1.5 m, outside the lug plate, which "
      "reaches from 1 m to 1.4 m\n"
      "5 errors\n");
}

// One as thick as its plate is where a lug stands on plain plating.
TEST(LiftCaseErrors, PadThinnerThanItsPlate) {
  const std::string pad =
      "left_pad: {plate: webs, normal: x, at: 0 m, y: [-0.5 m, 0.5 m], z: [0.5 m, 1 m], "
      "thickness: ";
  SampleLift lift;
  lift.block = with(lift.block, pad + "30 mm", pad + "10 mm");
  EXPECT_EQ(complaints_about(lift), "");
  lift.block = with(lift.block, pad + "10 mm", pad + "9 mm");
  EXPECT_THAT(complaints_about(lift),
              HasSubstr("pad left_pad is 0.009 m thick, its plate webs already 0.01 m"));
}

TEST(LiftCaseErrors, PadeyesThatCannotBeMade) {
  SampleLift lift;
  lift.block = with(lift.block, "lugs:\n",
                    "padeyes:\n"
                    "  eye: {radius: 250 mm, thickness: 50 mm, hole: 60 mm, pin: 70 mm}\n"
                    "  good: {radius: 150 mm, thickness: 40 mm, hole: 60 mm, pin: 57 mm, "
                    "cheek_radius: 250 mm, cheek_thickness: 10 mm, cheek_weld: 8 mm}\n"
                    "  bare: {radius: 150 mm, thickness: 40 mm, hole: 60 mm, pin: 57 mm, "
                    "cheek_radius: 100 mm, cheek_thickness: 10 mm}\n"
                    "lugs:\n");
  lift.block = with(lift.block, "pin: [0 m, 0 m, 1.2 m]", "pin: [0 m, 0 m, 1.2 m], padeye: eye");
  lift.block = with(lift.block, "pin: [4 m, 0 m, 1.2 m]", "pin: [4 m, 0 m, 1.2 m], padeye: god");
  const std::string found = complaints_about(lift);
  for (const char* expected :
       {"padeye eye: the pin, 70 mm, is larger than its hole, 60 mm",
        "the main plate, 250 mm about the hole, reaches beyond the lug, which ends 200 mm from the "
        "pin",
        "the main plate is 50 mm thick, the lug in the block 40 mm",
        "plate.yaml:20:131: error: lug L2 names padeye \"god\", which the block does not have",
        "did you mean \"good\"?",
        "plate.yaml:17:9: error: padeye bare has cheek plates without a weld"})
    EXPECT_NE(found.find(expected), std::string::npos) << expected << "\nnot in\n" << found;
  lift.block = with(lift.block, "padeye: god", "padeye: good");
  EXPECT_NE(complaints_about(lift).find("lug L2 cannot be made as padeye good: the cheek plates' "
                                        "radius, 250 mm, reaches beyond the main plate"),
            std::string::npos);
}

TEST(LiftCaseErrors, StiffenersAlongTheirPlatesNormal) {
  SampleLift lift;
  lift.block = with(lift.block, "thickness: 20 mm",
                    "thickness: 20 mm, stiffeners: {along: z, spacing: 0.5 m}");
  EXPECT_NE(complaints_about(lift).find("the stiffeners of plate bottom run along its normal"),
            std::string::npos);
}

TEST(LiftCaseErrors, BlockWithTwoPlatesInOnePlaceAndACutPad) {
  SampleLift lift;
  lift.block = with(lift.block, "openings:\n",
                    "  doubler: {normal: x, at: [2 m, 4 m], y: [0 m, 2 m], z: [0 m, 1 m], "
                    "thickness: 8 mm}\nopenings:\n");
  lift.block = with(lift.block, "at: 2 m, y: [-0.3 m, 0.3 m], z: [0.3 m, 0.7 m]",
                    "y: [-0.3 m, 0.3 m], z: [0.3 m, 0.7 m]");
  EXPECT_EQ(complaints_about(lift),
            "plate.yaml:9:3: error: plate doubler lies upon plate webs at x = 2 m\n"
            "    where a plate is thicker, divide it, or use a pad\n"
            "plate.yaml:11:3: error: opening hole cuts pad left_pad in plate webs at x = 0 m\n"
            "plate.yaml:11:3: error: opening hole cuts pad right_pad in plate webs at x = 4 m\n"
            "3 errors\n");
}

}  // namespace
}  // namespace blocklift::pipeline
