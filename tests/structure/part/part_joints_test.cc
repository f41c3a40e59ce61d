// Bodies of a part that share no node: where they meet, and how they are joined.
#include "structure/elasticity/part_joints.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/elasticity/natural_modes.h"
#include "structure/elasticity/rigid_freedom.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/output/part_files.h"
#include "structure/part/part_solution.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

/// A plate from (x0, y0, z0) on, its numbers of elements along x, y and z. Its groups: NAME, its
/// ends NAME0 and NAME1 at the least and the largest x.
struct PlateToMesh {
  std::string name;
  Vector3 from, size;
  std::array<int, 3> counts;
};

std::string script_of(const PlateToMesh& plate, int first) {
  const auto point = [&](int i, double x, double y) {
    return fmt::format("Point({}) = {{{:.9g}, {:.9g}, {:.9g}}};\n", first + i, x, y,
                       plate.from.z());
  };
  const Vector3 to = plate.from + plate.size;
  std::string text = point(1, plate.from.x(), plate.from.y()) + point(2, to.x(), plate.from.y()) +
                     point(3, to.x(), to.y()) + point(4, plate.from.x(), to.y());
  for (int i = 1; i <= 4; ++i)
    text += fmt::format("Line({}) = {{{}, {}}};\n", first + i, first + i, first + i % 4 + 1);
  text += fmt::format(
      "Curve Loop({0}) = {{{1}, {2}, {3}, {4}}}; Plane Surface({0}) = {{{0}}};\n"
      "Transfinite Curve{{{1}, {3}}} = {5}; Transfinite Curve{{{2}, {4}}} = {6};\n"
      "Transfinite Surface{{{0}}}; Recombine Surface{{{0}}};\n"
      "out{0}[] = Extrude{{0, 0, {7:.9g}}}{{ Surface{{{0}}}; Layers{{{8}}}; Recombine; }};\n"
      "Physical Volume(\"{9}\") = {{out{0}[1]}};\nPhysical Surface(\"{9}0\") = {{out{0}[5]}};\n"
      "Physical Surface(\"{9}1\") = {{out{0}[3]}};\n",
      first, first + 1, first + 2, first + 3, first + 4, plate.counts[0] + 1, plate.counts[1] + 1,
      plate.size.z(), plate.counts[2], plate.name);
  return text;
}

/// The plates are meshed far from one another, for Gmsh makes one of what coincides, and then put
/// into their places.
PartModel model_of(const std::vector<PlateToMesh>& plates) {
  const auto path =
      std::filesystem::temp_directory_path() / fmt::format("blocklift-joints-{}.geo", ::getpid());
  std::ofstream file(path);
  const auto aside = [](std::size_t plate) {
    return Vector3(0, 10 * static_cast<double>(plate), 0);
  };
  for (std::size_t p = 0; p < plates.size(); ++p) {
    PlateToMesh moved = plates[p];
    moved.from += aside(p);
    file << script_of(moved, 1 + 1000 * static_cast<int>(p));
  }
  file.close();
  PartModel model;
  model.mesh = read_part_mesh(path.string(), {});
  std::filesystem::remove(path);
  for (Eigen::Index n = 0; n < model.mesh.nodes.cols(); ++n)
    model.mesh.nodes.col(n) -=
        aside(static_cast<std::size_t>(std::floor((model.mesh.nodes(1, n) + 1) / 10)));
  model.materials = {{"steel", 206e9, 0.3, 7850, 235e6}};
  model.material_of_solid.assign(model.mesh.solids.size(), 0);
  return model;
}

/// A plate of 2 x 0.3 m, 50 mm thick, in two halves; the second begins `gap` after the first, and
/// its elements do not match.
std::vector<PlateToMesh> halves(double gap) {
  return {{"left", {0, 0, 0}, {1, 0.3, 0.05}, {10, 3, 1}},
          {"right", {1 + gap, 0, 0}, {1 - gap, 0.3, 0.05}, {14, 5, 2}}};
}

const std::vector<PlateToMesh> whole{{"left", {0, 0, 0}, {2, 0.3, 0.05}, {20, 3, 1}}};

/// Clamped at its left end, pressed down and sideways at its right one.
void load_as_cantilever(PartModel& model, const std::string& last) {
  model.supports = {{"root", "left0", {true, true, true}, Vector3::Zero()}};
  model.surface_loads = {{"tip", last + "1", SurfaceLoad::Kind::force, 0, Vector3(0, 5e3, -1e3)}};
}

void join(PartModel& model, double within) {
  std::vector<int> support_of;
  model.joints = find_part_joints(model.mesh, part_supports(model, support_of), within);
}

