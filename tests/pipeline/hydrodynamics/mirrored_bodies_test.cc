#include "pipeline/hydrodynamics/mirrored_bodies.h"

#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/panels/wetted_body.h"

namespace blocklift::pipeline {
namespace {

using dynamics::Hull;
using dynamics::Panel;
using dynamics::Pose;
using dynamics::Symmetry;
using dynamics::Vector3;
using dynamics::WettedBody;

using Vertices = std::vector<std::vector<Vector3>>;

Hull barge() {
  return dynamics::make_barge({.length = 40, .breadth = 20, .depth = 6}, {8, 4, 3, 2}, "barge");
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
    body.hull.panels[k] = dynamics::make_panel(std::vector<Vector3>{v[0], v[1], v[2]});
    body.hull.panels.push_back(dynamics::make_panel(std::vector<Vector3>{v[0], v[2], v[3]}));
    return;
  }
  FAIL() << "no panel to divide";
}

TEST(MirroredBodies, ABodyBecomesItsOwnImage) {
  Placed placed;
  placed.add(barge(), {0, 0, -2});
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  const double volume = placed.bodies[0].hull.displaced_volume();
  divide_a_panel(placed.bodies[0]);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{false, false}));
  mirror_bodies(placed.vertices_W, placed.bodies);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  EXPECT_NEAR(placed.bodies[0].hull.displaced_volume(), volume, 1e-9 * volume);
}

// Two barges abreast: the second becomes the image of the first in y = 0, each its own in x = 0.
TEST(MirroredBodies, TwoBodiesMirrorEachOther) {
  Placed placed;
  placed.add(barge(), {0, -15, -2});
  placed.add(barge(), {0, 15, -2});
  const double volume = placed.bodies[1].hull.displaced_volume();
  divide_a_panel(placed.bodies[1]);
  EXPECT_FALSE(find_symmetry(placed.bodies).y);
  mirror_bodies(placed.vertices_W, placed.bodies);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{true, true}));
  EXPECT_NEAR(placed.bodies[1].hull.displaced_volume(), volume, 1e-9 * volume);
  EXPECT_GT(placed.bodies[1].hull.panels[0].centroid.y(), 0);
}

// Another draught, or place: nothing is changed in the plane that has no image.
TEST(MirroredBodies, OthersStayAsTheyAre) {
  Placed placed;
  placed.add(barge(), {0, -15, -2});
  placed.add(barge(), {5, 15, -2});
  divide_a_panel(placed.bodies[1]);
  const int count = placed.bodies[1].hull.size();
  mirror_bodies(placed.vertices_W, placed.bodies);
  EXPECT_EQ(placed.bodies[1].hull.size(), count);
  EXPECT_EQ(find_symmetry(placed.bodies), (Symmetry{false, false}));
}

}  // namespace
}  // namespace blocklift::pipeline
