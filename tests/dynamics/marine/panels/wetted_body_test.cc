#include "dynamics/marine/panels/wetted_body.h"

#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/hull/hydrostatics.h"
#include "dynamics/marine/panels/hull_intersection.h"
#include "dynamics/marine/panels/rankine_problem.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Hull barge() {
  return make_barge({.length = 110, .breadth = 46, .depth = 7.5}, {20, 8, 4, 3}, "barge");
}

Hull ship() {
  return make_ship({.length = 118,
                    .breadth = 20,
                    .depth = 10.6,
                    .draught = 7.6,
                    .bow_length = 38,
                    .stern_length = 32,
                    .transom_breadth = 12},
                   {30, 6, 3, 3});
}

// The cut runs through a row of panels; the volume is length x breadth x draught.
TEST(WettedBody, BargeCutAtItsWaterLine) {
  const WettedBody body = make_wetted_body(barge(), Pose::translation({3, 0, -4.4}), {0, 0, 4.4});
  EXPECT_NEAR(body.hull.displaced_volume(), 110.0 * 46.0 * 4.4, 1e-6);
  EXPECT_LT((body.reference_point - Vector3(3, 0, 0)).norm(), 1e-14);
  const auto lines = find_water_lines(std::vector<WettedBody>{body});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(enclosed_area(lines[0]), 110.0 * 46.0, 1e-6);
  const PanelModel model({body}, {}, {});  // closed, outward, below the surface
  EXPECT_EQ(model.body_mesh().size(), body.hull.size());
}

// Panels of a ship's ends are not flat, and are cut anywhere: the water line closes all the same.
// What flat panels leave out of warped ones is second order in their size.
TEST(WettedBody, WaterLineOfAShipClosesAtAnyDraught) {
  const Hull hull = ship();
  for (const double draught : {0.5, 1.0, 2.15, 3.0, 4.0, 7.6, 9.0}) {
    const Pose X_WB = Pose::translation({0, 0, -draught});
    const WettedBody body = make_wetted_body(hull, X_WB);
    EXPECT_EQ(find_water_lines(std::vector<WettedBody>{body}).size(), 1U) << draught;
    EXPECT_NO_THROW(PanelModel({body}, {}, {})) << draught;
    const double volume = calc_hydrostatics(HullClusters(hull), X_WB).volume;
    EXPECT_NEAR(body.hull.displaced_volume(), volume, 0.01 * volume) << draught;
  }
}

// At the foot of its stem this ship is a sheet in the centre plane: two panels in one place, whose
// potentials nothing tells apart. With them the surface's operator had a negative eigenvalue at the
// bow (-0.72 per metre), and waves grew there by themselves.
TEST(WettedBody, LeavesOutSheetsWithoutThickness) {
  const Hull hull = make_ship({.length = 118,
                               .breadth = 20,
                               .depth = 10.6,
                               .draught = 7.6,
                               .bow_length = 38,
                               .stern_length = 32,
                               .bow_exponent = 2.2,
                               .stern_exponent = 2.6,
                               .transom_breadth = 12,
                               .midship_section_exponent = 9},
                              PanelDivision::of_size(4, 118, 20, 10.6));
  const Pose X_WB = Pose::translation({0, 0, -1});
  const std::vector<WettedBody> bodies{make_wetted_body(hull, X_WB)};
  for (const Panel& panel : bodies[0].hull.panels) {
    EXPECT_FALSE(std::abs(panel.centroid.y()) < 1e-6 && std::abs(panel.normal.y()) > 0.99)
        << panel.centroid.transpose();
  }
  const double volume = calc_hydrostatics(HullClusters(hull), X_WB).volume;
  EXPECT_NEAR(bodies[0].hull.displaced_volume(), volume, 0.01 * volume);
  const PanelModel model(
      bodies,
      make_surface_mesh(find_water_lines(bodies),
                        {.first_ring = 3.0, .growth = 1.4, .radius = 150.0, .edge_share = 0.25}),
      {});
  const RankinePart part(model, {});
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      part.surface_operator().cast<double>(), Eigen::EigenvaluesOnly);
  EXPECT_GT(solver.eigenvalues()[0], 0.0);
}

// Heeled and trimmed, the volume is that of the hydrostatics, which cut the hull exactly.
TEST(WettedBody, HeeledBargeKeepsItsVolume) {
  const Hull hull = barge();
  const Pose X_WB{rotation_about(Vector3(1, 0, 0), 0.06) * rotation_about(Vector3(0, 1, 0), 0.01),
                  {0, 0, -4}};
  const WettedBody body = make_wetted_body(hull, X_WB);
  const Hydrostatics exact = calc_hydrostatics(HullClusters(hull), X_WB);
  EXPECT_NEAR(body.hull.displaced_volume(), exact.volume, 1e-4 * exact.volume);
}