// Freedoms that follow others do so exactly in all fields that are linear in place, across a gap
// too: shares sum to one, and places they weigh to the node's own place.
TEST(PartJoints, TiesPassFieldsThatAreLinearInPlace) {
  PartModel model = model_of(halves(0.8e-3));
  join(model, 1e-3);
  ASSERT_EQ(model.joints.meetings.size(), 1U);
  const PartMeeting& meeting = model.joints.meetings[0];
  EXPECT_NEAR(meeting.gap, 0.8e-3, 1e-9);
  EXPECT_NEAR(meeting.largest_gap, 0.8e-3, 1e-9);
  // All nodes of the finer end: 5 x 2 quadratic faces have 6 x 3 corners, 5 x 3 + 6 x 2 middles.
  EXPECT_EQ(meeting.tied_nodes, 45);
  ASSERT_EQ(model.joints.ties.size(), 135U);
  for (const PartTie& tie : model.joints.ties) {
    double sum = 0;
    Vector3 place = Vector3::Zero();
    for (std::size_t i = 0; i < tie.followed.size(); ++i) {
      EXPECT_EQ(tie.followed[i] % 3, tie.freedom % 3);
      sum += tie.shares[i];
      place += tie.shares[i] * model.mesh.nodes.col(tie.followed[i] / 3);
    }
    EXPECT_NEAR(sum, 1, 1e-10);
    EXPECT_LT((place - model.mesh.nodes.col(tie.freedom / 3)).norm(), 1e-10);
  }
}

// Two halves whose meshes do not match deflect and swing as the plate in one piece: both are the
// same beam within the discretisation, which the whole in 20 x 3 x 1 and the halves in 24 elements
// along it leave below 0.5 % (deflection) and 0.5 % (frequency).
TEST(PartJoints, HalvesBendAsTheWhole) {
  PartModel one = model_of(whole);
  load_as_cantilever(one, "left");
  const PartSolution of_one = solve_part(one);
  const double frequency_of_one = find_part_modes(one, 1).frequencies[0];
  const Vector3 tip(2, 0.15, 0.025);
  for (const double gap : {0.0, 0.5e-3}) {
    PartModel two = model_of(halves(gap));
    load_as_cantilever(two, "right");
    join(two, 1e-3);
    const PartSolution of_two = solve_part(two);
    const Vector3 expected = probe_part(one, of_one, tip).displacement;
    const Vector3 found = probe_part(two, of_two, tip).displacement;
    EXPECT_NEAR(found.z(), expected.z(), 5e-3 * std::abs(expected.z())) << gap;
    EXPECT_NEAR(found.y(), expected.y(), 5e-3 * std::abs(expected.y())) << gap;
    // Forces and moments pass the joint whole.
    EXPECT_LT(of_two.force_residual, 1e-8);
    EXPECT_LT(of_two.moment_residual, 1e-8);
    EXPECT_NEAR(find_part_modes(two, 1).frequencies[0], frequency_of_one, 5e-3 * frequency_of_one);
  }
}

// Joined bodies move as one: the second is not free, and nothing strains in the six motions of all.
TEST(PartJoints, JoinedBodiesAreOne) {
  PartModel model = model_of(halves(0));
  EXPECT_EQ(find_rigid_freedom(model, {}).count, 12);
  join(model, 1e-3);
  const RigidFreedom freedom = find_rigid_freedom(model, {});
  EXPECT_EQ(freedom.count, 6);
  EXPECT_EQ(freedom.bodies, 1);
  EXPECT_EQ(find_part_modes(model, 7).rigid_motions, 6);
}

// Without a join meetings are found all the same, with place and gap; nothing is tied.
TEST(PartJoints, MeetingsAreFoundWithoutBeingAsked) {
  PartModel model = model_of(halves(0.5e-3));
  const PartJoints joints = find_part_joints(model.mesh, {}, std::nullopt);
  EXPECT_TRUE(joints.ties.empty());
  ASSERT_EQ(joints.meetings.size(), 1U);
  EXPECT_NEAR(joints.meetings[0].gap, 0.5e-3, 1e-9);
  EXPECT_NEAR(joints.meetings[0].place.x(), 1, 1e-3);
  EXPECT_THAT(joints.meetings[0].bodies[0], HasSubstr("\"left\" about (0.5, 0.15, 0.025) m"));
  EXPECT_EQ(joints.meetings[0].tied_nodes, 0);
  // 40 mm are no touch of elements of 17 mm at least.
  EXPECT_TRUE(find_part_joints(model_of(halves(40e-3)).mesh, {}, std::nullopt).meetings.empty());
}

