// Stiffeners as beams and openings of any shape by the keys of a block's file.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/build/describe_block.h"
#include "pipeline/build/stiffener_plates.h"
#include "pipeline/files/library/model_library.h"
#include "structure/mesh/beams/sections.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

constexpr double density = 7850;  // kg/m^3

/// A deck of 4 x 3 m and 10 mm with what is added to its keys, and openings.
std::string deck_with(const std::string& keys, const std::string& openings = "") {
  return "kind: block\n"
         "materials:\n"
         "  AH36: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, "
         "yield_stress: 355 MPa}\n"
         "plates:\n"
         "  deck: {normal: z, at: 1 m, x: [0 m, 4 m], y: [0 m, 3 m], thickness: 10 mm" +
         keys + "}\n" + openings;
}

struct Read {
  std::shared_ptr<const BlockModel> block;
  std::string complaints;
};

Read read(const std::string& text) {
  const test::TemporaryFolder folder;
  folder.write("block.yaml", text);
  ModelLibrary library({});
  Diagnostics diagnostics;
  Read result;
  result.block = library.read_block("block.yaml", diagnostics);
  result.complaints = diagnostics.to_text();
  return result;
}

structure::Mesh mesh_of(const std::string& text) {
  const Read result = read(text);
  EXPECT_EQ(result.complaints, "");
  return structure::generate_shell_mesh(describe_block(*result.block, "deck", 0.5));
}

TEST(BlockKeys, StiffenersWithAProfileAreBeams) {
  const structure::Mesh mesh = mesh_of(
      deck_with(", stiffeners: {along: x, spacing: 750 mm, side: negative, profile: {bulb_flat: "
                "[200 mm, 9 mm]}}"));
  const structure::Profile bulb = structure::bulb_flat(0.2, 0.009);
  ASSERT_FALSE(mesh.beams.empty());
  double length = 0;
  for (const structure::Beam& beam : mesh.beams) {
    const structure::Vector3 along =
        mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]];
    length += along.norm();
    // Below the deck, by half its thickness and the height of the centroid over the foot.
    EXPECT_NEAR(beam.offset[0].z(), -0.005 - bulb.centroid[0], 1e-12);
  }
  EXPECT_NEAR(length, 3 * 4, 1e-9);  // at y = 0.75, 1.5, 2.25 m
  EXPECT_NEAR(structure::mass_properties(mesh).mass, density * (12 * 0.01 + 12 * bulb.section.area),
              1e-6);
}

TEST(BlockKeys, StiffenersWithoutAProfileAreLeftOut) {
  EXPECT_TRUE(mesh_of(deck_with(", stiffeners: {along: x, spacing: 750 mm}")).beams.empty());
}

TEST(BlockKeys, StiffenersHaveTrippingBrackets) {
  const structure::Mesh mesh = mesh_of(
      deck_with(", stiffeners: {along: x, spacing: 1 m, tripping_brackets: 1200 mm, profile: "
                "{flat_bar: [200 mm, 12 mm]}}"));
  ASSERT_FALSE(mesh.beams.empty());
  for (const structure::Beam& beam : mesh.beams)
    EXPECT_EQ(mesh.group_of_region(beam.region).tripping_brackets, 1.2);
  EXPECT_EQ(mesh.groups.front().tripping_brackets, 0);
  EXPECT_THAT(read(deck_with(", stiffeners: {along: x, spacing: 1 m, tripping_brackets: 1.2 m}"))
                  .complaints,
              HasSubstr("has a place, a material or tripping brackets, but no profile"));
}

TEST(BlockKeys, StiffenersAsPlates) {
  const std::string text = deck_with(
      ", stiffeners: {along: x, spacing: 750 mm, side: negative, as: plates, profile: {angle_bar: "
      "[250 mm, 10 mm, 90 mm, 16 mm]}}");
  const structure::Mesh mesh = mesh_of(text);
  EXPECT_TRUE(mesh.beams.empty());
  const double section = (0.005 + 0.25 - 0.008) * 0.01 + (0.09 - 0.005) * 0.016;
  EXPECT_NEAR(structure::mass_properties(mesh).mass, density * (12 * 0.01 + 12 * section), 1e-8);
  // 38.3 cm^2 against the profile's 37.8.
  const std::vector<std::string> said = describe_stiffener_plates(*read(text).block);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_THAT(said[0],
              HasSubstr("Stiffeners of deck are plates: a web of 247 x 10.0 mm and a flange "
                        "of 85 x 16.0 mm"));
  EXPECT_THAT(said[0], HasSubstr("mass +1.3 %"));
  EXPECT_THAT(said[1], HasSubstr("against tripping as a whole by a formula, they are not"));
  EXPECT_TRUE(describe_stiffener_plates(*read(deck_with("")).block).empty());
}

