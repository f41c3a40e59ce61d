#include "dynamics/marine/wetted_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull_shapes.h"
#include "dynamics/marine/hydrostatics.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Hull barge() {
  return make_barge({.length = 110, .breadth = 46, .depth = 7.5}, {20, 8, 4, 3}, "barge");
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

// Panels of a ship's ends are not flat, and are cut anywhere: the water line closes all the same. What
// flat panels leave out of warped ones is second order in their size.
TEST(WettedBody, WaterLineOfAShipClosesAtAnyDraught) {
  const Hull ship = make_ship({.length = 118,
                               .breadth = 20,
                               .depth = 10.6,
                               .draught = 7.6,
                               .bow_length = 38,
                               .stern_length = 32,
                               .transom_breadth = 12},
                              {30, 6, 3, 3});
  for (const double draught : {0.5, 1.0, 2.15, 3.0, 4.0, 7.6, 9.0}) {
    const Pose X_WB = Pose::translation({0, 0, -draught});
    const WettedBody body = make_wetted_body(ship, X_WB);
    EXPECT_EQ(find_water_lines(std::vector<WettedBody>{body}).size(), 1U) << draught;
    EXPECT_NO_THROW(PanelModel({body}, {}, {})) << draught;
    const double volume = calc_hydrostatics(HullClusters(ship), X_WB).volume;
    EXPECT_NEAR(body.hull.displaced_volume(), volume, 0.01 * volume) << draught;
  }
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

}  // namespace
}  // namespace blocklift::dynamics