// A plate on another: what faces away from the other is not joined, however far `within` reaches.
TEST(PartJoints, FarSidesStayFree) {
  const PartModel model = model_of({{"left", {0, 0, 0}, {1, 0.4, 0.02}, {8, 4, 1}},
                                    {"right", {0.3, 0.1, 0.02}, {0.4, 0.2, 0.02}, {8, 4, 1}}});
  const PartJoints joints = find_part_joints(model.mesh, {}, 0.03);
  ASSERT_EQ(joints.meetings.size(), 1U);
  for (const PartTie& tie : joints.ties)
    EXPECT_NEAR(model.mesh.nodes(2, tie.freedom / 3), 0.02, 1e-9);
  // 8 x 4 quadratic faces: 9 x 5 corners, 8 x 5 + 9 x 4 middles.
  EXPECT_EQ(joints.meetings[0].tied_nodes, 121);
}

// Bodies that stand apart by many thicknesses are joined where that is asked for: two thin plates,
// one above the other, in elements of 20 mm thickness. What of the upper one lies over the lower
// follows.
TEST(PartJoints, ReachAsFarAsIsAsked) {
  const PartModel model = model_of({{"left", {0, 0, 0}, {1, 0.4, 0.02}, {8, 4, 1}},
                                    {"right", {0.3, 0.1, 0.42}, {0.4, 0.2, 0.02}, {8, 4, 1}}});
  const PartJoints joints = find_part_joints(model.mesh, {}, 0.401);
  ASSERT_EQ(joints.meetings.size(), 1U);
  EXPECT_NEAR(joints.meetings[0].gap, 0.4, 1e-9);
  EXPECT_NEAR(joints.meetings[0].largest_gap, 0.4, 1e-9);
  EXPECT_EQ(joints.meetings[0].tied_nodes, 121);
}

// A small body in the middle of one face of another, which has no node there, follows it.
TEST(PartJoints, ASmallBodyFollowsALargeFace) {
  const PartModel model = model_of({{"left", {0.4, 0.4, 0.1}, {0.1, 0.1, 0.1}, {1, 1, 1}},
                                    {"right", {0, 0, 0}, {1, 1, 0.1}, {1, 1, 1}}});
  const PartJoints joints = find_part_joints(model.mesh, {}, 1e-3);
  ASSERT_EQ(joints.meetings.size(), 1U);
  EXPECT_EQ(joints.meetings[0].tied_nodes, 8);  // four corners, four middles
  for (const PartTie& tie : joints.ties)
    EXPECT_NEAR(model.mesh.nodes(2, tie.freedom / 3), 0.1, 1e-9);
}

// What a support holds follows nothing: its other axes do.
TEST(PartJoints, HeldFreedomsDoNotFollow) {
  PartModel model = model_of(halves(0));
  model.supports = {{"plane", "right0", {false, true, false}, Vector3::Zero()}};
  join(model, 1e-3);
  EXPECT_EQ(model.joints.ties.size(), 90U);
  for (const PartTie& tie : model.joints.ties) EXPECT_NE(tie.freedom % 3, 1);
}

// CalculiX has the ties as equations. It reads 20 characters of a number: loads of rounding's size
// at corners lost their exponents' ends, and pushed by tenths of a newton.
TEST(PartJoints, AreEquationsOfCalculix) {
  PartModel model = model_of(halves(0));
  load_as_cantilever(model, "right");
  join(model, 1e-3);
  const auto path =
      std::filesystem::temp_directory_path() / fmt::format("blocklift-joints-{}.inp", ::getpid());
  write_calculix(path.string(), model);
  std::ifstream file(path);
  std::size_t equations = 0, longest = 0;
  for (std::string line; std::getline(file, line);) {
    if (line == "*EQUATION") ++equations;
    if (line.starts_with('*')) continue;
    std::stringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      longest =
          std::max(longest, field.size() - std::min(field.find_first_not_of(' '), field.size()));
  }
  std::filesystem::remove(path);
  EXPECT_EQ(equations, model.joints.ties.size());
  EXPECT_LE(longest, 20U);
}

// A volume of the geometry is listed by the name that the file gives it, once.
TEST(PartJoints, GroupsAreListedOnce) {
  PartModel model = model_of(halves(0));
  load_as_cantilever(model, "right");
  join(model, 1e-3);
  std::vector<std::string> names;
  for (const PartGroupResult& group : solve_part(model).groups) names.push_back(group.group);
  EXPECT_THAT(names, ::testing::ElementsAre("left", "right"));
}

}  // namespace
}  // namespace blocklift::structure
