// Blocks from files that have no properties of their own: meshes of Gmsh, CAD surfaces.
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/library/model_library.h"
#include "structure/mesh/mass_properties.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

// A square of 2 m in millimetres, and a line of bars along its lower edge.
const char* const square_mesh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "edge"
2 8 "deck"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 2000 0 0
3 2000 2000 0
4 0 2000 0
$EndNodes
$Elements
2
1 1 2 7 1 1 2
2 3 2 8 1 1 2 3 4
$EndElements
)";

struct ReadBlock {
  std::shared_ptr<const BlockModel> block;
  std::string complaints;
};

ReadBlock read_with_mesh(const std::string& keys,
                         const std::string& lug = "L1: {pin: [0 m, 0 m, 0 m]}") {
  const test::TemporaryFolder folder;
  folder.write("square.msh", square_mesh);
  folder.write("empty.step", "");
  folder.write("block.yaml",
               "kind: block\nmaterials:\n  AH36: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, "
               "density: 7850 kg/m^3, yield_stress: 355 MPa}\nmesh: {" +
                   keys + "}\nlugs: {" + lug + "}\n");
  ModelLibrary library({});
  Diagnostics diagnostics;
  ReadBlock result;
  result.block = library.read_block("block.yaml", diagnostics);
  result.complaints = diagnostics.to_text();
  return result;
}

TEST(BareMesh, GroupsGetTheirProperties) {
  const ReadBlock result = read_with_mesh(
      "file: square.msh, units: mm, groups: {deck: 10 mm, edge: {section: {flat_bar: "
      "[100 mm, 10 mm]}, towards: [0, 0, 1], material: AH36}}");
  ASSERT_EQ(result.complaints, "");
  const structure::Mesh& mesh = result.block->mesh->deck->mesh;
  EXPECT_NEAR(structure::mass_properties(mesh).mass, 7850 * (4 * 0.01 + 2 * 0.001), 1e-9);
  ASSERT_EQ(mesh.beams.size(), 1U);
  EXPECT_NEAR(mesh.beams[0].offset[0].z(), 0.055, 1e-12);
  EXPECT_EQ(mesh.lifting_points.size(), 1U);
  EXPECT_EQ(mesh.material_of(mesh.shells[0]).yield_stress, 355e6);
  EXPECT_THAT(describe_block_mesh(*result.block->mesh), HasSubstr("square.msh: 4 nodes, 1 shells"));
  EXPECT_EQ(read_with_mesh("file: square.msh, units: mm, thicknesses: {deck: 10 mm}").complaints,
            "");
}

// A file of plates and bars has the brackets of its stiffeners by their group.
TEST(BareMesh, GroupsHaveTrippingBrackets) {
  const std::string keys =
      "file: square.msh, units: mm, groups: {deck: 10 mm, edge: {section: {flat_bar: [100 mm, 10 "
      "mm]}, towards: [0, 0, 1]}}";
  const ReadBlock result = read_with_mesh(keys + ", tripping_brackets: {Edge: 0.8 m}");
  ASSERT_EQ(result.complaints, "");
  const structure::Mesh& mesh = result.block->mesh->deck->mesh;
  EXPECT_EQ(mesh.group_of_region(mesh.beams[0].region).tripping_brackets, 0.8);
  EXPECT_EQ(mesh.group_of_region(mesh.shells[0].region).tripping_brackets, 0);
  EXPECT_THAT(
      read_with_mesh(keys + ", tripping_brackets: {deck: 0.8 m}").complaints,
      HasSubstr("tripping brackets are of group \"deck\", of which square.msh has no bars"));
}

TEST(BareMesh, SaysWhatIsWrong) {
  const auto say = [](const std::string& keys, const std::string& wanted,
                      const std::string& lug = "L1: {pin: [0 m, 0 m, 0 m]}") {
    const std::string complaints = read_with_mesh(keys, lug).complaints;
    EXPECT_THAT(complaints, HasSubstr(wanted));
    EXPECT_THAT(complaints, HasSubstr("block.yaml:"));
  };
  const std::string file = "file: square.msh, units: mm";
  say(file, "block.yaml:4:14: error: square.msh gives no thickness to its group deck");
  say(file + ", groups: {dekc: 10 mm}", "did you mean \"deck\"?");
  say(file + ", groups: {deck: {thickness: 10 mm, material: AH63}}", "did you mean \"AH36\"?");
  say(file + ", groups: {deck: {}}", "has neither a thickness nor a section");
  say(file + ", groups: {deck: 10 m}", "is the unit mistaken?");
  say(file + ", groups: {deck: 10 mm, edge: {section: {flat_bar: [100 mm, 10 mm]}}}",
      "not towards what it stands");
  say(file +
          ", groups: {deck: 10 mm, edge: {section: {flat_bar: [100 mm, 10 mm]}, towards: "
          "[1, 0, 0]}}",
      "runs along the direction");
  say(file + ", groups: {deck: 10 mm}, element_size: 1 m", "is a mesh and keeps its elements");
  say("file: square.msh, units: m, groups: {deck: 10 mm}", "the block is 2000 m long");
  say(file + ", groups: {deck: 10 mm}", "did you mean \"deck\"?", "L1: {set: dec}");
  say("file: empty.step, units: mm", "no element_size is given");
  say("file: empty.step, units: mm, element_size: 1 m", "damaged");
  say("file: none.brep, units: mm, element_size: 1 m", "there is no file \"none.brep\"");
}

}  // namespace
}  // namespace blocklift::pipeline
