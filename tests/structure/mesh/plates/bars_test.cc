// Bars from point to point among plates: what they are joined to, and how they bear.
#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/response/elastic_model.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/stress.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

constexpr double deck_thickness = 0.01, deck_height = 2;  // m
const Material bar_steel{"AH36", 206e9, 0.3, 7850, 355e6};

/// Two decks of 4 x 3 m, one over the other, with a bulkhead between them at x = 2 m.
BlockDescription two_decks() {
  BlockDescription block;
  block.name = "decks";
  block.materials = {bar_steel};
  block.largest_element = 0.5;
  block.plates = {
      {"deck", Axis::z, {0, deck_height}, {{{0, 4}, {0, 3}, {0, 0}}}, deck_thickness, "AH36"},
      {"bulkhead", Axis::x, {2}, {{{0, 0}, {0, 3}, {0, deck_height}}}, deck_thickness, "AH36"}};
  return block;
}

Bar bar_of(const std::string& name, std::vector<Vector3> points, const Profile& profile,
           const std::optional<Vector3>& towards = std::nullopt) {
  return {name, std::move(points), profile, towards, "AH36", false};
}

std::string complaint_of_bars(const std::vector<Bar>& bars) {
  BlockDescription block = two_decks();
  block.bars = bars;
  try {
    generate_shell_mesh(block);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

double length_of_bars(const Mesh& mesh, const std::string& group) {
  double length = 0;
  for (const Beam& beam : mesh.beams)
    if (mesh.group_of_region(beam.region).name == group)
      length += (mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]]).norm();
  return length;
}

bool has_vertex(const Mesh& mesh, const Vector3& place) {
  for (const Vector3& vertex : mesh.vertices)
    if ((vertex - place).norm() < 1e-6) return true;
  return false;
}

// A pillar from the middle of one deck to that of the other, and a brace that goes through the
// bulkhead and crosses the pillar.
TEST(Bars, AreJoinedToWhatTheyMeet) {
  BlockDescription block = two_decks();
  const Profile tube = pipe(0.08, 0.07), joist = i_beam(0.2, 0.008, 0.1, 0.012, 0.1, 0.012);
  block.bars = {bar_of("pillar", {{1, 1, 0}, {1, 1, deck_height}}, tube),
                bar_of("brace", {{0.5, 1, 0.5}, {1.5, 1, 1.5}, {2.5, 1, 1.5}, {2.5, 1, 0}}, joist,
                       Vector3::UnitY())};
  const Mesh mesh = generate_shell_mesh(block);
  check_mesh(mesh);
  for (const int part : connected_parts(mesh)) EXPECT_LE(part, 0);
  EXPECT_NEAR(length_of_bars(mesh, "pillar"), deck_height, 1e-9);
  EXPECT_NEAR(length_of_bars(mesh, "brace"), std::sqrt(2) + 1 + 1.5, 1e-9);
  EXPECT_TRUE(has_vertex(mesh, {1, 1, 1}));    // pillar and brace
  EXPECT_TRUE(has_vertex(mesh, {2, 1, 1.5}));  // brace and bulkhead
  const double plates = 2 * 12 + 3 * deck_height;
  EXPECT_NEAR(mass_properties(mesh).mass,
              bar_steel.density * (plates * deck_thickness + deck_height * tube.section.area +
                                   length_of_bars(mesh, "brace") * joist.section.area),
              1e-6);
  for (const Beam& beam : mesh.beams) EXPECT_LT(beam.offset[0].norm(), 1e-12);  // on their lines
}

// Along a plate a bar stands on its face; across its edge it has its foot on the edge.
TEST(Bars, StandOnThePlatesAlongWhichTheyRun) {
  BlockDescription block = two_decks();
  const Profile joist = i_beam(0.2, 0.008, 0.1, 0.012, 0.1, 0.012), flat = flat_bar(0.012, 0.1);
  block.bars = {
      bar_of("joist", {{0, 1, deck_height}, {4, 1, deck_height}}, joist, -Vector3::UnitZ()),
      bar_of("flange", {{0, 0, 0}, {2, 0, 0}}, flat, -Vector3::UnitY())};
  const Mesh mesh = generate_shell_mesh(block);
  for (const Beam& beam : mesh.beams) {
    const bool is_joist = mesh.group_of_region(beam.region).name == "joist";
    const Vector3 offset =
        is_joist ? Vector3(0, 0, -deck_thickness / 2 - 0.1) : Vector3(0, -0.006, 0);
    EXPECT_LT((beam.offset[0] - offset).norm(), 1e-12);
  }
  EXPECT_NEAR(length_of_bars(mesh, "joist"), 4, 1e-9);
  EXPECT_NEAR(length_of_bars(mesh, "flange"), 2, 1e-9);
}

