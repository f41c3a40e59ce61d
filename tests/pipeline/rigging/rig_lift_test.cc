// Whole lifts whose tensions at rest are known by hand.

#include "pipeline/rigging/rig_lift.h"

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/rigging/rigged_case.h"
#include "tests/pipeline/rigging/sample_stock.h"
#include "tests/pipeline/spreader_lift.h"

namespace blocklift::pipeline {
namespace {

using test::SampleLift;
using test::shackle_file;
using test::sling_file;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

constexpr double half_weight = 10e3 * 9.81 / 2;  // of the plate, N

void ignore_progress(const std::string&, double, const std::string&) {}

/// The sample lift: a plate of 10 t hangs level from two plumb slings; settings of the run are
/// rough.
std::string quick_case() {
  std::string text =
      with(test::sample_case, "settle: 10 s", "settle: 2 s\nchecks: {rope_safety_factor: 5}");
  return text.substr(0, text.find("compare:"));
}

RiggedLift rig_from(const TemporaryFolder& folder, const std::string& lift_case,
                    const std::string& slings) {
  SampleLift lift;
  lift.lift_case = lift_case;
  lift.write(folder);
  folder.write("loft/slings.yaml", slings);
  folder.write("loft/shackles.yaml", shackle_file({2, 4, 7}));
  ModelLibrary library({BLOCKLIFT_MODELS});
  Diagnostics diagnostics;
  Stock stock = read_stock({"loft"}, {}, library, diagnostics);
  auto read = read_lift_case("case.yaml", library, diagnostics);
  if (!read) throw InputError(diagnostics);
  return rig_lift(std::move(*read), std::move(stock), ignore_progress);
}

RiggedLift rig_sample(const TemporaryFolder& folder, const std::string& lift_case,
                      const std::vector<double>& breaking_loads) {
  return rig_from(folder, lift_case, sling_file(breaking_loads));
}

// Slings that lean by 2 m in 1.5 m over the bar's eyes carry 5 / 3 of those below them.
TEST(RigLiftTest, ChoosesSlingsAboveASpreaderToo) {
  const TemporaryFolder folder;
  const RiggedLift rigged =
      rig_sample(folder, test::spreader_lift().lift_case, {200, 245, 270, 460, 600});
  EXPECT_TRUE(rigged.pass());
  ASSERT_EQ(rigged.slings.size(), 4U);
  const std::vector<double> chosen = {460e3, 460e3, 270e3, 270e3};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_DOUBLE_EQ(rigged.stock.slings[rigged.slings[i].chosen.index].sling.rope.breaking_load,
                     chosen[i]);
  ASSERT_EQ(rigged.shackles.size(), 2U);
  EXPECT_EQ(rigged.shackles[0].lug, "L1");
}

// The plate and a bar of 126 kg on the hook ask for a link of more than 10.1 t; a lighter pipe of
// the bar's length is strong enough, a longer one is no choice, and the case is written with both.
TEST(RigLiftTest, ChoosesMasterLinkAndSpreader) {
  const TemporaryFolder folder;
  folder.write(
      "loft/links.yaml",
      "kind: rigging\ntitle: t\nsource: s\nrule: {name: own, safety_factor: 5, formula: "
      "f}\nmaster_links:\n"
      "  m8: {working_load: 8 t, breaking_load: 40 t, bar: 29 mm, inside_length: 203 mm, "
      "inside_width: 116 mm, mass: 3.26 kg}\n"
      "  m12: {working_load: 12.5 t, breaking_load: 62.5 t, bar: 37 mm, inside_length: 259 "
      "mm, inside_width: 148 mm, mass: 6.78 kg}\n");
  folder.write(
      "loft/bars.yaml",
      "kind: rigging\ntitle: t\nsource: s\nrule: {name: own, safety_factor: 2, formula: f}\n"
      "spreaders:\n"
      "  weak: {bar: {length: 4 m, section: {pipe: [60.3 mm, 4 mm]}, yield_stress: 355 MPa}, "
      "working_load: 1 t, sling_angle: 45 deg}\n"
      "  heavy: {bar: {length: 4 m, section: {pipe: [168.3 mm, 8 mm]}, yield_stress: 355 MPa}, "
      "working_load: 60 t, sling_angle: 45 deg}\n"
      "  light: {bar: {length: 4 m, section: {pipe: [139.7 mm, 6.3 mm]}, yield_stress: 355 MPa, "
      "buckling_curve: a}, working_load: 30 t, sling_angle: 45 deg}\n"
      "  long: {bar: {length: 5 m, section: {pipe: [139.7 mm, 5 mm]}, yield_stress: 355 MPa}, "
      "working_load: 12 t, sling_angle: 45 deg}\n");
  std::string lift_case = test::spreader_lift().lift_case;
  lift_case += "standard: {rules: queensland-tandem}\n";
  const RiggedLift rigged = rig_sample(folder, lift_case, {200, 245, 270, 460, 600});
  EXPECT_TRUE(rigged.pass());
  ASSERT_EQ(rigged.master_links.size(), 1U);
  const ChosenMasterLink& link = rigged.master_links[0];
  EXPECT_EQ(link.demand.hook, "C1.left");
  EXPECT_EQ(link.demand.legs, 2);
  EXPECT_EQ(rigged.stock.master_links[link.index].name(), "m12");
  ASSERT_EQ(rigged.spreaders.size(), 1U);
  EXPECT_EQ(rigged.stock.spreaders[rigged.spreaders[0].index].name(), "light");
  write_rigged_case(rigged, "rigged.yaml");
  const LiftCase again = read_lift_case("rigged.yaml");
  const given::Spreader& bar = *again.find_spreader("B1");
  EXPECT_NEAR((*bar.section.value.pipe)[0], 0.1397, 1e-12);
  EXPECT_EQ(bar.curve, structure::BucklingCurve::a);
  EXPECT_EQ(bar.upper_eye, 0);
  ASSERT_EQ(again.standard->master_links.size(), 1U);
  EXPECT_NEAR(again.standard->master_links[0].working_load, 12.5 * 9806.65, 1e-3);
  EXPECT_NEAR(again.standard->master_links[0].mass, 6.78, 1e-9);
}

// A frame of the case's length and width is chosen; bars and frames of another width are none.
TEST(RigLiftTest, ChoosesFramesOfTheirSize) {
  const TemporaryFolder folder;
  folder.write(
      "loft/frames.yaml",
      "kind: rigging\ntitle: t\nsource: s\nrule: {name: own, safety_factor: 2, formula: f}\n"
      "spreaders:\n"
      "  bar: {bar: {length: 4 m, section: {pipe: [139.7 mm, 6.3 mm]}, yield_stress: 355 MPa}, "
      "working_load: 12 t, sling_angle: 45 deg}\n"
      "  wide: {bar: {length: 4 m, width: 3 m, section: {pipe: [114.3 mm, 6.3 mm]}, yield_stress: "
      "355 MPa}, working_load: 12 t, sling_angle: 45 deg}\n"
      "  fits: {bar: {length: 4 m, width: 2 m, section: {pipe: [139.7 mm, 6.3 mm]}, yield_stress: "
      "355 MPa, cross_section: {box: [120 mm, 80 mm, 6 mm]}}, working_load: 12 t, sling_angle: "
      "45 deg}\n");
  const RiggedLift rigged =
      rig_sample(folder, test::frame_lift().lift_case, {200, 245, 270, 460, 600});
  EXPECT_TRUE(rigged.pass());
  ASSERT_EQ(rigged.spreaders.size(), 1U);
  EXPECT_EQ(rigged.stock.spreaders[rigged.spreaders[0].index].name(), "fits");
  write_rigged_case(rigged, "rigged.yaml");
  const LiftCase again = read_lift_case("rigged.yaml");
  const given::Spreader& frame = *again.find_spreader("B1");
  EXPECT_NEAR(*frame.width, 2, 1e-12);
  EXPECT_NEAR((*frame.section.value.pipe)[0], 0.1397, 1e-12);
  ASSERT_TRUE(frame.cross_section);
  EXPECT_NEAR((*frame.cross_section->value.box)[0], 0.12, 1e-12);
}

// Half the weight, 49.05 kN, asks for 245.25 kN and 5.0 t; the motion adds a few per cent.
TEST(RigLiftTest, ChoosesForHalfTheWeightEach) {
  const TemporaryFolder folder;
  const RiggedLift rigged = rig_sample(folder, quick_case(), {200, 245, 270, 400});
  EXPECT_TRUE(rigged.pass());
  ASSERT_EQ(rigged.slings.size(), 2U);
  for (const RiggedSling& sling : rigged.slings) {
    EXPECT_NEAR(sling.demand.at_rest, half_weight, 1e-3 * half_weight);
    EXPECT_GT(sling.demand.in_motion, sling.demand.at_rest);
    EXPECT_EQ(rigged.stock.slings[sling.chosen.index].name(), "s270");
    EXPECT_NEAR(governing_check(sling.chosen.checks)->utilisation, sling.demand.in_motion / 54e3,
                1e-12);
  }
  ASSERT_EQ(rigged.shackles.size(), 2U);
  EXPECT_EQ(rigged.stock.shackles[*rigged.shackles[0].index].name(), "b7");
  EXPECT_EQ(rigged.lift_case.find_rope("R1")->rope.breaking_load, 270e3);
}

// Two slings from hook to lug side by side share half the weight by their stiffness. The case's own
// are 200 and 20 MN, which asks for 260 and 60 kN; those share it 260 to 60, which asks for 225 and
// 60, and they 225 to 60: 38.72 and 10.33 kN, which stands.
TEST(RigLiftTest, RunsAgainUntilTheChoiceStands) {
  const TemporaryFolder folder;
  const RiggedLift rigged =
      rig_sample(folder,
                 with(quick_case(), "  R2: {from",
                      "  R3: {from: C1.left, to: L1, length: 2 m, model: {axial_stiffness: 20 MN, "
                      "breaking_load: 1000 kN}}\n  R2: {from"),
                 {60, 150, 225, 260});
  EXPECT_TRUE(rigged.pass());
  EXPECT_EQ(rigged.settled.runs, 3);
  ASSERT_EQ(rigged.slings.size(), 3U);
  const auto& [first, second, other] =
      std::tie(rigged.slings[0], rigged.slings[1], rigged.slings[2]);
  EXPECT_EQ(rigged.stock.slings[first.chosen.index].name(), "s225");
  EXPECT_EQ(rigged.stock.slings[second.chosen.index].name(), "s60");
  EXPECT_EQ(rigged.stock.slings[other.chosen.index].name(), "s260");
  EXPECT_NEAR(first.demand.at_rest, half_weight * 225 / 285, 2e-3 * half_weight);
  EXPECT_NEAR(second.demand.at_rest, half_weight * 60 / 285, 2e-3 * half_weight);
  // Both end at L1: its one shackle is for the sum of their loads, 5.0 t.
  ASSERT_EQ(rigged.shackles.size(), 2U);
  EXPECT_EQ(rigged.shackles[0].lug, "L1");
  EXPECT_EQ(rigged.stock.shackles[*rigged.shackles[0].index].name(), "b7");
}

TEST(RigLiftTest, FailsWhereNoStockIsStrongEnough) {
  const TemporaryFolder folder;
  const RiggedLift rigged = rig_sample(folder, quick_case(), {100, 200});
  EXPECT_TRUE(rigged.settled.stands);
  EXPECT_FALSE(rigged.pass());
}

TEST(RigLiftTest, WritesACaseThatReadsAsItWasChosen) {
  const TemporaryFolder folder;
  const std::string standard =
      "standard: {rules: nd-0027, weight_class: weighed, setting: onshore, skew: determinate, "
      "wear: inspected, shackles: {L1: &one {working_load: 1 t, breaking_load: 5 t}, L2: *one}}\n";
  RiggedLift rigged = rig_sample(
      folder,
      with(with(quick_case(), "to: L1, model: ropes/tackle",
                "to: L1, model: {axial_stiffness: 200 MN, breaking_load: 1000 kN, material: "
                "steel, termination: resin_socket}"),
           "to: L2, model: ropes/tackle",
           "to: L2, model: {axial_stiffness: 200 MN, breaking_load: 1000 kN, material: steel, "
           "termination: resin_socket}") +
          standard,
      {200, 245, 270, 400});
  ASSERT_TRUE(rigged.pass());
  rigged.shackles[1].index = 0;  // unlike the first: the two share an anchor in the file
  write_rigged_case(rigged, "rigged.yaml");
  ModelLibrary library({BLOCKLIFT_MODELS});
  Diagnostics diagnostics;
  const auto again = read_lift_case("rigged.yaml", library, diagnostics);
  ASSERT_EQ(diagnostics.to_text(), "");
  const RopeModel& rope = again->find_rope("R2")->rope;
  const RopeModel& chosen = rigged.stock.slings[rigged.slings[1].chosen.index].sling.rope;
  EXPECT_DOUBLE_EQ(rope.breaking_load, chosen.breaking_load);
  EXPECT_DOUBLE_EQ(rope.axial_stiffness, chosen.axial_stiffness);
  EXPECT_DOUBLE_EQ(*rope.mass_per_length, *chosen.mass_per_length);
  EXPECT_EQ(rope.termination->value, "resin_socket");
  ASSERT_EQ(again->standard->shackles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(again->standard->shackles[i].working_load,
                rigged.stock.shackles[*rigged.shackles[i].index].shackle.working_load, 1e-3);

  // Beside other models it cannot be read, and is not written.
  std::filesystem::create_directory("elsewhere");
  EXPECT_THROW(write_rigged_case(rigged, "elsewhere/rigged.yaml"), InputError);
  EXPECT_TRUE(std::filesystem::is_empty("elsewhere"));
}

TEST(RigLiftTest, WritesTheCurvesOfItsSlings) {
  const TemporaryFolder folder;
  const RiggedLift rigged =
      rig_from(folder, quick_case(),
               with(sling_file({270}), "axial_stiffness: 27000 kN",
                    "tension_curve: [[0 %, 0 %], [1.5 %, 20 %], [3 %, 100 %]]"));
  ASSERT_TRUE(rigged.pass());
  write_rigged_case(rigged, "rigged.yaml");
  const LiftCase again = read_lift_case("rigged.yaml");
  const std::vector<RopeModel::CurvePoint> curve = again.find_rope("R1")->rope.curve();
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_NEAR(curve[1].strain, 0.015, 1e-12);
  EXPECT_NEAR(curve[1].tension, 54e3, 1e-6);
  EXPECT_NEAR(curve[2].tension, 270e3, 1e-6);
}

TEST(RigLiftTest, RefusesACaseWithoutSlings) {
  const TemporaryFolder folder;
  try {
    rig_sample(folder, test::sample_load_table_case, {100});
    FAIL() << "there is nothing to choose";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the case has no slings to choose"));
  }
}

}  // namespace
}  // namespace blocklift::pipeline
