// Meshes of stiffened blocks: conforming, of the right volume, with the right names; and what is
// said when the description is wrong.
#include "structure/mesh/plates/block_generator.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/files/gmsh_file.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

using testing::cross_of_plates;
using ::testing::HasSubstr;

// The boundary of a conforming mesh is closed: its area vectors sum to nothing, and the volume that
// it encloses (divergence theorem) is that of the cells. A hanging node would break the latter.
void expect_closed_and_conforming(const HexMesh& mesh) {
  Vector3 area = Vector3::Zero();
  double enclosed = 0;
  std::map<std::pair<int, int>, int> uses;  // of boundary edges
  for (const auto& [cell, face] : boundary_faces(mesh)) {
    std::array<int, 4> v{};
    for (std::size_t i = 0; i < 4; ++i)
      v[i] = mesh.cells[static_cast<std::size_t>(cell)]
                       [static_cast<std::size_t>(cell_faces[static_cast<std::size_t>(face)][i])];
    const auto x = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(v[i])]; };
    for (const std::size_t b : {std::size_t{1}, std::size_t{2}}) {
      area += 0.5 * (x(b) - x(0)).cross(x(b + 1) - x(0));
      enclosed += x(0).dot(x(b).cross(x(b + 1))) / 6;
    }
    for (std::size_t i = 0; i < 4; ++i) ++uses[std::minmax(v[i], v[(i + 1) % 4])];
  }
  EXPECT_LT(area.norm(), 1e-9);
  EXPECT_NEAR(enclosed, volume(mesh), 1e-9 * volume(mesh));
  for (const auto& [edge, count] : uses)
    EXPECT_EQ(count % 2, 0) << edge.first << " " << edge.second;
}

std::string refusal(const BlockDescription& block) {
  try {
    generate_block_mesh(block);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BlockGenerator, VolumeIsThatOfTheUnionOfPlates) {
  const BlockMesh mesh = generate_block_mesh(cross_of_plates());
  expect_closed_and_conforming(mesh);
  EXPECT_NEAR(volume(mesh), 2 * 1 * 0.02 + 1 * 1 * 0.01 - 1 * 0.01 * 0.02, 1e-12);
}

TEST(BlockGenerator, CornersAreFull) {
  // Two plates meeting at an edge: both are led through to the other's far face.
  BlockDescription block = cross_of_plates();
  block.plates[1].positions = {0};
  block.plates[1].extent[2] = {0, 0.5};
  const BlockMesh mesh = generate_block_mesh(block);
  expect_closed_and_conforming(mesh);
  const double flat = (2 + 0.005) * 0.02, upright = (0.5 + 0.01) * 0.01;
  EXPECT_NEAR(volume(mesh), flat + upright - 0.01 * 0.02, 1e-12);
}

TEST(BlockGenerator, OneLayerAPlateAndColumnsAtCrossings) {
  const BlockMesh mesh = generate_block_mesh(cross_of_plates());
  int crossings = 0;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    const Vector3 diagonal = mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][7])] -
                             mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][0])];
    if (mesh.cell_normal[cell] == 2) {
      EXPECT_NEAR(diagonal.z(), 0.02, 1e-12);
    }
    if (mesh.cell_normal[cell] == 0) {
      EXPECT_NEAR(diagonal.x(), 0.01, 1e-12);
    }
    if (mesh.cell_normal[cell] < 0) {
      ++crossings;
      EXPECT_NEAR(diagonal.x(), 0.01, 1e-12);
      EXPECT_NEAR(diagonal.z(), 0.02, 1e-12);
    }
  }
  EXPECT_EQ(crossings, 2);  // 1 m long, elements of 0.6 m
}

TEST(BlockGenerator, PadsAreThickAndBelongToTheirGroup) {
  const BlockMesh mesh = generate_block_mesh(testing::small_block());
  expect_closed_and_conforming(mesh);
  std::map<std::string, double> volumes;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    const Vector3 d = mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][7])] -
                      mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][0])];
    volumes[mesh.groups[static_cast<std::size_t>(mesh.cell_group[cell])].name] += d.prod();
  }
  // Pad from the outer face of the frame at x = 0 (6 mm beyond) to 0.8 m, from 1.2 m to 2 m.
  EXPECT_NEAR(volumes["pad_L1"], 0.806 * 0.8 * 0.035, 1e-9);
  EXPECT_NEAR(volumes["L1"], 0.806 * 0.4 * 0.035, 1e-9);
  EXPECT_EQ(mesh.lugs.size(), 4U);
  EXPECT_EQ(mesh.groups[static_cast<std::size_t>(mesh.lugs[2].pad_group)].name, "pad_L3");
}

