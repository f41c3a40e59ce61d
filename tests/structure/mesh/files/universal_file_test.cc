// Universal files of I-DEAS, as Salome writes them: all elements carry the same numbers of
// properties, and groups alone tell them apart.
#include "structure/mesh/files/universal_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/mesh/files/surfaces/surface_reader.h"
#include "structure/part/part_solution.h"

namespace blocklift::structure {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

struct UniversalCell {
  int descriptor = 0;
  std::vector<int> nodes;
};

struct UniversalSet {
  std::string name;
  int kind = 8;  ///< of its members: 7 nodes, 8 elements
  std::vector<int> members;
};

std::string text_of(const std::vector<Vector3>& nodes, const std::vector<UniversalCell>& cells,
                    const std::vector<UniversalSet>& sets) {
  std::string text = "    -1\n   164\n         1  SI: Meter (newton)         2\n    -1\n";
  text += "    -1\n  2411\n";
  for (std::size_t n = 0; n < nodes.size(); ++n)
    text += fmt::format("{:10}{:10}{:10}{:10}\n{:25.16E}{:25.16E}{:25.16E}\n", n + 1, 1, 1, 11,
                        nodes[n].x(), nodes[n].y(), nodes[n].z());
  text += "    -1\n    -1\n  2412\n";
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto& [descriptor, corners] = cells[c];
    text +=
        fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}\n", c + 1, descriptor, 2, 1, 7, corners.size());
    if (descriptor < 30) text += "         0         1         1\n";
    for (std::size_t n = 0; n < corners.size(); ++n)
      text += fmt::format("{:10}{}", corners[n], n % 8 == 7 || n + 1 == corners.size() ? "\n" : "");
  }
  text += "    -1\n    -1\n  2467\n";
  for (std::size_t s = 0; s < sets.size(); ++s) {
    text += fmt::format("{:10}", s + 1);
    for (int zero = 0; zero < 6; ++zero) text += fmt::format("{:10}", 0);
    text += fmt::format("{:10}\n{}\n", sets[s].members.size(), sets[s].name);
    for (std::size_t m = 0; m < sets[s].members.size(); ++m)
      text += fmt::format("{:10}{:10}{:10}{:10}{}", sets[s].kind, sets[s].members[m], 0, 0,
                          m % 2 == 1 || m + 1 == sets[s].members.size() ? "\n" : "");
  }
  return text + "    -1\n";
}

class UniversalFiles : public ::testing::Test {
 protected:
  UniversalFiles()
      : folder_(fs::temp_directory_path() / ("blocklift-universal-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~UniversalFiles() override { fs::remove_all(folder_); }

  std::string write(const std::string& text) const {
    std::ofstream(folder_ / "mesh.unv") << text;
    return (folder_ / "mesh.unv").string();
  }
  std::string error_of(const std::string& text) const {
    try {
      read_part_mesh(write(text), {});
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

/// Two hexahedra, 2 x 1 x 1 m.
const std::vector<Vector3> two_cubes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0},
                                        {1, 1, 0}, {2, 1, 0}, {0, 0, 1}, {1, 0, 1},
                                        {2, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}};
const std::vector<UniversalCell> cubes = {
    {115, {1, 2, 5, 4, 7, 8, 11, 10}}, {115, {2, 3, 6, 5, 8, 9, 12, 11}}, {44, {3, 6, 12, 9}}};
const std::vector<UniversalSet> sets_of_cubes = {{"bodies", 8, {1, 2}},
                                                 {"end", 8, {3}},
                                                 {"root", 7, {1, 4, 7, 10}},
                                                 {"corner", 7, {3}},
                                                 {"second", 8, {2}}};

PartModel steel_model(PartMesh mesh) {
  PartModel model;
  model.mesh = std::move(mesh);
  model.materials = {{"steel", 200e9, 0, 8000, 235e6}};
  model.material_of_solid.assign(model.mesh.solids.size(), 0);
  return model;
}

// The second group has the number that Salome gives every element as that of its property.
TEST_F(UniversalFiles, GroupsTellPlatesApart) {
  const std::string file = write(text_of(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 0, 1}, {1, 0, 1}},
      {{44, {1, 2, 5, 4}}, {94, {2, 3, 6, 5}}, {44, {1, 2, 8, 7}}, {21, {7, 8}}},
      {{"deck", 8, {1, 2}}, {"web", 8, {3}}, {"frames", 8, {4}}}));
  SurfaceReading reading;
  reading.units = unit_system("m-kg-N");
  reading.given.bars = {"frames"};
  const Deck deck = read_surfaces(file, reading);
  EXPECT_THAT(deck.groups_without_thickness, ElementsAre("deck", "web"));
  EXPECT_THAT(deck.groups_without_section, ElementsAre("frames"));
  std::vector<std::string> groups;
  for (const Shell& shell : deck.mesh.shells)
    groups.push_back(deck.mesh.group_of_region(shell.region).name);
  std::sort(groups.begin(), groups.end());
  EXPECT_THAT(groups, ElementsAre("deck", "deck", "web"));
  EXPECT_EQ(deck.mesh.vertices.size(), 8u);
  EXPECT_EQ(deck.mesh.beams.size(), 1u);
}

TEST_F(UniversalFiles, GroupsOfAPart) {
  const PartMesh mesh = read_part_mesh(write(text_of(two_cubes, cubes, sets_of_cubes)), {});
  const auto expect_group = [&](const char* name, int dimension, std::size_t elements) {
    const PartGroup* group = mesh.find_group(name);
    ASSERT_NE(group, nullptr) << name;
    EXPECT_EQ(group->dimension, dimension) << name;
    EXPECT_EQ(group->elements.size(), elements) << name;
  };
  expect_group("bodies", 3, 2);
  expect_group("second", 3, 1);
  expect_group("end", 2, 1);
  expect_group("root", 2, 1);  // its nodes are those of an outer face
  expect_group("corner", 0, 1);
}

// What holds the four nodes of a face holds the middles of the raised element, too.
TEST_F(UniversalFiles, PartIsSolved) {
  PartReading reading;
  reading.length_unit = 1e-3;
  PartModel model =
      steel_model(read_part_mesh(write(text_of(two_cubes, cubes, sets_of_cubes)), reading));
  model.supports = {{"root", "root", {true, true, true}, Vector3::Zero()}};
  model.surface_loads = {{"pull", "end", SurfaceLoad::Kind::force, 0, Vector3(100, 0, 0)}};
  const PartSolution solution = solve_part(model);
  EXPECT_NEAR(solution.all.von_mises, 100e6, 1);  // 100 N on 1 mm^2
  EXPECT_NEAR(solution.all.displacement, 2e-3 * 100e6 / 200e9, 1e-14);
}

/// Corners and the middles between them, in the file's order, as nodes of their own.
UniversalCell with_middles(int descriptor, const std::vector<Vector3>& corners,
                           const std::vector<std::pair<int, int>>& order,
                           std::vector<Vector3>& nodes) {
  UniversalCell cell{descriptor, {}};
  for (const auto& [a, b] : order) {
    nodes.push_back((corners[static_cast<std::size_t>(a)] + corners[static_cast<std::size_t>(b)]) /
                    2);
    cell.nodes.push_back(static_cast<int>(nodes.size()));
  }
  return cell;
}

// Nodes go round the edges, middles between the corners: each middle of a straight edge lies
// halfway between the corners that the element has there.
TEST_F(UniversalFiles, MiddlesLieBetweenTheirCorners) {
  std::vector<Vector3> nodes;
  const UniversalCell tetrahedron = with_middles(
      118, {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 5}},
      {{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}, {3, 3}}, nodes);
  const UniversalCell wedge =
      with_middles(113, {{9, 0, 0}, {12, 0, 0}, {9, 2, 0}, {9, 0, 5}, {12, 0, 6}, {9, 2, 7}},
                   {{0, 0},
                    {0, 1},
                    {1, 1},
                    {1, 2},
                    {2, 2},
                    {2, 0},
                    {0, 3},
                    {1, 4},
                    {2, 5},
                    {3, 3},
                    {3, 4},
                    {4, 4},
                    {4, 5},
                    {5, 5},
                    {5, 3}},
                   nodes);
  const UniversalCell hexahedron =
      with_middles(116,
                   {{20, 0, 0},
                    {23, 0, 0},
                    {24, 2, 0},
                    {20, 3, 0},
                    {20, 0, 5},
                    {23, 0, 6},
                    {24, 2, 7},
                    {20, 3, 4}},
                   {{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 0}, {0, 4}, {1, 5},
                    {2, 6}, {3, 7}, {4, 4}, {4, 5}, {5, 5}, {5, 6}, {6, 6}, {6, 7}, {7, 7}, {7, 4}},
                   nodes);
  const PartMesh mesh =
      read_part_mesh(write(text_of(nodes, {tetrahedron, wedge, hexahedron}, {})), {});
  // Edges by corners and, after all corners, the middles, as Gmsh's manual orders them.
  const std::map<int, std::vector<std::array<int, 3>>> edges_by_nodes = {
      {10, {{0, 1, 4}, {1, 2, 5}, {2, 0, 6}, {3, 0, 7}, {2, 3, 8}, {1, 3, 9}}},
      {15,
       {{0, 1, 6},
        {0, 2, 7},
        {0, 3, 8},
        {1, 2, 9},
        {1, 4, 10},
        {2, 5, 11},
        {3, 4, 12},
        {3, 5, 13},
        {4, 5, 14}}},
      {20,
       {{0, 1, 8},
        {0, 3, 9},
        {0, 4, 10},
        {1, 2, 11},
        {1, 5, 12},
        {2, 3, 13},
        {2, 6, 14},
        {3, 7, 15},
        {4, 5, 16},
        {4, 7, 17},
        {5, 6, 18},
        {6, 7, 19}}}};
  ASSERT_EQ(mesh.solids.size(), 3u);
  for (const int solid : mesh.solids)
    for (const auto& [a, b, middle] : edges_by_nodes.at(mesh.kind(solid).nodes)) {
      const Vector3 between =
          (mesh.nodes.col(mesh.node(solid, a)) + mesh.nodes.col(mesh.node(solid, b))) / 2;
      EXPECT_NEAR((mesh.nodes.col(mesh.node(solid, middle)) - between).norm(), 0, 1e-12)
          << mesh.kind(solid).name << ", edge " << a << " to " << b;
    }
}

