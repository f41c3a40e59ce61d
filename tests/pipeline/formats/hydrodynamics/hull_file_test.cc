#include "pipeline/formats/hydrodynamics/hull_file.h"

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_diagnosis.h"
#include "dynamics/marine/hull/hull_shapes.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using test::TemporaryFolder;

std::filesystem::path put(const TemporaryFolder& folder, const std::string& name,
                          std::string_view text) {
  folder.write(name, text);
  return folder.path() / name;
}

using dynamics::calc_enclosed_volume;
using dynamics::diagnose;
using dynamics::Hull;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

// One eighth of the surface of a box 4 x 2 x 2 about the origin of x and y, from z = -2 to 0: a
// quarter in plan, open at the water line.
const char* const quarter_gdf =
    "quarter of a box\n"
    "1.0 9.80665 ULEN GRAV\n"
    "1 1 ISX ISY\n"
    "3\n"
    "2 0 -2  2 1 -2  2 1 0  2 0 0\n"
    "0 1 -2, 0 1 0, 2 1 0, 2 1 -2\n"
    "0 0 -2  0 1 -2\n"
    "2 1 -2  2.0D0 0 -2\n";

TEST(HullFile, ReadsWamitPanelsWithTheirSymmetries) {
  const TemporaryFolder folder;
  const auto path = put(folder, "quarter.gdf", quarter_gdf);
  const Hull open = read_hull(path);
  EXPECT_EQ(open.panel_count(), 12);
  EXPECT_FALSE(diagnose(open).empty());
  const Hull closed = read_hull(path, {.close_openings = true});
  EXPECT_THAT(diagnose(closed), IsEmpty());
  EXPECT_NEAR(calc_enclosed_volume(closed).volume, 4 * 2 * 2, 1e-12);
}

// A lid where the bottom is missing would mostly make another hull.
TEST(HullFile, ClosesNothingButTheTop) {
  const TemporaryFolder folder;
  const std::string whole = quarter_gdf;
  const auto refuses = [&](const std::string& text, const std::string& message) {
    const auto path = put(folder, "open.gdf", text);
    EXPECT_THAT(
        [&] { read_hull(path, {.close_openings = true}); },
        ThrowsMessage<HullFileError>(::testing::AllOf(
            HasSubstr("close_openings closes what is open at the top"), HasSubstr(message))));
  };
  std::string without_bottom = whole.substr(0, whole.find("0 0 -2  0 1 -2"));
  refuses(without_bottom.replace(without_bottom.find("\n3\n"), 3, "\n2\n"), "looks down");
}

// A dock of 6 x 6 x 1 m with a bay of 2 x 4 m, in which the middle of its rim lies.
TEST(HullFile, ClosesADockWithABay) {
  using Point = std::array<int, 2>;
  const std::vector<std::array<int, 4>> cells{
      {0, 0, 2, 2}, {2, 0, 4, 2}, {4, 0, 6, 2}, {0, 2, 2, 6}, {4, 2, 6, 6}};
  const std::vector<Point> rim{{0, 0}, {2, 0}, {4, 0}, {6, 0}, {6, 2}, {6, 6},
                               {4, 6}, {4, 2}, {2, 2}, {2, 6}, {0, 6}, {0, 2}};
  std::string text = "dock\n1 9.80665\n0 0\n17\n";
  for (const auto& [x, y, end_x, end_y] : cells)
    text += fmt::format("{0} {1} -1 {0} {3} -1 {2} {3} -1 {2} {1} -1\n", x, y, end_x, end_y);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const auto& [x, y] = rim[i];
    const auto& [next_x, next_y] = rim[(i + 1) % rim.size()];
    text += fmt::format("{0} {1} -1 {2} {3} -1 {2} {3} 0 {0} {1} 0\n", x, y, next_x, next_y);
  }
  const TemporaryFolder folder;
  const Hull dock = read_hull(put(folder, "dock.gdf", text), {.close_openings = true});
  EXPECT_NEAR(calc_enclosed_volume(dock).volume, 28, 1e-12);
}

TEST(HullFile, GivesBackWhatItWrites) {
  const TemporaryFolder folder;
  const Hull ship = dynamics::make_ship({.length = 100,
                                         .breadth = 16,
                                         .depth = 9,
                                         .draught = 6,
                                         .bow_length = 30,
                                         .stern_length = 30},
                                        {10, 4, 3, 2});
  const auto path = folder.path() / "ship.gdf";
  write_gdf(ship, path);
  const Hull same = read_hull(path);
  EXPECT_THAT(diagnose(same, {.largest_warp = 0.5}), IsEmpty());
  EXPECT_EQ(same.panel_count(), ship.panel_count());
  EXPECT_EQ(calc_enclosed_volume(same).volume, calc_enclosed_volume(ship).volume);
}

TEST(HullFile, SaysWhatIsWrongWithAGdf) {
  const TemporaryFolder folder;
  const auto fails = [&](const std::string& text, const std::string& message) {
    const auto path = put(folder, "bad.gdf", text);
    EXPECT_THAT([&] { read_hull(path); }, ThrowsMessage<HullFileError>(HasSubstr(message)));
  };
  fails("t\n1 9.8\n0 0\n2\n0 0 0 1 0 0 1 1 0 0 1 0\n",
        "the file ends where a coordinate of panel 2 of 2");
  fails("t\n1 17\n0 0\n1\n", "bad.gdf:2: GRAV is 17");
  fails("t\n1 9.8\n3 0\n1\n", "ISX is 3");
  fails("t\n1 9.8\n0 0\n1\n0 0 0 1 0 nan 1 1 0 0 1 0\n", "\"nan\" is no finite number");
  fails("t\n1 9.8\n0 0\n1\n0 0 0 1 0 0 1 0 0 0 0 0\n", "no panel has three vertices");
  EXPECT_THAT([&] { read_hull(folder.path() / "none.gdf"); },
              ThrowsMessage<HullFileError>(HasSubstr("there is no such file")));
  const auto other = put(folder, "hull.obj", "x");
  EXPECT_THAT([&] { read_hull(other); },
              ThrowsMessage<HullFileError>(HasSubstr(".msh, .geo, .stl (Gmsh) and .gdf")));
}

TEST(HullFile, ConvertsFeet) {
  const TemporaryFolder folder;
  const auto path = put(folder, "feet.gdf", "t\n1 32.2\n0 0\n1\n0 0 0 10 0 0 10 10 0 0 10 0\n");
  EXPECT_NEAR(read_hull(path).bounds()[1].x(), 3.048, 1e-12);
}

TEST(HullFile, ReadsStlAndTellsAnInvertedOne) {
  const auto tetrahedron = [](bool inverted) {
    const double p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    std::string text = "solid t\n";
    for (const auto& face : faces) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (int i = 0; i < 3; ++i) {
        const double* v = p[face[inverted ? 2 - i : i]];
        text += "vertex " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " +
                std::to_string(v[2]) + "\n";
      }
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid t\n";
  };
  const TemporaryFolder folder;
  const Hull hull = read_hull(put(folder, "t.stl", tetrahedron(false)));
  EXPECT_THAT(diagnose(hull), IsEmpty());
  EXPECT_NEAR(calc_enclosed_volume(hull).volume, 1.0 / 6, 1e-6);
  const auto defects = diagnose(read_hull(put(folder, "i.stl", tetrahedron(true))));
  ASSERT_EQ(defects.size(), 1U);
  EXPECT_EQ(defects[0].kind, dynamics::HullDefectKind::inward);
}

TEST(HullFile, ReadsQuadranglesOfAMesh) {
  const TemporaryFolder folder;
  const Hull hull = read_hull(
      put(folder, "box.msh",
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n"
          "1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 0 0 1\n6 2 0 1\n7 2 1 1\n8 0 1 1\n$EndNodes\n"
          "$Elements\n6\n1 3 2 1 1 1 4 3 2\n2 3 2 1 1 5 6 7 8\n3 3 2 1 1 1 2 6 5\n"
          "4 3 2 1 1 2 3 7 6\n5 3 2 1 1 3 4 8 7\n6 3 2 1 1 4 1 5 8\n$EndElements\n"));
  EXPECT_THAT(diagnose(hull), IsEmpty());
  EXPECT_EQ(hull.panel_count(), 6);
  EXPECT_NEAR(calc_enclosed_volume(hull).volume, 2, 1e-12);
}

TEST(HullFile, MeshesAGeometryOutwards) {
  const TemporaryFolder folder;
  const auto path =
      put(folder, "box.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, -1, 4, 2, 2};\n");
  const Hull hull = read_hull(path, {.panel_size = 0.5});
  EXPECT_THAT(diagnose(hull), IsEmpty());
  EXPECT_NEAR(calc_enclosed_volume(hull).volume, 16, 1e-9);
  EXPECT_GT(hull.panel_count(), 200);
  const auto broken = put(folder, "broken.geo", "Sphere( nonsense");
  EXPECT_THROW(read_hull(broken), HullFileError);
}

}  // namespace
}  // namespace blocklift::pipeline