TEST(BlockGenerator, OpeningsCutTheirPlateOnly) {
  BlockDescription block = cross_of_plates();
  block.openings = {{"hole", "flat", {}, {{{0.8, 1.2}, {0.3, 0.7}, {}}}}};
  const BlockMesh mesh = generate_block_mesh(block);
  expect_closed_and_conforming(mesh);
  const double whole = 2 * 1 * 0.02 + 1 * 1 * 0.01 - 1 * 0.01 * 0.02;
  EXPECT_NEAR(volume(mesh), whole - (0.4 - 0.01) * 0.4 * 0.02, 1e-12);
}

TEST(BlockGenerator, PlatesOfOtherThicknessInOnePlaneMeet) {
  BlockDescription block = cross_of_plates();
  block.plates.push_back({"thin", Axis::z, {0}, {{{2, 3}, {0, 1}, {}}}, 0.012, "AH36"});
  const BlockMesh mesh = generate_block_mesh(block);
  expect_closed_and_conforming(mesh);
  // One layer each: the thickness tapers over the elements beside the joint.
  for (const int normal : mesh.cell_normal) EXPECT_TRUE(normal == 2 || normal == 0 || normal < 0);
  EXPECT_NEAR(volume(mesh), 0.0498 + 1 * 0.012, 1.5e-3);
}

TEST(BlockGenerator, CutsStayWhereTheyAreNeeded) {
  // Two boxes joined by nothing but a long plate: the mesh lines of a bracket do not cross it.
  BlockDescription block = cross_of_plates();
  block.plates[0].extent[0] = {0, 10};
  block.largest_element = 1;
  const std::size_t without = generate_block_mesh(block).cells.size();
  block.plates.push_back({"bracket", Axis::y, {0.5}, {{{1, 1.2}, {}, {0.2, 0.4}}}, 0.01, "AH36"});
  const std::size_t with = generate_block_mesh(block).cells.size();
  // The bracket's x cut lies in no other plate and must not divide the flat one.
  const BlockMesh mesh = generate_block_mesh(block);
  expect_closed_and_conforming(mesh);
  std::set<long> lines;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    if (mesh.cell_normal[cell] == 2)
      for (const int v : mesh.cells[cell])
        lines.insert(std::lround(mesh.vertices[static_cast<std::size_t>(v)].x() * 1e4));
  EXPECT_EQ(lines.count(12000), 0U);
  EXPECT_GT(with, without);
}

TEST(BlockGenerator, HullBlockIsConforming) {
  const BlockMesh mesh = generate_block_mesh(testing::hull_block());
  expect_closed_and_conforming(mesh);
  EXPECT_EQ(mesh.lugs.size(), 6U);
}

TEST(BlockGenerator, GmshFileKeepsNamesAndCells) {
  const BlockMesh mesh = generate_block_mesh(testing::small_block());
  const auto path = std::filesystem::temp_directory_path() / "blocklift_generator_test.msh";
  write_gmsh(mesh, path.string());
  const HexMesh read = read_gmsh(path.string(), {{"", testing::steel()}});
  std::filesystem::remove(path);
  EXPECT_EQ(read.cells.size(), mesh.cells.size());
  EXPECT_EQ(read.vertices.size(), mesh.vertices.size());
  EXPECT_NEAR(volume(read), volume(mesh), 1e-12);
  std::set<std::string> names, expected;
  for (const auto& group : read.groups) names.insert(group.name);
  for (const auto& group : mesh.groups) expected.insert(group.name);
  EXPECT_EQ(names, expected);
}

TEST(BlockGenerator, GmshFileWithoutMaterialIsRefused) {
  const auto path = std::filesystem::temp_directory_path() / "blocklift_material_test.msh";
  write_gmsh(generate_block_mesh(cross_of_plates()), path.string());
  EXPECT_THROW(read_gmsh(path.string(), {{"flat", testing::steel()}}), ModelError);
  std::filesystem::remove(path);
  EXPECT_THROW(read_gmsh("/nowhere/at/all.msh", {}), ModelError);
}

