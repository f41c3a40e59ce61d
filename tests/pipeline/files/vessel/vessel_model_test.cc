#include "pipeline/files/vessel/vessel_model.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "pipeline/files/vessel/wetted_mesh.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

const std::string cube =
    "kind: vessel\n"
    "hull: {barge: {length: 5 m, breadth: 5 m, depth: 5 m}}\n"
    "panel_size: 1 m\n"
    "mass: 60 t\n"
    "centre_of_mass: [0 m, 0 m, 1 m]\n"
    "radii_of_gyration: [2 m, 2 m, 2 m]\n";

std::string complaint(const std::string& text) {
  const test::TemporaryFolder folder;
  folder.write("vessel.yaml", text);
  Diagnostics diagnostics;
  EXPECT_FALSE(read_vessel("vessel.yaml", diagnostics).has_value());
  return diagnostics.to_text();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// Of the folder that the file stands for, else of the file.
TEST(VesselModel, ComplaintsNameTheHull) {
  const test::TemporaryFolder folder;
  const std::string sunk = replaced(cube, "mass: 60 t", "mass: 600 t");
  for (const char* const file : {"cube.yaml", "cube/vessel.yaml"}) {
    folder.write(file, sunk);
    Diagnostics diagnostics;
    EXPECT_FALSE(read_vessel(file, diagnostics));
    EXPECT_THAT(diagnostics.to_text(), HasSubstr("hull \"cube\" would have to displace"));
  }
}

TEST(VesselModel, ReadsHullAndMass) {
  const test::TemporaryFolder folder;
  folder.write("vessel.yaml", cube);
  Diagnostics diagnostics;
  const std::optional<Vessel> vessel = read_vessel("vessel.yaml", diagnostics);
  ASSERT_TRUE(vessel.has_value()) << diagnostics.to_text();
  // Panels of 1 m or less, even in number along and across: the centre planes lie between them.
  EXPECT_EQ(vessel->hull.panel_count(), 2 * 6 * 6 + 4 * 5 * 6);
  EXPECT_NEAR(vessel->body().mass, 60e3, 1e-9);
}

// The wetted surface alone of a box 4 x 2 x 1 m, and with a lid in the water plane: both go on
// above the water as a closed hull.
TEST(VesselModel, AMeshThatEndsAtTheWaterGoesOnUpright) {
  const std::string wetted =
      "-2 -1 -1 -2 1 -1 2 1 -1 2 -1 -1\n"  // bottom
      "-2 -1 -1 2 -1 -1 2 -1 0 -2 -1 0\n"
      "2 -1 -1 2 1 -1 2 1 0 2 -1 0\n"
      "2 1 -1 -2 1 -1 -2 1 0 2 1 0\n"
      "-2 1 -1 -2 -1 -1 -2 -1 0 -2 1 0\n";
  const std::string lid = "-2 -1 0 2 -1 0 2 1 0 -2 1 0\n";
  for (const bool with_lid : {false, true}) {
    const test::TemporaryFolder folder;
    folder.write("box.gdf", std::string("box\n1 9.80665\n0 0\n") + (with_lid ? "6\n" : "5\n") +
                                wetted + (with_lid ? lid : ""));
    folder.write("vessel.yaml", replaced(cube, "{barge: {length: 5 m, breadth: 5 m, depth: 5 m}}",
                                         "{mesh: {file: box.gdf}}") +
                                    "hydrodynamics: {water_line: as meshed}\n");
    Diagnostics diagnostics;
    const std::optional<Vessel> vessel = read_vessel("vessel.yaml", diagnostics);
    ASSERT_TRUE(vessel.has_value()) << diagnostics.to_text();
    EXPECT_NEAR(dynamics::calc_enclosed_volume(vessel->hull).volume, 16.0, 1e-12);
    EXPECT_EQ(vessel->hull.bounds()[1].z(), 1.0);
  }
}

/// What is said of a box 4 x 2 x 1 m that ends at the water line, by the panels of its mesh.
std::string said_of_wetted_box(const std::string& panels, const std::string& symmetry = "0 0") {
  const test::TemporaryFolder folder;
  const auto count = std::count(panels.begin(), panels.end(), '\n');
  folder.write("box.gdf",
               "box\n1 9.80665\n" + symmetry + "\n" + std::to_string(count) + "\n" + panels);
  folder.write("vessel.yaml", replaced(cube, "{barge: {length: 5 m, breadth: 5 m, depth: 5 m}}",
                                       "{mesh: {file: box.gdf}}") +
                                  "hydrodynamics: {water_line: as meshed}\n");
  Diagnostics diagnostics;
  read_vessel("vessel.yaml", diagnostics);
  return diagnostics.to_text();
}

// What was closed without a word, and is another hull then.
TEST(VesselModel, AMeshMustBeClosedBelowTheWater) {
  const std::string bottom = "-2 -1 -1 -2 1 -1 2 1 -1 2 -1 -1\n",
                    starboard = "-2 -1 -1 2 -1 -1 2 -1 0 -2 -1 0\n",
                    rest =
                        "2 -1 -1 2 1 -1 2 1 0 2 -1 0\n"
                        "2 1 -1 -2 1 -1 -2 1 0 2 1 0\n"
                        "-2 1 -1 -2 -1 -1 -2 -1 0 -2 1 0\n";
  EXPECT_EQ(said_of_wetted_box(bottom + starboard + rest), "");
  EXPECT_THAT(
      said_of_wetted_box(starboard + rest),
      ::testing::AllOf(HasSubstr("vessel.yaml:2:"),
                       HasSubstr("has no panel on its other side, and lies below the water "
                                 "line z = 0, where alone a mesh may end (4 such edges); add "
                                 "the panels that are missing")));
  EXPECT_THAT(said_of_wetted_box(bottom + starboard + rest + starboard),
              HasSubstr("panel 5: it has the same vertices as panel 1"));
  EXPECT_THAT(said_of_wetted_box("-2 -1 1 -2 1 1 2 1 1 2 -1 1\n"),
              ::testing::AllOf(HasSubstr("all panels are above the water line; lower the hull"),
                               ::testing::Not(HasSubstr("no panel on its other side"))));
  const std::string turned = "-2 -1 0 2 -1 0 2 -1 -1 -2 -1 -1\n";
  EXPECT_THAT(said_of_wetted_box(bottom + turned + rest),
              ::testing::AllOf(HasSubstr("one of the two is turned round"),
                               HasSubstr("panel 1 (counted from 0) is turned round against all "
                                         "neighbours: reverse the order of its vertices")));
}

TEST(VesselModel, AHalfIsToldFromAWhole) {
  const std::string half =
      "-2 0 -1 -2 1 -1 2 1 -1 2 0 -1\n"
      "2 0 -1 2 1 -1 2 1 0 2 0 0\n"
      "2 1 -1 -2 1 -1 -2 1 0 2 1 0\n"
      "-2 1 -1 -2 0 -1 -2 0 0 -2 1 0\n";
  EXPECT_EQ(said_of_wetted_box(half, "0 1"), "");
  EXPECT_THAT(
      said_of_wetted_box(half),
      HasSubstr("all its open edges lie in y = 0, and all of it on one side: it is the half "
                "of a hull; ISY 1 in line 3 of a .gdf mirrors it"));
}

TEST(VesselModel, AMeshInMillimetresIsDoubted) {
  const dynamics::Hull metres =
      dynamics::make_barge({.length = 40, .breadth = 20, .depth = 6}, {4, 2, 2, 1});
  EXPECT_EQ(doubt_about_size("vessel barge", metres), "");
  const dynamics::Hull millimetres =
      dynamics::make_barge({.length = 40e3, .breadth = 20e3, .depth = 6e3}, {4, 2, 2, 1});
  EXPECT_EQ(
      doubt_about_size("vessel barge", millimetres),
      "The hull of vessel barge is 40000 x 20000 x 6000 m large: lengths of a mesh are metres, "
      "and the file may have millimetres (then 40 m long).");
}

TEST(VesselModel, AMassInKilogramsIsDoubted) {
  const dynamics::Hull barge =
      dynamics::make_barge({.length = 40, .breadth = 20, .depth = 6}, {4, 2, 2, 1});
  EXPECT_EQ(doubt_about_lightness("vessel barge", barge, 400e3, 1000), "");
  EXPECT_EQ(doubt_about_lightness("vessel barge", barge, 3e3, 1000),
            "The mass of vessel barge is 3 t, where its hull up to the deck would displace 4800 t: "
            "the mass may be in kg where t is meant.");
}

// A box whose mesh is not symmetric: its ends are divided along one diagonal. By key it is.
TEST(VesselModel, AMeshBecomesSymmetricByKey) {
  const auto read = [](const std::string& key, double left) {
    const test::TemporaryFolder folder;
    std::string panels = "box\n1 9.80665\n0 0\n8\n";
    const std::string l = std::to_string(left), r = "1";
    const std::string a = "-2 " + l + " 0 ", b = "2 " + l + " 0 ", c = "2 " + r + " 0 ",
                      d = "-2 " + r + " 0 ", A = "-2 " + l + " 3 ", B = "2 " + l + " 3 ",
                      C = "2 " + r + " 3 ", D = "-2 " + r + " 3 ";
    for (const std::string& panel : {a + d + c + b, A + B + C + D, a + b + B + A, c + d + D + C,
                                     b + c + C + C, b + C + B + B, a + A + D + D, a + D + d + d}) {
      panels += panel + "\n";
    }
    folder.write("box.gdf", panels);
    folder.write("vessel.yaml", replaced(replaced(cube, "60 t", "8 t"),
                                         "{barge: {length: 5 m, breadth: 5 m, depth: 5 m}}",
                                         "{mesh: {file: box.gdf" + key + "}}"));
    Diagnostics diagnostics;
    const auto vessel = read_vessel("vessel.yaml", diagnostics);
    return std::pair(vessel ? vessel->hull.panel_count() : 0, diagnostics.to_text());
  };
  EXPECT_EQ(read("", -1).first, 8);
  const auto halved = read(", symmetric_in: [y]", -1);
  EXPECT_GT(halved.first, 8) << halved.second;
  EXPECT_THAT(read(", symmetric_in: [y]", -1.5).second,
              ::testing::AllOf(HasSubstr("vessel.yaml:2:"), HasSubstr("not symmetric in y = 0")));
  EXPECT_THAT(read(", symmetric_in: [z]", -1).second, HasSubstr("vessel.yaml:2:"));
}

TEST(VesselModel, SaysWhatIsWrong) {
  EXPECT_THAT(complaint(replaced(cube, "60 t", "200 t")),
              HasSubstr("would have to displace 195.122 m3; it encloses 125 m3"));
  EXPECT_THAT(complaint(replaced(cube, "depth: 5 m", "depth: 5 m, bilge_radius: 7 m")),
              HasSubstr("bilge radius 7.000000; it must lie between"));
  EXPECT_THAT(complaint(replaced(cube, "{barge:", "{mesh: {file: none.stl}, barge:")),
              HasSubstr("the hull is described twice"));
  EXPECT_THAT(complaint(replaced(cube, "breadth: 5 m", "bredth: 5 m")), HasSubstr("breadth"));
}

TEST(VesselModel, DiagnosesAMeshAtThePlaceOfItsName) {
  const test::TemporaryFolder folder;
  folder.write("open.gdf", "t\n1 9.8\n0 0\n1\n0 0 0 1 0 0 1 1 0 0 1 0\n");
  folder.write("vessel.yaml", replaced(cube, "{barge: {length: 5 m, breadth: 5 m, depth: 5 m}}",
                                       "{mesh: {file: open.gdf}}"));
  Diagnostics diagnostics;
  EXPECT_FALSE(read_vessel("vessel.yaml", diagnostics).has_value());
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("vessel.yaml:2:"));
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("not closed"));
}

// The pages of the models state these figures.
TEST(VesselModel, TheModelsFloatAsTheirPagesSay) {
  const std::filesystem::path models = BLOCKLIFT_MODELS;
  struct Expected {
    const char* name;
    double draught, GM;
  };
  for (const Expected& expected :
       {Expected{"sheerleg-3000t", 4.05, 42.7}, Expected{"ship-3800t", 2.15, 9.9}}) {
    Diagnostics diagnostics;
    const auto vessel =
        read_vessel(models / "vessels" / expected.name / "vessel.yaml", diagnostics);
    ASSERT_TRUE(vessel.has_value()) << diagnostics.to_text();
    const auto position =
        find_floating_position(dynamics::HullClusters(vessel->hull), vessel->body());
    const auto metacentre =
        calc_metacentre(position.hydrostatics, position.X_WB.R * vessel->body().p_BoBcm_B);
    EXPECT_NEAR(-position.X_WB.p.z(), expected.draught, 0.02) << expected.name;
    EXPECT_NEAR(metacentre.GM_x, expected.GM, 0.3) << expected.name;
    EXPECT_GT(position.least_metacentric_height, 0);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