TEST(WettedBody, RefusesADryHull) {
  EXPECT_THAT(
      [] {
        make_wetted_body(barge(), Pose::translation({0, 0, 1}));
      },
      ThrowsMessage<ModelError>(HasSubstr("barge is wholly above the water")));
}

// Heeled and trimmed, panels are cut anywhere and none of a ship's ends is flat.
TEST(WettedBody, WaterLineOfAHeeledShipCloses) {
  const Hull hull = ship();
  for (const double heel : {-0.21, -0.03, 0.004, 0.08, 0.3}) {
    for (const double trim : {-0.02, 0.001, 0.013}) {
      const Pose X_WB{
          rotation_about(Vector3(1, 0, 0), heel) * rotation_about(Vector3(0, 1, 0), trim),
          {0, 0, -3.7}};
      const WettedBody body = make_wetted_body(hull, X_WB);
      EXPECT_EQ(find_water_lines(std::vector<WettedBody>{body}).size(), 1U) << heel << " " << trim;
      EXPECT_NO_THROW(PanelModel({body}, {}, {})) << heel << " " << trim;
      const double volume = calc_hydrostatics(HullClusters(hull), X_WB).volume;
      EXPECT_NEAR(body.hull.displaced_volume(), volume, 0.01 * volume) << heel << " " << trim;
    }
  }
}

Triangles at(const Hull& hull, const Vector3& p) {
  return triangles_of(hull, Pose::translation(p));
}

TEST(HullIntersection, FindsWhatIsInTheWay) {
  const Hull box = make_barge({.length = 10, .breadth = 6, .depth = 4}, {5, 3, 2, 1}, "box");
  const Triangles still = at(box, {0, 0, 0});
  EXPECT_FALSE(find_intersection(still, at(box, {10.1, 0, 0})));
  EXPECT_FALSE(find_intersection(still, at(box, {0, 0, 4})));  // one stands on the other
  EXPECT_FALSE(find_intersection(still, at(box, {0, 6, 0})));  // side by side
  EXPECT_TRUE(find_intersection(still, still));
  EXPECT_TRUE(find_intersection(still, at(box, {0, 4, 0})));  // vertices on each other's planes
  EXPECT_FALSE(find_intersection(still, at(box, {9, 5.9, 4.1})));
  for (const Vector3& p : {Vector3(9.3, 0.2, 0.1), Vector3(5, 0, 0), Vector3(0, 5.9, 0),
                           Vector3(9, 5.9, 3.9), Vector3(0.1, 0.1, 0.1)}) {
    const auto place = find_intersection(still, at(box, p));
    ASSERT_TRUE(place) << p.transpose();
    EXPECT_LT((place->cwiseAbs() - Vector3(5, 3, 4)).maxCoeff(), 1e-9) << place->transpose();
  }
  // One holds the other, seen from either.
  const Hull small = make_barge({.length = 2, .breadth = 1, .depth = 1}, {2, 1, 1, 1}, "small");
  EXPECT_TRUE(find_intersection(still, at(small, {0.3, 0.2, 1})));
  EXPECT_TRUE(find_intersection(at(small, {0.3, 0.2, 1}), still));
  EXPECT_FALSE(find_intersection(still, at(small, {0.3, 0.2, 4.5})));
}

// Water lines that are apart do not tell it: the bulb of one reaches under the other.
TEST(HullIntersection, IsRefusedUnderWaterToo) {
  const auto box = [](const Vector3& low, const Vector3& high) {
    Hull hull("box");
    for (const double z : {low.z(), high.z()}) {
      hull.add_vertex({low.x(), low.y(), z});
      hull.add_vertex({high.x(), low.y(), z});
      hull.add_vertex({high.x(), high.y(), z});
      hull.add_vertex({low.x(), high.y(), z});
    }
    hull.add_panel({3, 2, 1, 0});
    hull.add_panel({4, 5, 6, 7});
    for (int k = 0; k < 4; ++k) hull.add_panel({k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
    return hull;
  };
  WettedBody floating =
      make_wetted_body(box({-2, -2, -3}, {2, 2, 1}), Pose::translation(Vector3::Zero()));
  WettedBody sunken =
      make_wetted_body(box({1, -1, -5}, {9, 1, -2}), Pose::translation(Vector3::Zero()));
  floating.name = "barge";
  sunken.name = "bulb";
  EXPECT_THAT(
      [&] {
        PanelModel({floating, sunken}, {}, {});
      },
      ThrowsMessage<ModelError>(HasSubstr("bodies barge and bulb intersect under water")));
  WettedBody below =
      make_wetted_body(box({1, -1, -6}, {9, 1, -4}), Pose::translation(Vector3::Zero()));
  EXPECT_NO_THROW(PanelModel({floating, below}, {}, {}));
  // Held whole by a hull that is open at the water.
  WettedBody inside =
      make_wetted_body(box({-1, -1, -2}, {1, 1, -1}), Pose::translation(Vector3::Zero()));
  EXPECT_THROW(PanelModel({floating, inside}, {}, {}), ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics
