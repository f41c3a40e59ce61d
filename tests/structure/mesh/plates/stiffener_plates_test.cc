// Stiffeners as plates: where their webs and flanges stand, what they weigh, how they bend.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/mesh/beams/sections.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/mesh/plates/stiffener_sheets.h"
#include "structure/practice/panel_buckling.h"
#include "structure/response/elastic_model.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/mesh/plates/mesh_measures.h"

namespace blocklift::structure {
namespace {

using test::expect_conforming;
using test::measure;
using ::testing::HasSubstr;

constexpr double density_of_steel = 7850;  // kg/m^3

BlockDescription deck(double length, double breadth, double thickness) {
  BlockDescription block;
  block.name = "deck";
  block.materials = {test::steel()};
  block.plates = {{"deck", Axis::z, {0}, {{{0, length}, {0, breadth}, {}}}, thickness, "AH36"}};
  block.largest_element = 0.5;
  return block;
}

Stiffeners row_of(const Profile& profile, Axis along, double spacing, bool as_plates = true) {
  Stiffeners row;
  row.name = "ribs";
  row.plate = "deck";
  row.along = along;
  row.spacing = spacing;
  row.section = profile.section;
  row.centroid = profile.centroid;
  if (as_plates) row.plates = profile.plates;
  return row;
}

/// The same row on the same deck given by its corners.
BlockDescription with_free_plates(BlockDescription block) {
  const auto& extent = block.plates[0].extent;
  FreePlate plate;
  plate.name = "deck";
  plate.corners = {{extent[0].lower, extent[1].lower, 0},
                   {extent[0].upper, extent[1].lower, 0},
                   {extent[0].upper, extent[1].upper, 0},
                   {extent[0].lower, extent[1].upper, 0}};
  plate.thickness = block.plates[0].thickness;
  plate.material = block.plates[0].material;
  block.free_plates = {plate};
  block.plates.clear();
  block.free_stiffeners = std::exchange(block.stiffeners, {});
  return block;
}

/// Area of all regions whose name ends so, m^2.
double area_of(const Mesh& mesh, const std::string& ending) {
  double area = 0;
  for (const auto& [name, part] : measure(mesh).area_of_region)
    if (name.size() >= ending.size() &&
        name.compare(name.size() - ending.size(), ending.size(), ending) == 0)
      area += part;
  return area;
}

// The mid-surfaces by hand: from the deck's to the flange's, and the flange from the web's
// outwards.
TEST(StiffenerPlates, WeighWhatTheirMiddlePlanesDo) {
  const double t = 0.012, height = 0.3, web = 0.01, width = 0.09, flange = 0.016;
  for (const int side : {1, -1})
    for (const bool is_free : {false, true}) {
      BlockDescription block = deck(4, 2, t);
      block.stiffeners = {row_of(angle_bar(height, web, width, flange), Axis::x, 1)};
      block.stiffeners[0].side = side;
      if (is_free) block = with_free_plates(block);
      const Mesh mesh = generate_shell_mesh(block);
      check_mesh(mesh);
      if (!is_free) expect_conforming(mesh);
      EXPECT_TRUE(mesh.beams.empty());
      const double far = t / 2 + height - flange / 2, reach = width - web / 2;
      const double plate = 8 * t, upright = 4 * web * far, lying = 4 * flange * reach;
      const double volume = plate + upright + lying;
      const auto steel = measure(mesh);
      EXPECT_NEAR(steel.mass, density_of_steel * volume, 1e-8);
      EXPECT_NEAR(steel.centre.x(), 2, 1e-9);
      // Axis 3 is x cross (away from the plate): -y above the deck, y below it.
      EXPECT_NEAR(steel.centre.y(), 1 - side * lying * reach / 2 / volume, 1e-9);
      EXPECT_NEAR(steel.centre.z(), side * far * (upright / 2 + lying) / volume, 1e-9);
      EXPECT_NEAR(steel.area_of_group.at("ribs"), 4 * (far + reach), 1e-9);
    }
}

TEST(StiffenerPlates, AlongTheOtherAxisTheFlangePointsTheSameWay) {
  for (const bool is_free : {false, true}) {
    BlockDescription block = deck(2, 4, 0.012);
    block.stiffeners = {row_of(angle_bar(0.3, 0.01, 0.09, 0.016), Axis::y, 1)};
    if (is_free) block = with_free_plates(block);
    const Mesh mesh = generate_shell_mesh(block);
    EXPECT_GT(measure(mesh).centre.x(), 1 + 1e-3) << is_free;  // y cross z is x
  }
}

TEST(StiffenerPlates, AreCutByOpeningsOfTheirPlate) {
  BlockDescription block = deck(4, 2, 0.012);
  block.stiffeners = {row_of(tee_bar(0.2, 0.01, 0.1, 0.012), Axis::x, 0.5)};
  block.openings = {{"hatch", "deck", {}, {{{1, 2}, {0.8, 1.2}, {}}}}};
  Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_NEAR(area_of(mesh, "flange"), (3 * 4 - 1) * 0.1, 1e-9);
  EXPECT_NEAR(area_of(mesh, "web"), (3 * 4 - 1) * 0.2, 1e-9);
  EXPECT_EQ(measure(mesh).area_of_region.count("ribs at z = 0 m, y = 1 m, x = 2 m to 4 m, web"),
            1u);
  // A round manhole of 0.6 m: webs end 0.2 m before it, where its frame of shells begins.
  block.openings[0] = {"manhole", "deck", {}, {{{1, 1.6}, {0.7, 1.3}, {}}}, 0.3};
  mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_NEAR(area_of(mesh, "flange"), (3 * 4 - 1) * 0.1, 1e-9);
}

TEST(StiffenerPlates, GiveWayToPlatesInTheirPlace) {
  BlockDescription block = deck(4, 2, 0.012);
  block.stiffeners = {row_of(tee_bar(0.2, 0.01, 0.1, 0.012), Axis::x, 0.5)};
  block.plates.push_back({"girder", Axis::y, {1}, {{{0, 3}, {}, {0, 0.8}}}, 0.014, "AH36"});
  Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_NEAR(area_of(mesh, "web"), (3 * 4 - 3) * 0.2, 1e-9);
  block.stiffeners[0].side = -1;
  mesh = generate_shell_mesh(block);
  EXPECT_NEAR(area_of(mesh, "web"), 3 * 4 * 0.2, 1e-9);
}

// Through a frame that carries stiffeners of its own, under a pad, and beside a deck of another
// thickness, whose flanges would lie within the thickness of these.
TEST(StiffenerPlates, CrossPlatesAndOneAnother) {
  BlockDescription block = deck(4, 2, 0.012);
  block.plates.push_back({"strake", Axis::z, {0}, {{{4, 6}, {0, 2}, {}}}, 0.016, "AH36"});
  block.plates.push_back({"frame", Axis::x, {2}, {{{}, {0, 2}, {-1, 0}}}, 0.01, "AH36"});
  const Profile tee = tee_bar(0.2, 0.01, 0.1, 0.012);
  block.stiffeners = {row_of(tee, Axis::x, 0.5), row_of(tee, Axis::x, 0.5),
                      row_of(flat_bar(0.1, 0.01), Axis::z, 0.8)};
  block.stiffeners[1].name = "ribs of strake";
  block.stiffeners[1].plate = "strake";
  block.stiffeners[2].name = "ribs of frame";
  block.stiffeners[2].plate = "frame";
  for (Stiffeners& row : block.stiffeners) row.side = -1;
  block.pads = {{"pad", "deck", Axis::z, 0, {{{3, 3.5}, {0.2, 0.8}, {}}}, 0.03, ""}};
  const Mesh mesh = generate_shell_mesh(block);
  check_mesh(mesh);
  expect_conforming(mesh);
  EXPECT_NEAR(area_of(mesh, "flange"), 3 * 6 * 0.1, 1e-9);
  EXPECT_NEAR(measure(mesh).area_of_group.at("ribs of strake"), 3 * 2 * (0.2 + 0.1), 1e-9);
}

/// A simply supported strip of 6 x 0.3 m under 1 kPa: how far its middle goes down, m.
double sag(const Stiffeners& row, double length, double breadth, double thickness) {
  BlockDescription block = deck(length, breadth, thickness);
  block.stiffeners = {row};
  block.largest_element = 0.25;
  const Mesh mesh = generate_shell_mesh(block);
  const Space space(mesh, {2, {}});
  std::vector<FixedUnknown> fixed;
  const auto is_at = [](const Vector3& p, double x) {
    return std::abs(p.x() - x) < 1e-9 && std::abs(p.z()) < 1e-9;
  };
  const auto is_middle = [&](const Vector3& p) { return std::abs(p.y() - breadth / 2) < 1e-9; };
  examples::hold(
      space, [&](const Vector3& p) { return is_at(p, 0) || is_at(p, length); }, {2}, fixed);
  examples::hold(
      space, [&](const Vector3& p) { return is_at(p, 0) && is_middle(p); }, {0, 1}, fixed);
  examples::hold(
      space, [&](const Vector3& p) { return is_at(p, length) && is_middle(p); }, {1}, fixed);
  const Eigen::VectorXd load = examples::area_load(space, [](const Vector3& p) {
    return std::abs(p.z()) < 1e-9 ? Vector3(0, 0, -1e3) : Vector3(0, 0, 0);
  });
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  return -examples::displacement_at(space, motion, {length / 2, breadth / 2, 0}).z();
}

// Deflection of a beam of the plate and the stiffener together, all of the strip's width bearing
// along (Timoshenko, Strength of materials I (1955), sections 21 and 39): 5 q L^4 / (384 E I) +
// q L^2 / (8 G A_s), section and shear area of thin walls along the mid-surfaces.
TEST(StiffenerPlates, BendWithTheirPlateAsABeam) {
  const double length = 6, breadth = 0.3, t = 0.012;
  const Profile tee = tee_bar(0.25, 0.01, 0.1, 0.014);
  const StiffenerPlates& shape = tee.plates.value();
  const double level = t / 2 + shape.web_height, half = breadth / 2;
  const Profile both = walled_profile(
      "strip with tee", {{0, 0}, {0, -half}, {0, half}, {level, 0}, {level, -0.05}, {level, 0.05}},
      {{1, 0, t}, {2, 0, t}, {4, 3, 0.014}, {5, 3, 0.014}, {3, 0, 0.01}});
  const Material steel = test::steel();
  const double load = 1e3 * breadth;
  const double expected =
      5 * load * std::pow(length, 4) / (384 * steel.youngs_modulus * both.section.second_moment_3) +
      load * length * length / (8 * steel.shear_modulus() * both.section.shear_area_2);
  for (const int side : {1, -1}) {
    Stiffeners row = row_of(tee, Axis::x, breadth / 2);
    row.side = side;
    const double as_plates = sag(row, length, breadth, t);
    row.plates.reset();
    const double as_beams = sag(row, length, breadth, t);
    EXPECT_NEAR(as_plates, expected, 0.005 * expected);
    // Mid-surfaces overlap at the joints: their second moment is 2.8 % more than the profile's.
    EXPECT_NEAR(as_plates, as_beams, 0.03 * as_beams);
  }
}

// A strip with a flat bar twists as thin walls do, J = sum l t^3 / 3 (Saint-Venant): both walls
// meet in the shear centre and hardly warp. 3 % are for the clamped end.
TEST(StiffenerPlates, TwistAsThinWalls) {
  const double length = 4, breadth = 0.3, t = 0.012, height = 0.2, web = 0.012;
  BlockDescription block = deck(length, breadth, t);
  block.stiffeners = {row_of(flat_bar(height, web), Axis::x, breadth / 2)};
  block.largest_element = 0.2;
  const Mesh mesh = generate_shell_mesh(block);
  const Space space(mesh, {2, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  const int left = examples::nearest_node(space, {length, 0, 0}),
            right = examples::nearest_node(space, {length, breadth, 0});
  load[6 * left + 2] = -1e2;
  load[6 * right + 2] = 1e2;
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  const double twist = (motion[6 * right + 2] - motion[6 * left + 2]) / breadth;
  const double torsion = (breadth * std::pow(t, 3) + (height + t / 2) * std::pow(web, 3)) / 3;
  const double expected = 1e2 * breadth * length / (test::steel().shear_modulus() * torsion);
  EXPECT_NEAR(twist, expected, 0.03 * expected);
}

// Against the profile: webs reach half the plate's and half the flange's thickness too far. Of a
// bulb flat the equivalent angle is as wide and thick as CSR (2014) 1-3-7 [1.4.1] says.
TEST(StiffenerPlates, DifferFromTheirProfileByTheJoints) {
  const Profile bulb = bulb_flat(0.2, 0.01);
  const StiffenerPlates& shape = bulb.plates.value();
  EXPECT_NEAR(shape.flange_thickness, 0.2 / 9.2 - 0.002, 1e-15);
  EXPECT_NEAR(shape.flange_reach[1] + 0.005, 0.01 + 0.2 / 6.7 - 0.002, 1e-15);
  EXPECT_NEAR(shape.web_height, 0.2 - shape.flange_thickness / 2, 1e-15);
  const Profile tee = tee_bar(0.25, 0.01, 0.1, 0.014);
  EXPECT_NEAR(figures_as_plates(tee.plates.value(), 0.012).area - figures_as_beam(tee, 0.012).area,
              0.01 * (0.006 + 0.007), 1e-12);
  for (const Profile& profile :
       {bulb, tee, flat_bar(0.2, 0.012), angle_bar(0.25, 0.01, 0.09, 0.015)}) {
    const StiffenerFigures plates = figures_as_plates(profile.plates.value(), 0.012);
    const StiffenerFigures beam = figures_as_beam(profile, 0.012);
    EXPECT_NEAR(plates.area, beam.area, 0.05 * beam.area);
    // Most by the half of the flange's thickness that the web reaches into it, at the flange's
    // whole distance: 10 x 7 mm at 257 mm are 3.2 % of the tee's.
    EXPECT_NEAR(plates.second_moment, beam.second_moment, 0.04 * beam.second_moment);
  }
  EXPECT_FALSE(channel(0.2, 0.01, 0.08, 0.012).plates.has_value());
  EXPECT_FALSE(solid_circle(0.05).plates.has_value());
}

/// The panels of a deck with one stiffener whose names end so.
std::vector<Panel> panels_of(const Profile& profile, const std::string& ending) {
  BlockDescription block = deck(4, 2, 0.012);
  block.stiffeners = {row_of(profile, Axis::x, 1)};
  const ElasticModel model(generate_shell_mesh(block), {1, {}}, std::nullopt, std::nullopt);
  const BlockPanels panels(model, Eigen::MatrixXd::Zero(model.freedoms(), 1), {});
  std::vector<Panel> found;
  for (const Panel& panel : panels.panels())
    if (panel.plate.ends_with(ending)) found.push_back(panel);
  return found;
}

// A flat bar has a free edge along it; a tee's web has none, and its flange is two panels with one.
TEST(StiffenerPlates, ArePanelsThatBuckle) {
  const std::vector<Panel> bar = panels_of(flat_bar(0.2, 0.012), "web");
  ASSERT_EQ(bar.size(), 1u);
  EXPECT_NEAR(bar[0].size.a, 4, 1e-9);
  EXPECT_NEAR(bar[0].size.b, 0.206, 1e-9);
  EXPECT_EQ(bar[0].free.along_a, 1);
  EXPECT_EQ(bar[0].group, "ribs");
  const Profile tee = tee_bar(0.25, 0.01, 0.1, 0.014);
  const std::vector<Panel> web = panels_of(tee, "web"), flange = panels_of(tee, "flange");
  ASSERT_EQ(web.size(), 1u);
  EXPECT_EQ(web[0].free.along_a, 0);
  ASSERT_EQ(flange.size(), 2u);
  EXPECT_NEAR(flange[0].size.b, 0.05, 1e-9);
  EXPECT_EQ(flange[0].free.along_a, 1);
  EXPECT_EQ(panels_of(tee, "deck at z = 0 m").size(), 2u);
}

TEST(StiffenerPlates, HaveRoomForTheirFlanges) {
  BlockDescription block = deck(4, 2, 0.012);
  block.stiffeners = {row_of(tee_bar(0.2, 0.01, 0.3, 0.012), Axis::x, 0.25)};
  try {
    generate_shell_mesh(block);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("flanges of 300 mm at a spacing of 250 mm"));
  }
}

}  // namespace
}  // namespace blocklift::structure
