// Parts of a block that are repeated and mirrored, beside the same parts written out.
#include "pipeline/files/structure/copied_parts.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/build/describe_block.h"
#include "pipeline/files/library/model_library.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/pipeline/lug_stresses.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string steel =
    "kind: block\n"
    "materials:\n"
    "  S: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, yield_stress: 355 "
    "MPa}\n";

struct BlockOfText {
  std::shared_ptr<const BlockModel> block;
  std::string complaints;
};

BlockOfText block_of(const std::string& text) {
  const test::TemporaryFolder folder;
  folder.write("block.yaml", steel + text);
  ModelLibrary library({});
  Diagnostics diagnostics;
  BlockOfText result;
  result.block = library.read_block("block.yaml", diagnostics);
  result.complaints = diagnostics.to_text();
  return result;
}

structure::Mesh mesh_of_text(const std::string& text) {
  const BlockOfText result = block_of(text);
  EXPECT_EQ(result.complaints, "");
  return structure::generate_shell_mesh(describe_block(*result.block, "block", 0.6));
}

/// Names of copies as they are where the file has them written out.
std::string written_out(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name.substr(0, name.find(" at "));
}

void expect_same_mesh(const structure::Mesh& found, const structure::Mesh& expected) {
  ASSERT_EQ(found.vertices.size(), expected.vertices.size());
  for (std::size_t v = 0; v < expected.vertices.size(); ++v)
    EXPECT_LT((found.vertices[v] - expected.vertices[v]).norm(), 1e-9) << v;
  ASSERT_EQ(found.shells.size(), expected.shells.size());
  for (std::size_t s = 0; s < expected.shells.size(); ++s) {
    EXPECT_EQ(found.shells[s].vertices, expected.shells[s].vertices) << s;
    EXPECT_EQ(found.section_of(found.shells[s]).thickness,
              expected.section_of(expected.shells[s]).thickness);
  }
  ASSERT_EQ(found.regions.size(), expected.regions.size());
  for (std::size_t r = 0; r < expected.regions.size(); ++r)
    EXPECT_EQ(written_out(found.regions[r].name), written_out(expected.regions[r].name));
  ASSERT_EQ(found.beams.size(), expected.beams.size());
  for (std::size_t b = 0; b < expected.beams.size(); ++b) {
    EXPECT_EQ(found.beams[b].vertices, expected.beams[b].vertices) << b;
    EXPECT_LT((found.beams[b].offset[0] - expected.beams[b].offset[0]).norm(), 1e-9) << b;
  }
  const structure::MeshMass mass = structure::mass_properties(found),
                            wanted = structure::mass_properties(expected);
  EXPECT_NEAR(mass.mass, wanted.mass, 1e-9 * wanted.mass);
  EXPECT_LT((mass.centre - wanted.centre).norm(), 1e-9);
}

void expect_same_block(const std::string& copied, const std::string& expected) {
  const structure::Mesh mesh = mesh_of_text(copied), wanted = mesh_of_text(expected);
  expect_same_mesh(mesh, wanted);
  ASSERT_EQ(mesh.lifting_points.size(), wanted.lifting_points.size());
  for (std::size_t i = 0; i < wanted.lifting_points.size(); ++i) {
    EXPECT_EQ(written_out(mesh.lifting_points[i].name), wanted.lifting_points[i].name);
    EXPECT_LT((mesh.lifting_points[i].p_BPin - wanted.lifting_points[i].p_BPin).norm(), 1e-9);
  }
  const Eigen::MatrixXd found = test::lug_stresses({mesh, {2, {}}}),
                        stress = test::lug_stresses({wanted, {2, {}}});
  ASSERT_EQ(found.rows(), stress.rows());
  EXPECT_LT((found - stress).cwiseAbs().maxCoeff(), 1e-9 * stress.cwiseAbs().maxCoeff());
}

