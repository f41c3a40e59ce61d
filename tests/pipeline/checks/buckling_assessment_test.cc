// Buckling of a block: what the checks and the summary say of it.
#include "pipeline/checks/buckling_assessment.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace blocklift::pipeline {
namespace {

BuckledBar bar_of(const std::string& name, const std::string& group, double plate_width,
                  double utilisation) {
  BuckledBar bar;
  bar.span.bar = name;
  bar.span.group = group;
  bar.span.p_BTo = {3, 0, 0};
  bar.span.plate_width = plate_width;
  bar.span.column = {.area = 1e-3,
                     .yield_stress = 355e6,
                     .length = 3,
                     .second_moments = {1e-6, 1e-6},
                     .section_moduli = {1e-5, 1e-5}};
  bar.worst.utilisation = utilisation;
  bar.worst.forces = {2e4, {100, 0}};
  bar.in_motion = true;
  bar.time = 12.5;
  return bar;
}

BucklingAssessment four_bars() {
  BucklingAssessment buckling;
  buckling.bar_factor = 1.5;
  buckling.unknown_rods = 2;
  buckling.bars = {
      bar_of("strut at x = 1 m", "struts", 0, 1.2), bar_of("strut at x = 2 m", "struts", 0, 0.8),
      bar_of("bulb at y = 1 m", "bulbs", 0.7, 0.6), bar_of("loose bulb", "bulbs", 0, 0.1)};
  return buckling;
}

// A line for each name of bars and for each of stiffeners: its worst.
TEST(BucklingAssessment, ChecksTheWorstOfEachName) {
  const std::vector<Check> checks = check_buckling(LiftCase{}, four_bars());
  ASSERT_EQ(checks.size(), 3U);
  EXPECT_EQ(checks[0].name, "buckling of bars in struts: compression with bending, times 1.5");
  EXPECT_FALSE(checks[0].pass);
  EXPECT_DOUBLE_EQ(checks[0].demand, 1.2);
  EXPECT_EQ(checks[0].time, 12.5);
  EXPECT_NE(checks[0].note.find("EN 1993-1-1, 6.3.1.1"), std::string::npos) << checks[0].note;
  EXPECT_EQ(checks[1].name, "buckling of stiffeners in bulbs: compression with bending, times 1.5");
  EXPECT_TRUE(checks[1].pass);
  EXPECT_NE(checks[1].note.find("with 700 mm of plate, EN 1993-1-5, 4.5.3"), std::string::npos)
      << checks[1].note;
  EXPECT_EQ(checks[2].name, "buckling of bars in bulbs: compression with bending, times 1.5");
}

// Tripping has a line of its own, of the span that is nearest to it, and rows in the summary.
TEST(BucklingAssessment, ChecksTripping) {
  BucklingAssessment buckling = four_bars();
  for (BuckledBar& bar : buckling.bars) bar.span.group = "bulbs";
  for (std::size_t b : {1U, 2U}) {
    BuckledBar& bar = buckling.bars[b];
    bar.span.tripping_stress = 300e6;
    bar.span.tripping_strength = 200e6;
    bar.span.column.length = 2.4;
    bar.span.tripping_length = b == 1 ? 2.4 : 1.2;
    bar.tripping = {b == 1 ? 0.4 : 1.1, 220e6, 0.5, 3};
    bar.tripping_time = 7.5;
  }
  const std::vector<Check> checks = check_buckling(LiftCase{}, buckling);
  ASSERT_EQ(checks.size(), 3U);
  const Check& check = checks.back();
  EXPECT_EQ(check.name, "tripping of stiffeners in bulbs: compression, times 1.5");
  EXPECT_DOUBLE_EQ(check.demand, 1.1);
  EXPECT_FALSE(check.pass);
  EXPECT_EQ(check.time, 7.5);
  EXPECT_NE(check.note.find("bulb at y = 1 m from"), std::string::npos) << check.note;
  EXPECT_NE(check.note.find("7.5.2: elastic 300 MPa, strength 200 MPa"), std::string::npos)
      << check.note;
  EXPECT_NE(check.note.find("tripping brackets every 1.20 m"), std::string::npos) << check.note;
  const nlohmann::ordered_json json = buckling_json(buckling);
  EXPECT_FALSE(json["bars"][0].contains("tripping_utilisation"));
  EXPECT_EQ(json["bars"][1]["tripping_length_m"], 2.4);
  EXPECT_EQ(json["bars"][2]["tripping_length_m"], 1.2);
  EXPECT_EQ(json["bars"][2]["tripping_utilisation"], 1.1);
  EXPECT_EQ(json["bars"][2]["tripping_strength_Pa"], 200e6);
}

TEST(BucklingAssessment, TheSummaryHasBarsAndRods) {
  const nlohmann::ordered_json json = buckling_json(four_bars());
  EXPECT_EQ(json["bars_looked_at"], 4);
  EXPECT_EQ(json["rods_without_second_moments"], 2);
  EXPECT_EQ(json["bar_factor"], 1.5);
  ASSERT_EQ(json["bars"].size(), 4U);
  EXPECT_EQ(json["bars"][2]["bar"], "bulb at y = 1 m");
  EXPECT_EQ(json["bars"][2]["plate_width_m"], 0.7);
  EXPECT_EQ(json["bars"][0]["compression_N"], 2e4);
  EXPECT_EQ(json["bars"][0]["state"], "dynamic");
  EXPECT_EQ(json["bars"][0]["time_s"], 12.5);
}

// Beams and webs divide panels where they stand. Only stiffeners that the mesh leaves out are told
// by their spacing: past a beam that an opening cuts, a panel would else count as divided.
TEST(BucklingAssessment, StiffenersOfTheMeshAreNotToldBySpacing) {
  BlockModel block;
  PlateModel plate;
  plate.name.value = "deck";
  plate.stiffeners = StiffenersModel{};
  plate.stiffeners->spacing = 0.7;
  block.plates.push_back(plate);
  plate.name.value = "bottom";
  plate.stiffeners->profile = structure::flat_bar(0.2, 0.01);
  block.plates.push_back(plate);
  plate.name.value = "sides";
  plate.stiffeners->are_plates = true;
  block.plates.push_back(plate);
  const std::vector<structure::PlateStiffening> stiffening = stiffening_beside_mesh(block);
  ASSERT_EQ(stiffening.size(), 1U);
  EXPECT_EQ(stiffening[0].group, "deck");
  EXPECT_EQ(stiffening[0].along, Vector3::UnitX());
  EXPECT_EQ(stiffening[0].spacing, 0.7);
}

// A block of plates alone has no word of bars.
TEST(BucklingAssessment, WithoutBarsNothingIsSaidOfThem) {
  const nlohmann::ordered_json json = buckling_json({});
  EXPECT_FALSE(json.contains("bars"));
  EXPECT_TRUE(check_buckling(LiftCase{}, {}).empty());
}

}  // namespace
}  // namespace blocklift::pipeline
