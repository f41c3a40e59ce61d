#include "dynamics/marine/green/water_plane_cells.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"

namespace blocklift::dynamics {
namespace {

struct Areas {
  double inside = 0.0, open = 0.0;
};

Areas areas_of(const WaterPlaneCells& cells) {
  Areas areas;
  for (int k = 0; k < cells.size(); ++k) {
    EXPECT_DOUBLE_EQ(cells.panels[k].normal.z(), -1.0);
    (cells.region[k] < 0 ? areas.inside : areas.open) += cells.panels[k].area;
  }
  return areas;
}

// Two barges of 20 x 6 m, 4 m apart, and a region that reaches over both.
TEST(WaterPlaneCells, CoverBargesAndTheGapBetweenThem) {
  const PanelMesh barge = make_box_hull(20, 6, 2, {.length = 8, .breadth = 4, .draught = 2});
  const std::vector<WaterLine> lines = find_water_lines(std::vector<WettedBody>{
      {"left", translate(barge, {0, 5, 0})}, {"right", translate(barge, {0, -5, 0})}});
  const std::vector<WaterPlaneRegion> regions{{{-12, -4}, {12, 6}}};
  const Areas whole = areas_of(make_water_plane_cells(lines, regions, {}, 1.5));
  EXPECT_NEAR(whole.inside, 240.0, 1e-9);
  EXPECT_NEAR(whole.open, 24.0 * 10.0 - 20.0 * (2.0 + 4.0), 1e-9);
  // The region is symmetric in x alone.
  const Areas half = areas_of(make_water_plane_cells(lines, regions, {true, false}, 1.5));
  EXPECT_NEAR(half.inside, 120.0, 1e-9);
  EXPECT_NEAR(half.open, 60.0, 1e-9);
  const Areas quarter = areas_of(make_water_plane_cells(lines, {}, {true, true}, 1.5));
  EXPECT_NEAR(quarter.inside, 60.0, 1e-9);
}

// A ring's water plane is that between its lines; its moonpool is open water.
TEST(WaterPlaneCells, FollowRoundLinesAndOpenings) {
  const std::vector<WaterLine> lines = find_water_lines(
      std::vector<WettedBody>{{"ring", make_ring(6, 2, 1, {.meridians = 48, .parallels = 4})}});
  double ring = 0.0;
  for (const WaterLine& line : lines) ring += enclosed_area(line);
  const WaterPlaneCells cells = make_water_plane_cells(lines, {{{-2, -2}, {2, 2}}}, {}, 0.25);
  const Areas areas = areas_of(cells);
  EXPECT_NEAR(areas.inside / ring, 1.0, 0.01);
  // The region's corners are within the ring.
  EXPECT_NEAR(areas.open / (4 * std::acos(-1.0)), 1.0, 0.03);
  for (int k = 0; k < cells.size(); ++k) {
    const double r = cells.panels[k].centroid.norm();
    if (cells.region[k] < 0) {
      EXPECT_TRUE(r < 6.0 && r > 1.95);
    } else {
      EXPECT_LT(r, 2.0);
    }
  }
}

TEST(WaterPlaneCells, NothingReachesTheSurface) {
  EXPECT_EQ(make_water_plane_cells({}, {}, {}, 1.0).size(), 0);
}

}  // namespace
}  // namespace blocklift::dynamics