/// Frames under a deck, each with stiffeners, a manhole and a lug on its pad.
std::string frame(const std::string& suffix, const std::string& x) {
  return "  frame" + suffix + ": {normal: x, at: " + x +
         ", y: [-2 m, 2 m], z: [0 m, 1 m], thickness: 12 mm, stiffeners: {along: z, spacing: 0.9 m,"
         " first: -1.2 m, profile: {bulb_flat: [120 mm, 6 mm]}}}\n";
}
std::string manhole(const std::string& suffix) {
  return "  manhole" + suffix + ": {plate: frame" + suffix +
         ", y: [0.2 m, 0.6 m], z: [0.3 m, 0.7 m], corner_radius: 0.2 m}\n";
}
std::string pad(const std::string& suffix, const std::string& x) {
  return "  pad" + suffix + ": {plate: frame" + suffix + ", normal: x, at: " + x +
         ", y: [-2 m, -1.4 m], z: [0.5 m, 1 m], thickness: 30 mm}\n";
}
std::string lug(const std::string& suffix, const std::string& x) {
  return "  L" + suffix + ": {pad: pad" + suffix + ", normal: x, at: " + x +
         ", y: [-1.9 m, -1.5 m], z: [1 m, 1.3 m], thickness: 40 mm, pin: [" + x +
         ", -1.7 m, 1.2 m]}\n";
}
const std::string deck =
    "  deck: {normal: z, at: 1 m, x: [0 m, 6 m], y: [-2 m, 2 m], thickness: 10 mm}\n";

std::string repeated_frames() {
  return "plates:\n" + deck + frame("", "1 m") + "openings:\n" + manhole("") + "pads:\n" +
         pad("", "1 m") + "lugs:\n" + lug("", "1 m") +
         "repeat:\n  - {parts: [frame, pad, L], count: 2, step: [2 m, 0 m, 0 m]}\n";
}

std::string written_frames() {
  std::string plates = deck, openings, pads, lugs;
  for (const auto& [suffix, x] :
       {std::pair<std::string, std::string>{"", "1 m"}, {"_1", "3 m"}, {"_2", "5 m"}}) {
    plates += frame(suffix, x);
    openings += manhole(suffix);
    pads += pad(suffix, x);
    lugs += lug(suffix, x);
  }
  return "plates:\n" + plates + "openings:\n" + openings + "pads:\n" + pads + "lugs:\n" + lugs;
}

/// A deck with a plate below it, or the same deck alone by its corners, whose angles are plates.
std::string deck_of_angles(const std::string& along, bool is_free) {
  return (is_free
              ? "plates:\n  deck: {corners: [[0 m, 0 m, 1 m], [4 m, 0 m, 1 m], [4 m, 2 m, 1 m], "
                "[0 m, 2 m, 1 m]]"
              : "plates:\n  side: {normal: y, at: 2 m, x: [0 m, 4 m], z: [0 m, 1 m], thickness: "
                "10 mm}\n  deck: {normal: z, at: 1 m, x: [0 m, 4 m], y: [0 m, 2 m]") +
         std::string(", thickness: 10 mm, stiffeners: {along: ") + along +
         ", spacing: 0.7 m, first: 0.5 m, side: negative, as: plates, profile: {angle_bar: [200 "
         "mm, "
         "8 mm, 75 mm, 12 mm]}}}\n";
}

void expect_mirrored(const std::string& half, int axis) {
  const structure::MeshMass mass = structure::mass_properties(mesh_of_text(half));
  const structure::MeshMass both = structure::mass_properties(
      mesh_of_text(half + "mirror:\n  - {normal: " + "xyz"[axis] + ", at: 0 m}\n"));
  EXPECT_NEAR(both.mass, 2 * mass.mass, 1e-9 * mass.mass);
  structure::Vector3 centre = mass.centre;
  centre[axis] = 0;
  EXPECT_LT((both.centre - centre).norm(), 1e-9) << half << axis;
}

// Flanges point the other way in a mirror, so that the whole has its centre in the plane.
TEST(CopiedParts, MirroredStiffenersAsPlates) {
  for (const char* along : {"x", "y"})
    for (const int axis : {0, 1, 2}) expect_mirrored(deck_of_angles(along, false), axis);
  for (const char* along : {"u", "v"})
    for (const int axis : {0, 1}) expect_mirrored(deck_of_angles(along, true), axis);
}

TEST(CopiedParts, RepeatedStiffenersAsPlates) {
  const std::string deck = deck_of_angles("x", false);
  const structure::MeshMass one = structure::mass_properties(mesh_of_text(deck));
  const structure::MeshMass two = structure::mass_properties(
      mesh_of_text(deck + "repeat:\n  - {count: 1, step: [4 m, 0 m, 0 m]}\n"));
  EXPECT_NEAR(two.mass, 2 * one.mass, 1e-9 * one.mass);
  EXPECT_LT((two.centre - one.centre - structure::Vector3(2, 0, 0)).norm(), 1e-9);
}

