// Shells of stiffened blocks: conforming, of the area and mass that hand sums give, with the right
// names.
#include "structure/mesh/plates/shell_generator.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/structure/formulation/gravity.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/mesh/plates/mesh_measures.h"

namespace blocklift::structure {
namespace {

using test::cross_of_plates;
using test::expect_conforming;
using test::measure;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

constexpr double density = 7850;  // kg/m^3

std::set<long> lines_across(const Mesh& mesh, int axis, const std::string& group) {
  std::set<long> lines;
  for (const Shell& shell : mesh.shells)
    if (mesh.group_of_region(shell.region).name == group)
      for (const int v : shell.vertices) lines.insert(std::lround(mesh.vertices[v][axis] * 1e3));
  return lines;
}

TEST(ShellGenerator, MassIsThatOfTheMidPlanes) {
  const Mesh mesh = generate_shell_mesh(cross_of_plates());
  expect_conforming(mesh);
  const auto steel = measure(mesh);
  EXPECT_NEAR(steel.area, 2 * 1 + 1 * 1, 1e-10);
  EXPECT_NEAR(steel.mass, density * (2 * 1 * 0.02 + 1 * 1 * 0.01), 1e-9);
  EXPECT_LT((steel.centre - Vector3(1, 0.5, 0)).norm(), 1e-10);
  EXPECT_NEAR(test::joint_length(mesh), 1, 1e-10);
}

TEST(ShellGenerator, LargestElementIsHonoured) {
  for (const double largest : {0.6, 0.25, 0.1}) {
    BlockDescription block = cross_of_plates();
    block.largest_element = largest;
    const Mesh mesh = generate_shell_mesh(block);
    expect_conforming(mesh);
    double longest = 0;
    for (const Shell& shell : mesh.shells) longest = std::max(longest, longest_edge(mesh, shell));
    EXPECT_LE(longest, largest * (1 + 1e-9));
    EXPECT_GE(longest, largest / 2);
  }
}

TEST(ShellGenerator, EdgesWithinAPlateEndOnItsMidPlane) {
  // Drawn to either face, to the mid-plane or between them: the same shells.
  for (const double end : {-0.01, 0.0, 0.004, 0.01}) {
    BlockDescription block = cross_of_plates();
    block.plates[1].positions = {0};
    block.plates[1].extent[2] = {end, 0.5};
    block.plates[0].extent[0] = {-end / 2, 2};
    const Mesh mesh = generate_shell_mesh(block);
    expect_conforming(mesh);
    const auto steel = measure(mesh);
    EXPECT_NEAR(steel.area_of_group.at("flat"), 2, 1e-10);
    EXPECT_NEAR(steel.area_of_group.at("upright"), 0.5, 1e-10);
    EXPECT_NEAR(test::joint_length(mesh), 1, 1e-10);
  }
}

TEST(ShellGenerator, RegionsAreSheetsAndGroupsAreNames) {
  BlockDescription block = test::small_block();
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  check_mesh(mesh);
  std::vector<std::string> groups, regions;
  for (const Group& group : mesh.groups) groups.push_back(group.name);
  for (std::size_t r = 0; r < 6; ++r) regions.push_back(mesh.regions[r].name);
  EXPECT_THAT(groups, ElementsAre("bottom", "sides", "frames", "pad_L1", "pad_L2", "pad_L3",
                                  "pad_L4", "L1", "L2", "L3", "L4"));
  EXPECT_THAT(regions, ElementsAre("bottom at z = 0 m", "sides at y = 0 m", "sides at y = 3 m",
                                   "frames at x = 0 m", "frames at x = 2 m", "frames at x = 4 m"));
  for (const Region& region : mesh.regions)
    EXPECT_EQ(region.is_lug, mesh.groups[region.group].name.front() == 'L') << region.name;
  for (std::size_t s = 0; s < mesh.shells.size(); ++s)
    EXPECT_EQ(mesh.shells[s].label, static_cast<long>(s) + 1);
}

TEST(ShellGenerator, PadsAreThickOnTheSameMidPlane) {
  const Mesh mesh = generate_shell_mesh(test::small_block());
  const auto steel = measure(mesh);
  EXPECT_NEAR(steel.area_of_group.at("pad_L1"), 0.8 * 0.8, 1e-10);
  EXPECT_NEAR(steel.area_of_group.at("L1"), 0.8 * 0.4, 1e-10);
  EXPECT_NEAR(steel.area_of_group.at("sides"), 2 * 4 * 2 - 4 * 0.64, 1e-10);
  const double volume =
      12 * 0.020 + (16 - 4 * 0.64) * 0.015 + 3 * 6 * 0.012 + 4 * (0.64 + 0.32) * 0.035;
  EXPECT_NEAR(steel.mass, density * volume, 1e-8);
  EXPECT_NEAR(steel.centre.x(), 2, 1e-10);
  EXPECT_NEAR(steel.centre.y(), 1.5, 1e-10);
  for (const Shell& shell : mesh.shells)
    if (mesh.group_of_region(shell.region).name == "pad_L2") {
      EXPECT_EQ(mesh.section_of(shell).thickness, 0.035);
      EXPECT_EQ(mesh.section_of(shell).offset, 0);
    }
}

TEST(ShellGenerator, LiftingPointsKnowTheirLugAndPad) {
  const Mesh mesh = generate_shell_mesh(test::small_block());
  ASSERT_EQ(mesh.lifting_points.size(), 4U);
  const LiftingPoint& lug = mesh.lifting_points[2];
  EXPECT_EQ(lug.name, "L3");
  EXPECT_EQ(mesh.regions[lug.region].name, "L3 at y = 3 m");
  EXPECT_EQ(mesh.regions[lug.pad_region].name, "pad_L3 at y = 3 m");
  EXPECT_LT((lug.p_BPin - Vector3(0.4, 3, 2.25)).norm(), 1e-10);
  EXPECT_NEAR(lug.radius, std::hypot(0.4, 2.25 - 1.2), 1e-10);  // to the pad's lower corners
}

TEST(ShellGenerator, ALugMayLieInItsPadOrStandAcrossIt) {
  BlockDescription block = test::small_block();
  block.lugs[0].extent[2] = {1.6, 2.4};  // half of it in the pad: lug there
  const auto steel = measure(generate_shell_mesh(block));
  EXPECT_NEAR(steel.area_of_group.at("L1"), 0.8 * 0.8, 1e-10);
  EXPECT_NEAR(steel.area_of_group.at("pad_L1"), 0.8 * 0.4, 1e-10);

  block = test::small_block();  // from the pad's face outwards, normal to x
  block.lugs[0] = {"L1", "pad_L1", Axis::x,         0.4, {{{}, {-0.4, -0.0175}, {1.4, 1.8}}},
                   0.03, "",       {0.4, -0.3, 1.6}};
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_NEAR(measure(mesh).area_of_group.at("L1"), 0.4 * 0.4, 1e-10);
}

TEST(ShellGenerator, OpeningsCutTheirPlateOnly) {
  BlockDescription block = cross_of_plates();
  block.openings = {{"hole", "flat", {}, {{{0.8, 1.2}, {0.3, 0.7}, {}}}}};
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  const auto steel = measure(mesh);
  EXPECT_NEAR(steel.area_of_group.at("flat"), 2 - 0.4 * 0.4, 1e-10);
  EXPECT_NEAR(steel.area_of_group.at("upright"), 1, 1e-10);
  EXPECT_NEAR(test::joint_length(mesh), 1 - 0.4, 1e-10);
}

TEST(ShellGenerator, OpeningsCutThePositionsThatTheyName) {
  BlockDescription block = test::small_block();
  block.openings = {{"hole", "frames", {2}, {{{}, {1, 2}, {0.5, 1.5}}}}};
  const auto steel = measure(generate_shell_mesh(block));
  EXPECT_NEAR(steel.area_of_region.at("frames at x = 2 m"), 5, 1e-10);
  EXPECT_NEAR(steel.area_of_region.at("frames at x = 4 m"), 6, 1e-10);
}

TEST(ShellGenerator, PlatesOfOtherThicknessInOnePlaneMeet) {
  BlockDescription block = cross_of_plates();
  block.plates.push_back({"thin", Axis::z, {0}, {{{2, 3}, {0, 1}, {}}}, 0.012, "AH36"});
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_NEAR(measure(mesh).mass, density * (0.04 + 0.01 + 0.012), 1e-9);
  EXPECT_NEAR(test::joint_length(mesh), 2, 1e-10);
}

TEST(ShellGenerator, CutsStayWhereTheyAreNeeded) {
  // A bracket on the upright plate: its cuts divide that plate, and not the flat one, which it does
  // not touch.
  BlockDescription block = cross_of_plates();
  block.plates[0].extent[0] = {0, 10};
  block.largest_element = 1;
  block.plates.push_back({"bracket", Axis::y, {0.5}, {{{1, 1.2}, {}, {0.2, 0.4}}}, 0.01, "AH36"});
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  EXPECT_EQ(lines_across(mesh, 0, "flat").size(), 11U);
  EXPECT_EQ(lines_across(mesh, 0, "flat").count(1200), 0U);
  EXPECT_THAT(lines_across(mesh, 2, "upright"), UnorderedElementsAre(-500, 0, 200, 400, 500));
  EXPECT_THAT(lines_across(mesh, 1, "upright"), UnorderedElementsAre(0, 500, 1000));
}

TEST(ShellGenerator, TotalsDoNotDependOnHowPlatesAreDivided) {
  const auto whole = measure(generate_shell_mesh(test::small_block()));
  BlockDescription block = test::small_block();
  block.plates[0].extent[0] = {0, 1.37};
  block.plates.push_back(block.plates[0]);
  block.plates.back().name = "bottom_fore";
  block.plates.back().extent[0] = {1.37, 4};
  block.largest_element = 0.45;
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  const auto divided = measure(mesh);
  EXPECT_NEAR(divided.area, whole.area, 1e-10);
  EXPECT_NEAR(divided.mass, whole.mass, 1e-7);
  EXPECT_LT((divided.centre - whole.centre).norm(), 1e-11);
}

TEST(ShellGenerator, HullBlockIsConforming) {
  const Mesh mesh = generate_shell_mesh(test::hull_block());
  expect_conforming(mesh);
  check_mesh(mesh);
  EXPECT_EQ(mesh.lifting_points.size(), 6U);
  const std::vector<int> part = connected_parts(mesh);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 0);
}

// Positive definite with six freedoms held: one piece without mechanisms. The weight divides among
// the supports as statics says, so the elements join where they should.
TEST(ShellGenerator, SmallBlockBearsItsWeight) {
  const Mesh mesh = generate_shell_mesh(test::small_block());
  const auto steel = measure(mesh);
  const std::array<Vector3, 3> supports{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}};
  const auto reactions = test::weigh(mesh, 2, supports);
  const double weight = 9.81 * steel.mass;
  EXPECT_NEAR(reactions[1], weight * steel.centre.x() / 4, 1e-6 * weight);
  EXPECT_NEAR(reactions[2], weight * steel.centre.y() / 3, 1e-6 * weight);
  EXPECT_NEAR(reactions[0] + reactions[1] + reactions[2], weight, 1e-6 * weight);
}

}  // namespace
}  // namespace blocklift::structure