// Both ends of the whole bar are hinges, what it crosses is none.
TEST(Bars, HingesAreAtTheEnds) {
  BlockDescription block = two_decks();
  block.bars = {bar_of("strut", {{1, 1, 0}, {2.5, 1, 1.5}}, pipe(0.08, 0.07))};
  block.bars[0].is_hinged = true;
  const Mesh mesh = generate_shell_mesh(block);
  constexpr BeamRelease hinge{false, false, false, false, true, true};
  int hinges = 0;
  for (const Beam& beam : mesh.beams)
    for (std::size_t end = 0; end < 2; ++end) {
      const Vector3& place = mesh.vertices[beam.vertices[end]];
      const bool is_end = (place - block.bars[0].points[0]).norm() < 1e-6 ||
                          (place - block.bars[0].points[1]).norm() < 1e-6;
      EXPECT_EQ(beam.release[end], is_end ? hinge : BeamRelease{});
      hinges += is_end ? 1 : 0;
    }
  EXPECT_EQ(hinges, 2);
}

TEST(Bars, SaysWhatIsWrong) {
  const Profile tube = pipe(0.08, 0.07), flat = flat_bar(0.15, 0.012);
  const std::vector<Vector3> upright{{1, 1, 0}, {1, 1, deck_height}};
  EXPECT_EQ(complaint_of_bars({bar_of("post", upright, tube)}), "");
  EXPECT_THAT(complaint_of_bars({bar_of("post", {{1, 1, 0.5}, {1, 1, 1}}, tube)}),
              HasSubstr("not joined to the rest of the block: post"));
  EXPECT_THAT(complaint_of_bars({bar_of("post", upright, tube), bar_of("again", upright, tube)}),
              HasSubstr("bar \"post\" lies upon bar \"again\""));
  EXPECT_THAT(complaint_of_bars({bar_of("post", upright, tube),
                                 bar_of("short", {{1, 1, 0.5}, {1, 1, deck_height}}, tube)}),
              HasSubstr("lies upon bar"));
  EXPECT_THAT(complaint_of_bars({bar_of("post", upright, flat)}),
              HasSubstr("stands towards nothing"));
  EXPECT_THAT(complaint_of_bars({bar_of("post", upright, flat, Vector3::UnitZ())}),
              HasSubstr("runs along the direction"));
  EXPECT_THAT(complaint_of_bars({bar_of("post", {{1, 1, 0}, {1, 1, 0}}, tube)}),
              HasSubstr("in one place"));
  Bar foreign = bar_of("post", upright, tube);
  foreign.material = "wood";
  EXPECT_THAT(complaint_of_bars({foreign}), HasSubstr("wood"));
}

// A beam between two square plates, hung where it meets them, so that nothing holds its ends: M = q
// L^2 / 8 in its middle, whatever the plates weigh, and sigma = M r / I.
TEST(Bars, BearTheirOwnWeightBetweenLugs) {
  constexpr double length = 8, radius = 0.15, gravity = 9.81;
  const Profile tube = pipe(radius, 0.14);
  BlockDescription block;
  block.name = "dumb-bell";
  block.materials = {bar_steel};
  block.largest_element = 0.25;
  block.plates = {
      {"end", Axis::x, {0, length}, {{{0, 0}, {-0.5, 0.5}, {-0.5, 0.5}}}, 0.05, "AH36"}};
  block.bars = {bar_of("tube", {{0, 0, 0}, {length, 0, 0}}, tube)};
  Mesh mesh = generate_shell_mesh(block);
  for (const double x : {0.0, length})
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if ((mesh.vertices[v] - Vector3(x, 0, 0)).norm() < 1e-6)
        mesh.lifting_points.push_back({.name = "L" + std::to_string(v),
                                       .p_BPin = mesh.vertices[v],
                                       .radius = 0.1,
                                       .vertex = static_cast<int>(v)});
  ASSERT_EQ(mesh.lifting_points.size(), 2U);
  const ElasticModel model(std::move(mesh), {.degree = 2, .largest_edge = {}}, {}, {});
  const UnitResponses responses(model);
  LoadCase at_rest{"at rest", {}, {}};
  at_rest.field.acceleration_less_gravity = Vector3(0, 0, gravity);
  at_rest.lug_forces_B.assign(2, {0, 0, model.mass_properties().mass * gravity / 2});
  const LoadCaseResult result = StressRecovery(responses).evaluate(at_rest);
  const double q = bar_steel.density * gravity * tube.section.area;
  const double stress = q * length * length / 8 * radius / tube.section.second_moment_3;
  double found = 0;
  for (const auto& group : result.groups)
    if (group.group == "tube") found = group.checked_von_mises.value;
  EXPECT_NEAR(found, stress, 1e-6 * stress);
}

}  // namespace
}  // namespace blocklift::structure