TEST(BlockGeneratorErrors, PlateThatTouchesNothingIsNamed) {
  BlockDescription block = cross_of_plates();
  block.plates.push_back({"stray", Axis::y, {5}, {{{4, 5}, {}, {1, 2}}}, 0.01, "AH36"});
  EXPECT_THAT(refusal(block), HasSubstr("not joined to the rest of the block: stray at y = 5 m"));
}

TEST(BlockGeneratorErrors, UnknownMaterialListsTheKnown) {
  BlockDescription block = cross_of_plates();
  block.plates[0].material = "AH32";
  EXPECT_THAT(refusal(block), HasSubstr("\"AH32\", which is not among the materials: AH36"));
}

TEST(BlockGeneratorErrors, OverlapOfDifferentThicknessNamesBoth) {
  BlockDescription block = cross_of_plates();
  block.plates.push_back({"doubler", Axis::z, {0}, {{{1.5, 2.5}, {0, 1}, {}}}, 0.03, "AH36"});
  EXPECT_THAT(refusal(block), HasSubstr("plates flat at z = 0 m (20 mm) and doubler at z = 0 m"));
}

TEST(BlockGeneratorErrors, ThicknessLargerThanSpacing) {
  BlockDescription block = cross_of_plates();
  block.plates[1].positions = {1, 1.008};
  EXPECT_THAT(refusal(block), HasSubstr("lie 8 mm apart"));
}

TEST(BlockGeneratorErrors, ElementsThatNoMemoryHoldsAreRefusedAtOnce) {
  BlockDescription block = cross_of_plates();
  block.largest_element = 1e-9;
  EXPECT_THAT(refusal(block), HasSubstr("use larger elements"));
}

TEST(BlockGeneratorErrors, ThicknessMustBePositive) {
  BlockDescription block = cross_of_plates();
  block.plates[1].thickness = -0.01;
  EXPECT_THAT(refusal(block), HasSubstr("\"upright\" has a thickness of -0.01 m"));
}

TEST(BlockGeneratorErrors, NameUsedTwice) {
  BlockDescription block = cross_of_plates();
  block.plates[1].name = "flat";
  EXPECT_THAT(refusal(block), HasSubstr("\"flat\" bears a name that another part has"));
}

TEST(BlockGeneratorErrors, LugMustTouchItsPad) {
  BlockDescription block = testing::small_block();
  block.lugs[0].extent[0] = {3.2, 4};  // at the other end of the side, on the pad of L2
  block.lugs[1].extent[0] = {0, 0.8};
  EXPECT_THAT(refusal(block), HasSubstr("lug \"L1\" does not touch its pad \"pad_L1\""));
}

TEST(BlockGeneratorErrors, LugOnAPadThatIsNotThere) {
  BlockDescription block = testing::small_block();
  block.lugs[0].pad = "pad_7";
  EXPECT_THAT(refusal(block), HasSubstr("its pads are pad_L1, pad_L2"));
}

TEST(BlockGeneratorErrors, PadThinnerThanItsPlate) {
  BlockDescription block = testing::small_block();
  block.pads[1].thickness = 0.010;
  EXPECT_THAT(refusal(block), HasSubstr("pad \"pad_L2\" is 10 mm thick in total, thinner than"));
}

TEST(BlockGeneratorErrors, PadBesideEveryPlate) {
  BlockDescription block = testing::small_block();
  block.pads[0].position = 1.3;
  EXPECT_THAT(refusal(block), HasSubstr("pad \"pad_L1\" at y = 1.3 m lies on no plate"));
}

TEST(BlockGeneratorErrors, OpeningInAPlateThatIsNotThere) {
  BlockDescription block = cross_of_plates();
  block.openings = {{"hole", "deck", {}, {{{0.8, 1.2}, {0.3, 0.7}, {}}}}};
  EXPECT_THAT(refusal(block), HasSubstr("opening \"hole\" is cut into plate \"deck\""));
}

TEST(BlockGeneratorErrors, MaterialOutOfRange) {
  BlockDescription block = cross_of_plates();
  block.materials[0].poisson_ratio = 0.5;
  EXPECT_THAT(refusal(block), HasSubstr("material \"AH36\": Poisson's ratio"));
}

}  // namespace
}  // namespace blocklift::structure
