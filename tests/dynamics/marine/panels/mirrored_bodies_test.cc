#include "dynamics/marine/panels/mirrored_bodies.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/panels/wetted_body.h"

namespace blocklift::dynamics {
namespace {

using Vertices = std::vector<std::vector<Vector3>>;

Hull small_barge(int along = 8) {
  return make_barge({.length = 40, .breadth = 20, .depth = 6}, {along, 4, 3, 2}, "barge");
}

struct Placed {
  Vertices vertices_W;
  std::vector<WettedBody> bodies;

  void add(const Hull& hull, const Vector3& place) {
    const Pose X_WB = Pose::translation(place);
    bodies.push_back(make_wetted_body(hull, X_WB));
    vertices_W.emplace_back();
    for (const Vector3& vertex : hull.vertices()) vertices_W.back().push_back(X_WB.apply(vertex));
  }
};

/// Makes one body unlike its image without changing its surface: a quadrangle becomes two
/// triangles.
void divide_a_panel(WettedBody& body) {
  for (std::size_t k = 0; k < body.hull.panels.size(); ++k) {
    const Panel panel = body.hull.panels[k];
    if (panel.vertex_count != 4 || panel.centroid.y() < 1.0 || panel.centroid.x() < 1.0) continue;
    const auto& v = panel.vertices;
    body.hull.panels[k] = make_panel(std::vector<Vector3>{v[0], v[1], v[2]});
    body.hull.panels.push_back(make_panel(std::vector<Vector3>{v[0], v[2], v[3]}));
    return;
  }
  FAIL() << "no panel to divide";
}

TEST(MirroredBodies, ABodyBecomesItsOwnImage) {
  Placed placed;
  placed.add(small_barge(), {0, 0, -2});
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  const double volume = placed.bodies[0].hull.displaced_volume();
  divide_a_panel(placed.bodies[0]);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{false, false}));
  mirror_bodies(placed.vertices_W, placed.bodies);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  EXPECT_NEAR(placed.bodies[0].hull.displaced_volume(), volume, 1e-9 * volume);
}

// Nine panels over the length: the middle ones lie across the plane amidships, and are cut there.
TEST(MirroredBodies, PanelsAcrossThePlaneAreCut) {
  Placed placed;
  placed.add(small_barge(9), {0, 0, -2});
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{false, true}));
  const PanelMesh before = placed.bodies[0].hull;
  mirror_bodies(placed.vertices_W, placed.bodies);
  const PanelMesh& hull = placed.bodies[0].hull;
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  EXPECT_NEAR(hull.displaced_volume(), before.displaced_volume(), 1e-9 * before.displaced_volume());
  EXPECT_NEAR(hull.total_area(), before.total_area(), 1e-9 * before.total_area());
  EXPECT_EQ(find_water_lines(placed.bodies).size(), 1U);
  EXPECT_NO_THROW(PanelModel(placed.bodies, {}, {}, {true, true}));
}

// Two barges abreast: the second becomes the image of the first in y = 0, each its own in x = 0.
TEST(MirroredBodies, TwoBodiesMirrorEachOther) {
  Placed placed;
  placed.add(small_barge(), {0, -15, -2});
  placed.add(small_barge(), {0, 15, -2});
  const double volume = placed.bodies[1].hull.displaced_volume();
  divide_a_panel(placed.bodies[1]);
  EXPECT_FALSE(find_symmetry(placed.bodies).y);
  mirror_bodies(placed.vertices_W, placed.bodies);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  EXPECT_NEAR(placed.bodies[1].hull.displaced_volume(), volume, 1e-9 * volume);
  EXPECT_GT(placed.bodies[1].hull.panels[0].centroid.y(), 0);
}

// A hull of Wigley's form in warped quadrangles (Journee 1992: y = B/2 (1 - x^2)(1 - z^2)), which
// run around from the same corner on all sides: warped ones are divided along diagonals that are not
// images. At the feet of the stems three corners of a quadrangle lie in the centre plane.
TEST(MirroredBodies, WarpedQuadranglesMayBeDividedUnlike) {
  constexpr int along = 20, down = 4;
  Hull hull("wigley");
  const auto vertex = [](int i, int k, double side) {
    const double x = std::sin(std::numbers::pi * (static_cast<double>(i) / along - 0.5));
    const double z = static_cast<double>(k) / down;
    return Vector3(1.5 * x, side * 0.15 * (1.0 - x * x) * (1.0 - z * z), -0.1875 * z);
  };
  for (const double side : {1.0, -1.0}) {
    std::vector<int> index;
    for (int i = 0; i <= along; ++i)
      for (int k = 0; k <= down; ++k) index.push_back(hull.add_vertex(vertex(i, k, side)));
    for (int i = 0; i < along; ++i) {
      for (int k = 0; k < down; ++k) {
        const std::size_t a = static_cast<std::size_t>(i * (down + 1) + k), b = a + down + 1;
        const std::array<int, 4> port{index[a], index[b], index[b + 1], index[a + 1]};
        const std::array<int, 4> starboard{index[a], index[a + 1], index[b + 1], index[b]};
        hull.add_panel(side > 0.0 ? port : starboard);
      }
    }
  }
  Placed placed;
  placed.add(hull, Vector3::Zero());
  EXPECT_NE(find_symmetry(placed.bodies), (Symmetry{true, true}));
  const double volume = placed.bodies[0].hull.displaced_volume();
  ASSERT_GT(volume, 0.0);
  mirror_bodies(placed.vertices_W, placed.bodies);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  // 4/9 of length, breadth and draught, less what flat panels cut off: a hundredth and a half.
  EXPECT_NEAR(placed.bodies[0].hull.displaced_volume(), volume, 1e-2 * volume);
  EXPECT_NEAR(volume, 4.0 / 9.0 * 3.0 * 0.3 * 0.1875, 0.03 * volume);
  EXPECT_NO_THROW(PanelModel(placed.bodies, {}, {}, {true, true}));
}

// Another draught, or place: nothing is changed in the plane that has no image.
TEST(MirroredBodies, OthersStayAsTheyAre) {
  Placed placed;
  placed.add(small_barge(), {0, -15, -2});
  placed.add(small_barge(), {5, 15, -2});
  divide_a_panel(placed.bodies[1]);
  const int count = placed.bodies[1].hull.size();
  mirror_bodies(placed.vertices_W, placed.bodies);
  EXPECT_EQ(placed.bodies[1].hull.size(), count);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{false, false}));
}

}  // namespace
}  // namespace blocklift::dynamics
