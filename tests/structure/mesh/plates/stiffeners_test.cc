// Stiffeners of plates as beams: where they stand, what they weigh, how they stiffen.
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/structure/formulation/gravity.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/mesh/plates/mesh_measures.h"

namespace blocklift::structure {
namespace {

using test::expect_conforming;
using test::measure;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double steel_density = 7850;  // kg/m^3

// Flat bar of 150 x 12 mm on its edge.
constexpr double height = 0.15, width = 0.012;

Stiffeners flat_bars(const std::string& plate, Axis along, double spacing) {
  Stiffeners row;
  row.name = "bars";
  row.plate = plate;
  row.along = along;
  row.spacing = spacing;
  row.section.name = "flat bar 150 x 12";
  row.section.area = height * width;
  row.section.second_moment_2 = height * std::pow(width, 3) / 12;
  row.section.second_moment_3 = width * std::pow(height, 3) / 12;
  row.section.torsion = height * std::pow(width, 3) / 3;
  row.section.shear_area_2 = row.section.shear_area_3 = 5 * row.section.area / 6;
  row.centroid = {height / 2, 0};
  return row;
}

BlockDescription panel(double length, double breadth, double thickness) {
  BlockDescription block;
  block.name = "panel";
  block.materials = {test::steel()};
  block.plates = {{"deck", Axis::z, {0}, {{{0, length}, {0, breadth}, {}}}, thickness, "AH36"}};
  block.largest_element = 1;
  return block;
}

/// Places across of the stiffeners along x that there are at a place along x, in mm.
std::set<long> lines_at(const Mesh& mesh, double x) {
  std::set<long> lines;
  for (const Beam& beam : mesh.beams) {
    const Vector3 &a = mesh.vertices[beam.vertices[0]], &b = mesh.vertices[beam.vertices[1]];
    if (a.x() < x && x < b.x()) lines.insert(std::lround(a.y() * 1e3));
  }
  return lines;
}

TEST(Stiffeners, StandBetweenTheEdgesAtTheirSpacing) {
  BlockDescription block = panel(4, 2, 0.012);
  block.stiffeners = {flat_bars("deck", Axis::x, 0.5)};
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  check_mesh(mesh);
  EXPECT_THAT(lines_at(mesh, 1.7), ElementsAre(500, 1000, 1500));
  const auto steel = measure(mesh);
  const double plate = steel_density * 8 * 0.012, bars = steel_density * 3 * 4 * height * width;
  EXPECT_NEAR(steel.mass, plate + bars, 1e-9);
  EXPECT_NEAR(steel.centre.x(), 2, 1e-12);
  EXPECT_NEAR(steel.centre.y(), 1, 1e-12);
  EXPECT_NEAR(steel.centre.z(), bars * (0.006 + height / 2) / (plate + bars), 1e-12);
  EXPECT_EQ(mesh.groups.back().name, "bars");
  EXPECT_EQ(mesh.regions.back().name, "bars at z = 0 m");
  EXPECT_EQ(mesh.beams.front().label, static_cast<long>(mesh.shells.size()) + 1);
}

TEST(Stiffeners, CountFromTheFirstAndStandOnTheOtherSide) {
  BlockDescription block = panel(4, 2, 0.012);
  block.stiffeners = {flat_bars("deck", Axis::x, 0.6)};
  block.stiffeners[0].first = 1;
  block.stiffeners[0].side = -1;
  block.stiffeners[0].centroid = {0.1, 0.02};
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_THAT(lines_at(mesh, 1.7), ElementsAre(400, 1000, 1600));
  // Away from the plate is down; along x that leaves y for axis 3: x cross -z.
  EXPECT_LT((mesh.beams[0].offset[0] - Vector3(0, 0.02, -0.106)).norm(), 1e-12);
  EXPECT_LT((mesh.beams[0].axis_2 + Vector3::UnitZ()).norm(), 1e-12);
}

TEST(Stiffeners, GiveWayToPlatesOnTheirSide) {
  BlockDescription block = panel(4, 2, 0.012);
  block.stiffeners = {flat_bars("deck", Axis::x, 0.5)};
  block.plates.push_back({"girder", Axis::y, {1}, {{{0, 3}, {}, {0, 0.8}}}, 0.014, "AH36"});
  Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_THAT(lines_at(mesh, 2.9), ElementsAre(500, 1500));
  EXPECT_THAT(lines_at(mesh, 3.1), ElementsAre(500, 1000, 1500));
  block.stiffeners[0].side = -1;
  mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_THAT(lines_at(mesh, 2.9), ElementsAre(500, 1000, 1500));
}

TEST(Stiffeners, AreCutByOpeningsAndRunOverPads) {
  BlockDescription block = panel(4, 2, 0.012);
  block.stiffeners = {flat_bars("deck", Axis::x, 0.5)};
  block.openings = {{"hatch", "deck", {}, {{{1, 2}, {0.8, 1.2}, {}}}}};
  block.pads = {{"pad", "deck", Axis::z, 0, {{{3, 4}, {0.2, 0.8}, {}}}, 0.03, ""}};
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_THAT(lines_at(mesh, 0.9), ElementsAre(500, 1000, 1500));
  EXPECT_THAT(lines_at(mesh, 1.1), ElementsAre(500, 1500));
  for (const Beam& beam : mesh.beams) {
    const Vector3& a = mesh.vertices[beam.vertices[0]];
    const bool is_on_pad = a.x() > 3 - 1e-9 && a.y() < 0.6;
    EXPECT_NEAR(beam.offset[0].z(), (is_on_pad ? 0.015 : 0.006) + height / 2, 1e-12);
  }
}

TEST(Stiffeners, EndWithTheirPlateWithinAnother) {
  // Two plates of a thickness lie over one another from x = 3 to 4 m; the stiffeners are those of
  // one.
  BlockDescription block = panel(4, 2, 0.012);
  block.plates.push_back({"strip", Axis::z, {0}, {{{3, 6}, {0, 2}, {}}}, 0.012, "AH36"});
  block.stiffeners = {flat_bars("strip", Axis::x, 0.5)};
  block.largest_element = 10;
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_TRUE(lines_at(mesh, 2.9).empty());
  EXPECT_THAT(lines_at(mesh, 3.1), ElementsAre(500, 1000, 1500));
  EXPECT_NEAR(measure(mesh).mass, steel_density * (12 * 0.012 + 9 * height * width), 1e-8);
}

TEST(Stiffeners, StandOnThePositionsThatTheyName) {
  BlockDescription block = test::small_block();
  block.stiffeners = {flat_bars("frames", Axis::z, 0.75)};
  block.stiffeners[0].positions = {2};
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_NEAR(measure(mesh).mass - measure(generate_shell_mesh(test::small_block())).mass,
              steel_density * 3 * 2 * height * width, 1e-7);
  for (const Beam& beam : mesh.beams) EXPECT_EQ(mesh.vertices[beam.vertices[0]].x(), 2);
  const std::array<Vector3, 3> supports{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}};
  const auto reactions = test::weigh(mesh, 2, supports);
  EXPECT_NEAR(reactions[0] + reactions[1] + reactions[2], 9.81 * measure(mesh).mass, 0.1);
}

// Cantilever of a plate strip with a bar along its middle, loaded at its end: bends about the
// common centroid of both. Euler and Bernoulli with Timoshenko's shear; 0.5 % are for the clamped
// end, where the strip cannot contract, and for the shear lag across the strip of a twentieth of
// its length.
TEST(Stiffeners, BendAboutTheCommonCentroid) {
  const double length = 4, breadth = 0.2, t = 0.012;
  for (const int side : {1, -1}) {
    BlockDescription block = panel(length, breadth, t);
    block.stiffeners = {flat_bars("deck", Axis::x, breadth / 2)};
    block.stiffeners[0].side = side;
    block.largest_element = 0.2;
    const Mesh mesh = generate_shell_mesh(block);
    const Space space(mesh, {2, {}});
    std::vector<FixedUnknown> fixed;
    examples::hold(
        space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
    const int end = examples::nearest_node(space, {length, breadth / 2, 0});
    load[6 * end + 2] = -1e3;
    const double deflection = -examples::solve(space, load, fixed)[6 * end + 2];

    const double strip = breadth * t, bar = height * width, arm = t / 2 + height / 2;
    const double centroid = bar * arm / (strip + bar);
    const double second_moment = breadth * std::pow(t, 3) / 12 + width * std::pow(height, 3) / 12 +
                                 strip * centroid * centroid +
                                 bar * (arm - centroid) * (arm - centroid);
    const Material& steel = mesh.materials[0];
    const double expected = 1e3 * std::pow(length, 3) / (3 * steel.youngs_modulus * second_moment) +
                            1e3 * length / (steel.shear_modulus() * 5 * (strip + bar) / 6);
    EXPECT_NEAR(deflection, expected, 0.005 * expected);
  }
}

std::string refusal(const Stiffeners& row) {
  BlockDescription block = panel(4, 2, 0.012);
  block.stiffeners = {row};
  try {
    generate_shell_mesh(block);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StiffenersErrors, SayWhatIsWrong) {
  const Stiffeners good = flat_bars("deck", Axis::x, 0.5);
  EXPECT_EQ(refusal(good), "accepted");
  Stiffeners row = good;
  row.plate = "dek";
  EXPECT_THAT(refusal(row), HasSubstr("\"bars\" stands on plate \"dek\", which the block does not "
                                      "have; its plates are deck"));
  row = good;
  row.spacing = 0;
  EXPECT_THAT(refusal(row), HasSubstr("\"bars\" has a spacing of 0 m; it must be positive"));
  row.spacing = 1e-9;
  EXPECT_THAT(refusal(row), HasSubstr("a spacing of 1e-09 m makes 2e+09 stiffeners on deck"));
  row = good;
  row.along = Axis::z;
  EXPECT_THAT(refusal(row), HasSubstr("\"bars\" runs along the normal of deck at z = 0 m"));
  row = good;
  row.section.area = 0;
  EXPECT_THAT(refusal(row), HasSubstr("\"bars\" has a section of 0 m^2"));
  row = good;
  row.material = "brass";
  EXPECT_THAT(refusal(row), HasSubstr("\"brass\", which is not among the materials: AH36"));
  row = good;
  row.side = 0;
  EXPECT_THAT(refusal(row), HasSubstr("stands on side 0"));
  row = good;
  row.name = "deck";
  EXPECT_THAT(refusal(row), HasSubstr("\"deck\" bears a name that another part has"));
}

}  // namespace
}  // namespace blocklift::structure
