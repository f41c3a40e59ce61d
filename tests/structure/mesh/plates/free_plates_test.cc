// Plates of any orientation among rectangles, cut and meshed by OpenCASCADE and Gmsh.
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/plates/shell_generator.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

constexpr double sheet_density = 7850, sheet_thickness = 0.01;  // kg/m^3, m

BlockDescription steel_block() {
  BlockDescription block;
  block.name = "bilge";
  block.materials = {{"AH36", 206e9, 0.3, sheet_density, 355e6}};
  block.largest_element = 0.5;
  return block;
}

FreePlate polygon_plate(const std::string& name, std::vector<Vector3> corners) {
  return {name, std::move(corners), {}, sheet_thickness, "AH36"};
}

PlateEdge quarter_arc(double x, double radius) {
  const double c = radius * (1 - std::sqrt(0.5));
  return {{{x, radius, 0}, {x, c, c}, {x, 0, radius}}, true};
}

std::string complaint_of(const BlockDescription& block) {
  try {
    generate_shell_mesh(block);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

double area_of_mesh(const Mesh& mesh) {
  return mass_properties(mesh).mass / (sheet_density * sheet_thickness);
}

// A bottom and a side with a quarter cylinder between them, and a bracket across the corner that
// the three of them leave: all hang together.
TEST(FreePlates, ABilgeBetweenBottomAndSide) {
  constexpr double radius = 1.5, length = 4;
  BlockDescription block = steel_block();
  block.plates = {
      {"bottom", Axis::z, {0}, {{{0, length}, {radius, 4}, {0, 0}}}, sheet_thickness, "AH36"},
      {"side", Axis::y, {0}, {{{0, length}, {0, 0}, {radius, 4}}}, sheet_thickness, "AH36"}};
  FreePlate bilge{
      "bilge", {}, {quarter_arc(0, radius), quarter_arc(length, radius)}, sheet_thickness, "AH36"};
  block.free_plates = {bilge, polygon_plate("bracket", {{2, 0, 2}, {2, 0, 3}, {2, 1, 2}})};
  block.free_plates[1].corners[2] = {2, 0.8, 2};
  const Mesh mesh = generate_shell_mesh(block);
  EXPECT_FALSE(mesh.curved_shells.empty());
  const double expected = 2 * 2.5 * length + length * radius * std::numbers::pi / 2 + 0.5 * 0.8 * 1;
  EXPECT_NEAR(area_of_mesh(mesh), expected, 1e-5 * expected);
  EXPECT_EQ(mesh.group_of_region(mesh.shells.back().region).name, "bracket");
  for (const Shell& shell : mesh.shells) {
    if (mesh.group_of_region(shell.region).name != "bottom") continue;
    const Vector3& corner = mesh.vertices[shell.vertices[0]];
    EXPECT_GT((mesh.vertices[shell.vertices[1]] - corner)
                  .cross(mesh.vertices[shell.vertices[2]] - corner)
                  .z(),
              0);
  }
}

// A floor under a deck, at 45 degrees, with a polygon, a circle and a slot cut out.
TEST(FreePlates, OpeningsOfAllShapes) {
  BlockDescription block = steel_block();
  const double s = std::sqrt(0.5);
  const auto sloping = [&](double u, double v) { return Vector3(u, s * v, s * v); };
  block.free_plates = {
      polygon_plate("floor", {sloping(0, 0), sloping(6, 0), sloping(6, 2), sloping(0, 2)})};
  block.free_openings = {
      {"triangle", "floor", {sloping(0.5, 0.5), sloping(1.5, 0.5), sloping(1, 1.5)}, {}, 0},
      {"circle", "floor", {}, {sloping(3, 1)}, 0.4},
      {"slot", "floor", {}, {sloping(4.5, 1), sloping(5, 1)}, 0.3}};
  const double holes = 0.5 + std::numbers::pi * (0.16 + 0.09) + 0.5 * 0.6;
  EXPECT_NEAR(area_of_mesh(generate_shell_mesh(block)), 12 - holes, 1e-4);
}

// Two edges that are not parallel: a hyperbolic paraboloid z = x y over the unit square, whose area
// is the integral of sqrt(1 + x^2 + y^2) = 1.2807, by Gauss' rule.
TEST(FreePlates, ATwistedPlateBetweenTwoEdges) {
  BlockDescription block = steel_block();
  block.largest_element = 0.25;
  block.free_plates = {{"twisted",
                        {},
                        {PlateEdge{{{0, 0, 0}, {1, 0, 0}}}, PlateEdge{{{0, 1, 0}, {1, 1, 1}}}},
                        sheet_thickness,
                        "AH36"}};
  const double g = std::sqrt(0.6) / 2;
  double area = 0;
  const double points[3] = {0.5 - g, 0.5, 0.5 + g}, weights[3] = {5.0 / 18, 4.0 / 9, 5.0 / 18};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      area +=
          weights[i] * weights[j] * std::sqrt(1 + points[i] * points[i] + points[j] * points[j]);
  EXPECT_NEAR(area_of_mesh(generate_shell_mesh(block)), area, 1e-3);
}

// Stiffeners of a rectangle stay beams, and a bracket that ends on the deck cuts it.
TEST(FreePlates, StiffenersStay) {
  BlockDescription block = steel_block();
  block.plates = {{"deck", Axis::z, {1}, {{{0, 4}, {0, 3}, {0, 0}}}, sheet_thickness, "AH36"}};
  Stiffeners row;
  row.name = "stiffeners of deck";
  row.plate = "deck";
  row.spacing = 1;
  row.section.area = 0.002;
  row.section.second_moment_2 = row.section.second_moment_3 = row.section.torsion = 1e-6;
  row.section.shear_area_2 = row.section.shear_area_3 = 0.002;
  row.centroid = {0.1, 0};
  block.stiffeners = {row};
  block.free_plates = {polygon_plate("bracket", {{1, 0.5, 1}, {2, 0.7, 1}, {1, 0.5, 0.2}})};
  const Mesh mesh = generate_shell_mesh(block);
  double length = 0;
  for (const Beam& beam : mesh.beams) {
    length += (mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]]).norm();
    EXPECT_NEAR(beam.offset[0].z(), 0.105, 1e-12);
  }
  EXPECT_NEAR(length, 8, 1e-9);  // at y = 1 and 2 m
}

TEST(FreePlates, SaysWhatIsWrong) {
  BlockDescription block = steel_block();
  block.plates = {{"deck", Axis::z, {1}, {{{0, 4}, {0, 3}, {0, 0}}}, sheet_thickness, "AH36"}};
  block.free_plates = {polygon_plate("bracket", {{1, 1, 0.9}, {2, 1, 0.9}, {1, 1, 0}})};
  EXPECT_THAT(complaint_of(block), HasSubstr("not joined to the rest of the block: bracket"));
  block.free_plates = {polygon_plate("patch", {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}})};
  EXPECT_THAT(complaint_of(block), HasSubstr("plate \"patch\" lies upon deck at z = 1 m"));
  block.free_plates = {polygon_plate("warped", {{0, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0.2, 2}})};
  EXPECT_THAT(complaint_of(block), HasSubstr("not in one plane"));
  block.free_plates = {{"arc",
                        {},
                        {PlateEdge{{{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}, true},
                         PlateEdge{{{0, 0, 2}, {1, 0, 2}, {2, 0, 2}}}},
                        sheet_thickness,
                        "AH36"}};
  EXPECT_THAT(complaint_of(block), HasSubstr("lie on one line"));
}

}  // namespace
}  // namespace blocklift::structure