TEST(CopiedParts, RepeatedFramesAreThoseWrittenOut) {
  expect_same_block(repeated_frames(), written_frames());
}

template <class T>
const T& named(const std::vector<T>& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
  if (found == items.end()) throw std::runtime_error("there is no " + name);
  return *found;
}

// Free plates are meshed by Gmsh, which makes two meshes even of one description: what it is given
// is the same to the last digit.
TEST(CopiedParts, SoArePlatesOfAnyOrientation) {
  const std::string plates =
      "plates:\n" + deck +
      "  bracket: {corners: [[1 m, 0.5 m, 1 m], [1.2 m, 0.5 m, 2 m], [1 m, 1.5 m, 1 m]], "
      "thickness: 10 mm}\n"
      "  trunk: {edges: [{arc: [[4 m, 0 m, 1 m], [4.5 m, 0.5 m, 1 m], [5 m, 0 m, 1 m]]}, {arc: [[4 "
      "m, 0 m, 2 m], [4.5 m, 0.5 m, 2 m], [5 m, 0 m, 2 m]]}], thickness: 8 mm}\n"
      "openings:\n"
      "  eye: {plate: bracket, centres: [[1.05 m, 0.75 m, 1.25 m]], radius: 100 mm}\n"
      "repeat:\n  - {parts: [bracket, trunk], count: 1, step: [0.5 m, 0 m, 0 m]}\n"
      "mirror:\n  - {parts: [bracket, trunk], normal: x, at: 6 m}\n";
  const BlockOfText result = block_of(plates);
  ASSERT_EQ(result.complaints, "");
  const structure::BlockDescription block = describe_block(*result.block, "block", 0.6);
  ASSERT_EQ(block.free_plates.size(), 8U);
  ASSERT_EQ(block.free_openings.size(), 4U);
  const auto moved = [](const Vector3& by) {
    return [by](const Vector3& point) { return Vector3(point + by); };
  };
  const auto mirrored = [](const Vector3& point) {
    return Vector3(12 - point.x(), point.y(), point.z());
  };
  const auto expect_placed = [&](const std::string& suffix, const auto& place) {
    const auto find = [&](const std::string& name) -> const structure::FreePlate& {
      return named(block.free_plates, name);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(find("bracket" + suffix).corners[i], place(find("bracket").corners[i]));
      for (std::size_t e = 0; e < 2; ++e)
        EXPECT_EQ(find("trunk" + suffix).edges[e].points[i],
                  place(find("trunk").edges[e].points[i]));
    }
    EXPECT_TRUE(find("trunk" + suffix).edges[1].is_arc);
    const structure::FreeOpening& eye = named(block.free_openings, "eye" + suffix);
    EXPECT_EQ(eye.plate, "bracket" + suffix);
    EXPECT_EQ(eye.centres[0], place(named(block.free_openings, "eye").centres[0]));
    EXPECT_EQ(eye.radius, 0.1);
  };
  expect_placed(".1", moved({0.5, 0, 0}));
  expect_placed(".mirrored", mirrored);
  expect_placed(".1.mirrored",
                [&](const Vector3& point) { return mirrored(point + Vector3(0.5, 0, 0)); });
}

// An angle is its own image only if its profile is reflected, too: the mass lies in the mirror
// plane.
TEST(CopiedParts, SoAreBars) {
  const structure::Mesh mesh =
      mesh_of_text("plates:\n" + deck +
                   "bars:\n  brace: {points: [[1 m, 0.5 m, 1 m], [1.5 m, 1 m, 1.8 m], [2 m, 1.8 m, "
                   "1 m]], section: "
                   "{angle_bar: [150 mm, 10 mm, 90 mm, 12 mm]}, towards: [0.2, 0.3, 1]}\n"
                   "repeat:\n  - {parts: [brace], count: 1, step: [2 m, 0 m, 0 m]}\n"
                   "mirror:\n  - {parts: [brace], normal: y, at: 0 m}\n");
  std::set<std::string> bars;
  for (const structure::Beam& beam : mesh.beams)
    bars.insert(mesh.group_of_region(beam.region).name);
  EXPECT_THAT(bars,
              ::testing::ElementsAre("brace", "brace.1", "brace.1.mirrored", "brace.mirrored"));
  EXPECT_NEAR(structure::mass_properties(mesh).centre.y(), 0, 1e-9);
}

/// A side girder and half a deck, which is stiffened off its middle, a girder at the centre line.
const std::string half =
    "plates:\n"
    "  deck: {normal: z, at: 1 m, x: [0 m, 4 m], y: [0 m, 2 m], thickness: 10 mm, stiffeners: "
    "{along: x, spacing: 0.7 m, side: negative, profile: {flat_bar: [100 mm, 10 mm]}}}\n"
    "  girder: {normal: y, at: [0 m, 1 m], x: [0 m, 4 m], z: [0 m, 1 m], thickness: 12 mm, "
    "stiffeners: {along: x, spacing: 0.4 m, profile: {flat_bar: [80 mm, 8 mm]}}}\n"
    "openings:\n"
    "  middle: {plate: girder, at: 0 m, x: [1 m, 1.6 m], z: [0.4 m, 0.8 m]}\n"
    "  side: {plate: girder, at: 1 m, x: [2.2 m, 2.8 m], z: [0.2 m, 0.6 m]}\n"
    "pads:\n"
    "  pad: {plate: girder, normal: y, at: 1 m, x: [0 m, 0.5 m], z: [0.5 m, 1 m], thickness: 30 "
    "mm}\n"
    "  end: {plate: girder, normal: y, at: 0 m, x: [3.5 m, 4 m], z: [0.5 m, 1 m], thickness: 30 "
    "mm}\n"
    "lugs:\n"
    "  L1: {pad: pad, normal: y, at: 1 m, x: [0.1 m, 0.4 m], z: [1 m, 1.3 m], thickness: 40 mm, "
    "pin: [0.2 m, 1 m, 1.2 m]}\n"
    "  L2: {pad: end, normal: y, at: 0 m, x: [3.6 m, 3.9 m], z: [1 m, 1.3 m], thickness: 40 mm, "
    "pin: [3.7 m, 0 m, 1.2 m]}\n";

std::string with_added(std::string text, const std::string& section, const std::string& added) {
  // Behind the last entry of the section, which is in front of the next one.
  const std::size_t next = text.find("\n", text.find(section + ":\n"));
  std::size_t end = next + 1;
  while (end < text.size() && text[end] == ' ') end = text.find('\n', end) + 1;
  return text.insert(end, added);
}

TEST(CopiedParts, AMirroredHalfIsTheBlockWrittenOut) {
  std::string whole = with_added(
      half, "plates",
      "  deck_mirrored: {normal: z, at: 1 m, x: [0 m, 4 m], y: [-2 m, 0 m], thickness: 10 mm, "
      "stiffeners: {along: x, spacing: 0.7 m, first: -0.7 m, side: negative, profile: {flat_bar: "
      "[100 mm, 10 mm]}}}\n"
      "  girder_mirrored: {normal: y, at: -1 m, x: [0 m, 4 m], z: [0 m, 1 m], thickness: 12 mm, "
      "stiffeners: {along: x, spacing: 0.4 m, side: negative, profile: {flat_bar: [80 mm, 8 "
      "mm]}}}\n");
  whole = with_added(whole, "openings",
                     "  side_mirrored: {plate: girder_mirrored, at: -1 m, x: [2.2 m, 2.8 m], z: "
                     "[0.2 m, 0.6 m]}\n");
  whole = with_added(whole, "pads",
                     "  pad_mirrored: {plate: girder_mirrored, normal: y, at: -1 m, x: [0 m, 0.5 "
                     "m], z: [0.5 m, 1 m], thickness: 30 mm}\n");
  whole = with_added(whole, "lugs",
                     "  L1_mirrored: {pad: pad_mirrored, normal: y, at: -1 m, x: [0.1 m, 0.4 m], "
                     "z: [1 m, 1.3 m], thickness: 40 mm, pin: [0.2 m, -1 m, 1.2 m]}\n");
  expect_same_block(half + "mirror:\n  - {normal: y, at: 0 m}\n", whole);
}