TEST(BlockKeys, SaysWhatStiffenersMayBePlates) {
  const auto complaints = [](const std::string& keys) {
    return read(deck_with(", stiffeners: {along: x, spacing: 1 m, " + keys + "}")).complaints;
  };
  const std::string mistyped = complaints("as: plate, profile: {flat_bar: [150 mm, 10 mm]}");
  EXPECT_THAT(mistyped, HasSubstr("block.yaml:5:"));
  EXPECT_THAT(mistyped, HasSubstr("did you mean \"plates\"?"));
  EXPECT_EQ(complaints("as: beams, profile: {pipe: [114.3 mm, 6 mm]}"), "");
  EXPECT_THAT(complaints("as: plates, profile: {pipe: [114.3 mm, 6 mm]}"),
              HasSubstr("flat_bar, angle_bar, tee_bar and bulb_flat may be plates"));
  EXPECT_THAT(
      complaints("as: plates, tripping_brackets: 1 m, profile: {flat_bar: [150 mm, 10 mm]}"),
      HasSubstr("is to be plates, and has tripping brackets"));
  EXPECT_THAT(complaints("as: plates"), HasSubstr("is to be plates, but has no profile"));
}

TEST(BlockKeys, OtherShapesOfProfiles) {
  for (const char* profile :
       {"flat_bar: [150 mm, 12 mm]", "angle_bar: [150 mm, 9 mm, 90 mm, 12 mm]",
        "tee_bar: [300 mm, 10 mm, 120 mm, 15 mm]", "i_beam: [200 mm, 8 mm, 100 mm, 12 mm]",
        "channel: [200 mm, 8 mm, 75 mm, 11 mm]", "box: [200 mm, 100 mm, 8 mm]",
        "pipe: [114.3 mm, 6 mm]", "round_bar: 60 mm",
        "figures: {size: [400 mm, 200 mm], area: 84 cm^2, second_moments: [23100 cm^4, 1320 cm^4], "
        "torsion: 51 cm^4}"})
    EXPECT_EQ(read(deck_with(std::string(", stiffeners: {along: y, spacing: 1 m, first: 0.5 m, "
                                         "material: AH36, profile: {") +
                             profile + "}}"))
                  .complaints,
              "");
}

// What has its origin in its middle stands on the plate with its edge, as other shapes do.
TEST(BlockKeys, StiffenersOfAnyShapeStandOnTheirPlate) {
  const structure::Mesh mesh = mesh_of(deck_with(
      ", stiffeners: {along: x, spacing: 750 mm, profile: {box: [200 mm, 100 mm, 8 mm]}}"));
  ASSERT_FALSE(mesh.beams.empty());
  for (const structure::Beam& beam : mesh.beams)
    EXPECT_NEAR(beam.offset[0].z(), 0.005 + 0.1, 1e-12);
}

/// The deck with a bar, whose keys may be replaced.
std::string deck_with_bar(const std::string& keys) {
  return deck_with("", "bars:\n  strut: {" + keys + "}\n");
}

TEST(BlockKeys, BarsFromPointToPoint) {
  const std::string points = "points: [[1 m, 1 m, 1 m], [1 m, 1 m, 3 m], [3 m, 1 m, 1 m]], ";
  const structure::Mesh mesh =
      mesh_of(deck_with_bar(points + "section: {pipe: [114.3 mm, 6.3 mm]}, hinged: true"));
  const double area = std::numbers::pi * 0.0063 * (0.1143 - 0.0063);
  EXPECT_NEAR(structure::mass_properties(mesh).mass,
              density * (12 * 0.01 + (2 + std::sqrt(8)) * area), 1e-6);
  int hinges = 0;
  for (const structure::Beam& beam : mesh.beams)
    hinges += int{beam.release[0][4]} + int{beam.release[1][4]};
  EXPECT_EQ(hinges, 2);
}