// Gmsh writes the group of a point as its node and as an element that it does not write.
TEST_F(UniversalFiles, PointsOfGmshAreNodes) {
  std::string text = text_of(two_cubes, cubes, {{"bodies", 8, {1, 2}}, {"corner", 7, {3, 3}}});
  const std::string second = "         7         3         0         0\n";
  text.replace(text.rfind(second), second.size(), "         8        99         0         0\n");
  const PartMesh mesh = read_part_mesh(write(text), {});
  const PartGroup* corner = mesh.find_group("corner");
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->dimension, 0);
  EXPECT_EQ(corner->elements.size(), 1U);
}

TEST_F(UniversalFiles, MessagesNameTheLine) {
  EXPECT_THAT(error_of(text_of({Vector3(0, 0, 0)}, {{21, {1, 2}}}, {})),
              HasSubstr("line 14: element 1 names node 2, which does not exist"));
  EXPECT_THAT(error_of(text_of(two_cubes, {{85, {1, 2, 5, 4}}}, {})),
              HasSubstr("element 1 is of kind 85 with 4 nodes; known are bars, plates and solids"));
  EXPECT_THAT(error_of(text_of(two_cubes, cubes, {{"lost", 8, {7}}})),
              HasSubstr("group \"lost\" names element 7, which does not exist"));
  const std::string whole = text_of(two_cubes, cubes, {});
  EXPECT_THAT(error_of(whole.substr(0, whole.find("  2412") + 7)), HasSubstr("is it cut off?"));
  EXPECT_THAT(error_of("nothing\n"), HasSubstr("it holds no elements (dataset 2412)"));
  std::string elsewhere = whole;
  elsewhere.replace(elsewhere.find("         1         1         1        11"), 20,
                    "         1         5");
  EXPECT_THAT(error_of(elsewhere), HasSubstr("node 1 is in coordinate system 5"));
}

}  // namespace
}  // namespace blocklift::structure