// The flange of a profile that is not symmetric is mirrored, too: the whole has its centre of mass
// in the plane and as high as that of its half, and its shear centres lie on both sides alike.
TEST(CopiedParts, BulbsAreMirroredWithTheirPlates) {
  const std::string beams =
      "plates:\n"
      "  deck: {normal: z, at: 1 m, x: [0 m, 4 m], y: [0 m, 2 m], thickness: 10 mm, stiffeners: "
      "{along: x, spacing: 0.7 m, profile: {angle_bar: [200 mm, 10 mm, 150 mm, 20 mm]}}}\n"
      "  side: {normal: y, at: 2 m, x: [0 m, 4 m], z: [0 m, 1 m], thickness: 12 mm, "
      "stiffeners: {along: x, spacing: 0.4 m, profile: {angle_bar: [200 mm, 10 mm, 150 mm, 20 "
      "mm]}}}\n";
  const auto one_side = structure::mass_properties(mesh_of_text(beams));
  const structure::Mesh mesh = mesh_of_text(beams + "mirror:\n  - {normal: y, at: 0 m}\n");
  const auto whole = structure::mass_properties(mesh);
  EXPECT_NEAR(whole.mass, 2 * one_side.mass, 1e-9 * whole.mass);
  EXPECT_NEAR(whole.centre.y(), 0, 1e-12);
  EXPECT_NEAR(whole.centre.z(), one_side.centre.z(), 1e-12);
  double product = 0, magnitude = 0, aside = 0;
  for (const structure::Beam& beam : mesh.beams) {
    const structure::BeamSection& section = mesh.beam_sections[beam.section];
    const Eigen::Vector3d axis_3 = Eigen::Vector3d::UnitX().cross(beam.axis_2);
    product += section.product_23 * (beam.axis_2.y() * axis_3.z() + beam.axis_2.z() * axis_3.y());
    magnitude = std::max(magnitude, std::abs(section.product_23));
    aside += mesh.vertices[beam.vertices[0]].y() + beam.offset[0].y() +
             section.shear_centre[0] * beam.axis_2.y() + section.shear_centre[1] * axis_3.y();
  }
  EXPECT_GT(magnitude, 0);
  EXPECT_NEAR(product, 0, 1e-9 * magnitude);
  EXPECT_NEAR(aside, 0, 1e-9);
}

TEST(CopiedParts, RepeatedLongitudinalsMakeAGridByLabels) {
  const BlockOfText grid = block_of(
      "plates:\n" + deck +
      "  post: {corners: [[1 m, -1 m, 1 m], [1 m, -1 m, 2 m], [1.2 m, -1 m, 1 m]], thickness: 10 "
      "mm}\n"
      "repeat:\n"
      "  - {parts: [post], count: 3, step: [1 m, 0 m, 0 m]}\n"
      "  - {parts: [post], count: 1, step: [0 m, 1 m, 0 m], label: row}\n"
      "mirror:\n  - {parts: [post.2], normal: z, at: 1 m, label: below}\n");
  ASSERT_EQ(grid.complaints, "");
  EXPECT_EQ(grid.block->plates.size(), 1U + 8U + 1U);
  const PlateModel* post = grid.block->find_plate("post.2.row1");
  ASSERT_TRUE(post);
  EXPECT_LT((post->corners->value[1] - Vector3(3, 0, 2)).norm(), 1e-12);
  const PlateModel* below = grid.block->find_plate("post.2.below");
  ASSERT_TRUE(below);
  EXPECT_LT((below->corners->value[1] - Vector3(3, -1, 0)).norm(), 1e-12);
}

// Edges that ropes may touch are parts like others. One that lies across the mirror plane is its
// own image, one in the plane is not doubled.
TEST(CopiedParts, EdgesComeAgain) {
  const std::string edges =
      "edges:\n"
      "  sill: {from: [0 m, -1 m, 1 m], to: [0.5 m, -1 m, 1 m], outside: [0, -1, 1], radius: 50 "
      "mm, friction: 0.2}\n"
      "  across: {from: [1 m, -1 m, 1 m], to: [1 m, 1 m, 1 m], outside: [-1, 0, 1]}\n"
      "  middle: {from: [1 m, 0 m, 1 m], to: [2 m, 0 m, 1 m], outside: [0, 0, 1]}\n";
  const BlockOfText block = block_of("plates:\n" + deck + edges +
                                     "repeat:\n"
                                     "  - {parts: [sill], count: 2, step: [1 m, 0 m, 0 m]}\n"
                                     "mirror:\n"
                                     "  - {parts: [sill, across, middle], normal: y, at: 0 m}\n");
  ASSERT_EQ(block.complaints, "");
  std::vector<std::string> names;
  for (const LoadEdge& edge : block.block->edges) names.push_back(edge.name.value);
  EXPECT_EQ(names,
            (std::vector<std::string>{"sill", "across", "middle", "sill.1", "sill.2",
                                      "sill.mirrored", "sill.1.mirrored", "sill.2.mirrored"}));
  const LoadEdge& far = block.block->edges.back();
  EXPECT_LT((far.from - Vector3(2, 1, 1)).norm(), 1e-12);
  EXPECT_LT((far.to - Vector3(2.5, 1, 1)).norm(), 1e-12);
  EXPECT_LT((far.outside - Vector3(0, 1, 1).normalized()).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(far.radius, 0.05);
  EXPECT_DOUBLE_EQ(far.friction, 0.2);
  EXPECT_THAT(block_of("plates:\n" + deck + edges +
                       "mirror:\n  - {parts: [across], normal: y, at: 0.5 m}\n")
                  .complaints,
              HasSubstr("the mirror plane y = 0.5 m passes through edge across"));
}

TEST(CopiedParts, SaysWhatIsWrong) {
  const auto complaints = [](const std::string& added) {
    return block_of(repeated_frames().substr(0, repeated_frames().find("repeat:")) + added)
        .complaints;
  };
  const std::string first = "  - {parts: [frame, pad, L], count: 2, step: [2 m, 0 m, 0 m]}\n";
  EXPECT_THAT(complaints("repeat:\n  - {count: 0, step: [1 m, 0 m, 0 m]}\n"),
              AllOf(HasSubstr("block.yaml:14:13: error"), HasSubstr("count")));
  EXPECT_THAT(complaints("repeat:\n  - {count: 1, step: [0 m, 0 m, 0 m]}\n"),
              HasSubstr("has no length"));
  EXPECT_THAT(
      complaints("repeat:\n  - {parts: [fram], count: 1, step: [1 m, 0 m, 0 m]}\n"),
      AllOf(HasSubstr("the block has no part of that name"), HasSubstr("did you mean \"frame\"")));
  EXPECT_THAT(complaints("repeat:\n" + first + first),
              HasSubstr("a copy of plate frame would be called frame.1, as one is already"));
  EXPECT_THAT(
      complaints("repeat:\n  - {parts: [deck], count: 3, step: [1 m, 0 m, 0 m]}\n"),
      AllOf(HasSubstr("plate deck.1 lies upon plate deck at z = 1 m"), Not(HasSubstr("deck.2"))));
  EXPECT_THAT(
      complaints("mirror:\n  - {normal: y, at: 0.25 m}\n"),
      AllOf(HasSubstr("block.yaml:14:"),
            HasSubstr("the mirror plane y = 0.25 m passes through plate deck, which reaches from "
                      "-2 m to 2 m"),
            HasSubstr("plate frame")));
  EXPECT_THAT(complaints("repeat:\n  - {parts: [L], count: 10000, step: [9 m, 0 m, 0 m]}\n"
                         "  - {parts: [L], count: 2, step: [0 m, 9 m, 0 m], label: row}\n"),
              HasSubstr("more than 10000 copies"));
  EXPECT_THAT(block_of("mesh: {file: box.bdf, units: mm-t-N}\nmirror:\n  - {normal: y, at: 0 m}\n")
                  .complaints,
              HasSubstr("the block is a mesh"));
}

TEST(CopiedParts, ACopyDoesNotRepeatTheFaultsOfItsPart) {
  std::string text = repeated_frames();
  const std::string thin = "thickness: 30 mm";
  text.replace(text.find(thin), thin.size(), "thickness: 3 mm");
  const std::string complaints = block_of(text).complaints;
  EXPECT_THAT(complaints, HasSubstr("pad pad is 0.003 m thick"));
  EXPECT_THAT(complaints, Not(HasSubstr("pad.1")));
}

}  // namespace
}  // namespace blocklift::pipeline