// A rectangle by its figures is that rectangle.
TEST(BlockKeys, ASectionByItsFigures) {
  const std::string points = "points: [[1 m, 1 m, 1 m], [1 m, 1 m, 3 m]], towards: [1, 0, 0], ";
  const structure::Mesh mesh = mesh_of(deck_with_bar(
      points +
      "section: {figures: {size: [300 mm, 200 mm], area: 600 cm^2, second_moments: [45000 cm^4, "
      "20000 cm^4], torsion: 46960 cm^4, shear_areas: [500 cm^2, 500 cm^2]}}"));
  const structure::BeamSection expected = structure::solid_rectangle(0.3, 0.2).section;
  ASSERT_EQ(mesh.beam_sections.size(), 1u);
  const structure::BeamSection& found = mesh.beam_sections[0];
  EXPECT_NEAR(found.area, expected.area, 1e-9);
  EXPECT_NEAR(found.second_moment_2, expected.second_moment_2, 1e-9);
  EXPECT_NEAR(found.second_moment_3, expected.second_moment_3, 1e-9);
  EXPECT_NEAR(found.torsion, expected.torsion, 1e-3 * expected.torsion);
  EXPECT_NEAR(found.shear_area_2, expected.shear_area_2, 1e-9);
  ASSERT_EQ(found.stress_points.size(), 4u);
  EXPECT_NEAR(std::abs(found.stress_points[0].x()), 0.15, 1e-12);
  EXPECT_NEAR(std::abs(found.stress_points[0].y()), 0.1, 1e-12);
  EXPECT_THAT(read(deck_with_bar(points + "section: {figures: {size: [300 mm, 200 mm], area: 600 "
                                          "cm^2, second_moments: [450000 cm^4, 20000 cm^4], "
                                          "torsion: 46960 cm^4}}"))
                  .complaints,
              HasSubstr("its second moments are more than its area has within height and width"));
}

TEST(BlockKeys, SaysWhatIsWrongWithBars) {
  const std::string points = "points: [[1 m, 1 m, 1 m], [1 m, 1 m, 3 m]], ";
  const auto complaints = [](const std::string& keys) {
    return read(deck_with_bar(keys)).complaints;
  };
  EXPECT_EQ(complaints(points + "section: {round_bar: 60 mm}"), "");
  EXPECT_THAT(complaints(points + "section: {flat_bar: [60 mm, 10 mm]}"),
              HasSubstr("not towards what it stands"));
  EXPECT_THAT(complaints(points + "section: {flat_bar: [60 mm, 10 mm]}, towards: [0, 0, 1]"),
              HasSubstr("runs along the direction"));
  EXPECT_THAT(complaints("points: [[1 m, 1 m, 1 m], [1 m, 1 m, 1 m]], section: {round_bar: 60 mm}"),
              HasSubstr("0 mm long from its point 1"));
  EXPECT_THAT(complaints("points: [[1 m, 1 m, 1 m]], section: {round_bar: 60 mm}"),
              HasSubstr("block.yaml:"));
  EXPECT_THAT(complaints(points + "section: {pipe: [60 mm, 40 mm]}"), HasSubstr("pipe: "));
  EXPECT_THAT(complaints(points + "section: {round_bar: 60 mm}, material: AH63"),
              HasSubstr("names material \"AH63\""));
  EXPECT_THAT(read(deck_with("", "bars:\n  deck: {" + points + "section: {round_bar: 60 mm}}\n"))
                  .complaints,
              HasSubstr("has the name of another part"));
}

TEST(BlockKeys, OpeningsOfAnyShape) {
  const auto hole = [](const std::string& opening) {
    const structure::Mesh mesh =
        mesh_of(deck_with("", "openings:\n  hole: {plate: deck, " + opening + "}\n"));
    return 12 - structure::mass_properties(mesh).mass / (density * 0.01);
  };
  EXPECT_NEAR(hole("x: [1 m, 2 m], y: [1 m, 1.6 m]"), 0.6, 1e-9);
  EXPECT_NEAR(hole("corners: [[1 m, 1 m, 1 m], [2 m, 1 m, 1 m], [1.5 m, 2 m, 1 m]]"), 0.5, 1e-9);
  // Arcs are chords between their points: the hole is a little small.
  const double circle = std::numbers::pi * 0.09, slot = circle + 0.6 * 0.4;
  EXPECT_NEAR(hole("x: [1 m, 1.6 m], y: [1 m, 1.6 m], corner_radius: 0.3 m"), circle, 0.1 * circle);
  EXPECT_NEAR(hole("x: [1 m, 2 m], y: [1 m, 1.6 m], corner_radius: 0.3 m"), slot, 0.1 * slot);
}

/// A deck with a bilge and a bracket, whose keys may be replaced.
std::string bilge_with(const std::string& bracket, const std::string& openings = "") {
  return deck_with(
      "}\n  bilge: {thickness: 10 mm, edges: [{arc: [[0 m, 3 m, 1 m], [0 m, 3.70710678 m, "
      "1.29289322 m], [0 m, 4 m, 2 m]]}, {arc: [[4 m, 3 m, 1 m], [4 m, 3.70710678 m, "
      "1.29289322 m], [4 m, 4 m, 2 m]]}]}\n  bracket: {thickness: 10 mm, " +
          bracket,
      openings.empty() ? "" : "openings:\n  hole: {plate: bracket, " + openings + "}\n");
}

const char* const bracket = "corners: [[2 m, 0 m, 1 m], [2 m, 2 m, 1 m], [2 m, 0 m, 3 m]]";

TEST(BlockKeys, PlatesOfAnyOrientation) {
  const auto area = [](const structure::Mesh& mesh) {
    return structure::mass_properties(mesh).mass / (density * 0.01);
  };
  const double whole = 12 + 4 * std::numbers::pi / 2 + 2;
  EXPECT_NEAR(area(mesh_of(bilge_with(bracket))), whole, 1e-3);
  const double hole =
      area(mesh_of(bilge_with(bracket, "centres: [[2 m, 0.6 m, 1.6 m]], radius: 200 mm")));
  EXPECT_NEAR(hole, whole - std::numbers::pi * 0.04, 1e-3);
}

TEST(BlockKeys, SaysWhatIsWrongWithPlatesOfAnyOrientation) {
  const auto complaints = [](const std::string& keys, const std::string& opening = "") {
    return read(bilge_with(keys, opening)).complaints;
  };
  EXPECT_THAT(complaints("corners: [[2 m, 0 m, 1 m], [2 m, 2 m, 1 m], [2 m, 0 m, 3 m], "
                         "[2.1 m, 0 m, 2 m]]"),
              HasSubstr("the corners of plate bracket are not in one plane"));
  EXPECT_THAT(complaints("edges: [[[0 m, 0 m, 1 m], [1 m, 0 m, 1 m]]]"), HasSubstr("block.yaml:"));
  EXPECT_THAT(complaints(std::string(bracket) + ", edges: [[[0 m, 0 m, 1 m], [1 m, 0 m, 1 m]], "
                                                "[[0 m, 0 m, 2 m], [1 m, 0 m, 2 m]]]"),
              HasSubstr("has corners and also edges"));
  EXPECT_THAT(complaints(bracket, "y: [0.2 m, 0.4 m], z: [1.2 m, 1.4 m]"),
              HasSubstr("give its corners, or centres"));
  EXPECT_THAT(complaints(bracket, "centres: [[2.2 m, 0.6 m, 1.6 m]], radius: 200 mm"),
              HasSubstr("200 mm off the plane"));
}

TEST(BlockKeys, SaysWhatIsWrong) {
  const auto complaints = [](const std::string& keys, const std::string& opening = "") {
    return read(deck_with(keys, opening.empty()
                                    ? ""
                                    : "openings:\n  hole: {plate: deck, " + opening + "}\n"))
        .complaints;
  };
  const std::string row = ", stiffeners: {along: x, spacing: 1 m, ";
  EXPECT_THAT(complaints(row + "profile: {}}"), HasSubstr("has 0 shapes, and one is due"));
  EXPECT_THAT(complaints(row + "profile: {bulb_flat: [210 mm, 9 mm]}}"), HasSubstr("210"));
  EXPECT_THAT(complaints(row + "first: 0.5 m}"), HasSubstr("but no profile"));
  EXPECT_THAT(complaints(row + "material: AH32, profile: {flat_bar: [1 m, 1 cm]}}"),
              HasSubstr("did you mean \"AH36\"?"));
  EXPECT_THAT(complaints("", "x: [1 m, 2 m], y: [1 m, 1.6 m], corner_radius: 0.4 m"),
              HasSubstr("corner radius of 0.4 m and is 0.6 m wide along y"));
  EXPECT_THAT(complaints("",
                         "x: [1 m, 2 m], corners: [[1 m, 1 m, 1 m], [2 m, 1 m, 1 m], "
                         "[1.5 m, 2 m, 1 m]]"),
              HasSubstr("has corners and also an extent"));
}

}  // namespace
}  // namespace blocklift::pipeline
