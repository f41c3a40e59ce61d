#include "dynamics/marine/hull/hull.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "dynamics/marine/hull/hull_shapes.h"

namespace blocklift::dynamics {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

const PanelDivision coarse = {6, 4, 3, 2};

std::vector<HullDefectKind> kinds_of(const std::vector<HullDefect>& defects) {
  std::vector<HullDefectKind> kinds;
  for (const HullDefect& defect : defects) {
    if (kinds.empty() || kinds.back() != defect.kind) kinds.push_back(defect.kind);
  }
  return kinds;
}

// A hull with the panels of another, each first changed or left out (empty).
template <class Change>
Hull changed(const Hull& hull, Change&& change) {
  Hull result(hull.name());
  for (const Vector3& p : hull.vertices()) result.add_vertex(p);
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    std::vector<int> corners(hull.panel(panel).begin(), hull.panel(panel).end());
    change(panel, corners);
    if (!corners.empty()) result.add_panel(corners);
  }
  return result;
}

// A solid box of unit density: m/12 (b^2 + c^2); moved, its centre moves along and no more.
TEST(Hull, EncloseVolumeCentreAndInertiaOfABox) {
  const Hull box = transform(Pose{rotation_about(Vector3::UnitZ(), 0.5), {100, -30, 7}},
                             make_box({4, 3, 2}, coarse));
  const EnclosedVolume enclosed = calc_enclosed_volume(box);
  EXPECT_NEAR(enclosed.volume, 24.0, 1e-12);
  EXPECT_LT((enclosed.centre - Vector3(100, -30, 7)).norm(), 1e-12);
  EXPECT_NEAR(enclosed.inertia.zz, 24.0 / 12.0 * (16 + 9), 1e-10);
  EXPECT_NEAR(enclosed.inertia.trace(), 24.0 / 6.0 * (16 + 9 + 4), 1e-10);
}

// Prisms by hand: bilges take (1 - pi/4) r^2 each off the section (chords of the arc converge with
// the square of their number), rakes and corners take wedges off.
TEST(HullShapes, BargeHasTheVolumeOfItsParts) {
  const BargeShape plain = {.length = 110, .breadth = 46, .depth = 7.5};
  EXPECT_NEAR(calc_enclosed_volume(make_barge(plain, coarse)).volume, 110 * 46 * 7.5, 1e-8);

  BargeShape raked = plain;
  raked.bow_rake_length = 12;
  raked.bow_rake_height = 5;
  raked.stern_rake_length = 6;
  raked.stern_rake_height = 2;
  EXPECT_NEAR(calc_enclosed_volume(make_barge(raked, coarse)).volume,
              110 * 46 * 7.5 - 46 * (12 * 5 + 6 * 2) / 2, 1e-8);

  BargeShape cornered = plain;
  cornered.corner_length = 4;
  cornered.corner_breadth = 3;
  EXPECT_NEAR(calc_enclosed_volume(make_barge(cornered, coarse)).volume,
              (110 * 46 - 4 * 4 * 3 / 2.0) * 7.5, 1e-8);

  BargeShape round = plain;
  round.bilge_radius = 1.5;
  const double exact = 110 * (46 * 7.5 - 2 * (1 - std::numbers::pi / 4) * 1.5 * 1.5);
  const auto error = [&](int n) {
    return exact - calc_enclosed_volume(make_barge(round, {6, 4, 3, n})).volume;
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 2.0, 0.02);
}

TEST(HullShapes, AreSoundAtManyProportions) {
  for (const int n : {1, 2, 5}) {
    const PanelDivision division = {4 * n, 2 * n, n, n};
    BargeShape barge = {.length = 110, .breadth = 46, .depth = 7.5, .bilge_radius = 1.0};
    barge.bow_rake_length = 12, barge.bow_rake_height = 5, barge.corner_length = 4;
    barge.corner_breadth = 3;
    EXPECT_THAT(diagnose(make_barge(barge, division)), IsEmpty());
    ShipShape ship = {.length = 120,
                      .breadth = 20,
                      .depth = 11,
                      .draught = 7,
                      .bow_length = 45,
                      .stern_length = 40};
    EXPECT_THAT(diagnose(make_ship(ship, division), {.largest_warp = 0.5}), IsEmpty());
    ship.transom_breadth = 12;
    EXPECT_THAT(diagnose(make_ship(ship, division), {.largest_warp = 0.5}), IsEmpty());
    EXPECT_THAT(diagnose(make_wigley(100, 10, 6.25, 3, division), {.largest_warp = 0.5}),
                IsEmpty());
  }
}

TEST(HullShapes, RefuseWhatDoesNotFit) {
  EXPECT_THAT(
      [] { make_barge({.length = 10, .breadth = 4, .depth = 2, .bilge_radius = 3}, coarse); },
      ThrowsMessage<ModelError>(HasSubstr("bilge radius 3.000000; it must lie between")));
  EXPECT_THAT([] { make_barge({.length = -10, .breadth = 4, .depth = 2}, coarse); },
              ThrowsMessage<ModelError>(HasSubstr("length -10.000000")));
}

// 4/9 L B T below the water; flat panels inscribed in the parabolas converge with the second order.
TEST(HullShapes, WigleyHullConvergesToItsVolume) {
  const auto error = [](int n) {
    const Hull hull = make_wigley(100, 10, 6.25, 3, {2 * n, 2, n, 1});
    const double above = 2.0 / 3.0 * 100 * 10 * 3;
    return calc_enclosed_volume(hull).volume - above - 4.0 / 9.0 * 100 * 10 * 6.25;
  };
  EXPECT_LT(std::abs(error(16)), 0.02 * 2777.8);
  EXPECT_NEAR(std::log2(error(8) / error(16)), 2.0, 0.1);
}

TEST(HullDiagnosis, NamesAnOpenEdgeWithItsPlace) {
  const Hull open = changed(make_box({4, 2, 2}, {2, 1, 1, 1}), [](int panel, auto& corners) {
    if (panel == 0) corners.clear();
  });
  const std::vector<HullDefect> defects = diagnose(open);
  EXPECT_THAT(kinds_of(defects), ElementsAre(HullDefectKind::open_edge));
  EXPECT_EQ(defects.size(), 4U);
  EXPECT_THAT(defects[0].message, HasSubstr("(-2, -1, -1)"));
  EXPECT_THAT(defects[0].message, HasSubstr("not closed"));
}

TEST(HullDiagnosis, FindsTurnedPanelsAndInwardHulls) {
  const Hull box = make_box({4, 2, 2}, {2, 1, 1, 1});
  const Hull twisted = changed(box, [](int panel, auto& corners) {
    if (panel == 3) std::reverse(corners.begin(), corners.end());
  });
  EXPECT_THAT(kinds_of(diagnose(twisted)), ElementsAre(HullDefectKind::twisted_edge));
  EXPECT_THAT(kinds_of(diagnose(reverse(box))), ElementsAre(HullDefectKind::inward));
  EXPECT_THAT(diagnose(reverse(reverse(box))), IsEmpty());
}

TEST(HullDiagnosis, FindsDegenerateWarpedDoubledAndBrokenPanels) {
  const Hull box = make_box({4, 2, 2}, {2, 1, 1, 1});
  EXPECT_THAT(kinds_of(diagnose(changed(box,
                                        [](int panel, auto& corners) {
                                          if (panel == 2) corners[1] = corners[0];
                                        }))),
              ::testing::Contains(HullDefectKind::degenerate_panel));
  Hull doubled = box;
  doubled.add_panel(box.panel(1));
  EXPECT_THAT(kinds_of(diagnose(doubled)),
              ElementsAre(HullDefectKind::doubled_panel, HullDefectKind::crowded_edge));
  EXPECT_THAT(diagnose(doubled)[0].message, ::testing::HasSubstr("remove one of them"));
  Hull wall = box;
  std::vector<int> turned(box.panel(1).begin(), box.panel(1).end());
  std::reverse(turned.begin(), turned.end());
  wall.add_panel(turned);
  EXPECT_THAT(diagnose(wall)[0].message, ::testing::HasSubstr("remove both"));
  Hull broken = box;
  broken.add_vertex({0, not_a_number, 0});
  EXPECT_THAT(kinds_of(diagnose(broken)), ElementsAre(HullDefectKind::not_finite));
  Hull warped("w");
  for (const Vector3& p :
       {Vector3(0, 0, 0), Vector3(1, 0, 0.5), Vector3(1, 1, 0), Vector3(0, 1, 0.5)})
    warped.add_vertex(p);
  warped.add_panel({0, 1, 2, 3});
  EXPECT_THAT(kinds_of(diagnose(warped)), ::testing::Contains(HullDefectKind::warped_panel));
}

TEST(HullDiagnosis, HoldsTheHullAgainstWaterAndWaves) {
  const Hull box = make_box({40, 20, 4}, {4, 2, 1, 1});
  EXPECT_THAT(kinds_of(diagnose(box, {.water_level = -3})),
              ElementsAre(HullDefectKind::above_water));
  EXPECT_THAT(kinds_of(diagnose(box, {.water_level = 3})),
              ElementsAre(HullDefectKind::below_water));
  const std::vector<HullDefect> large =
      diagnose(box, {.water_level = 0, .shortest_wave_length = 60, .most_of_a_kind = 2});
  EXPECT_THAT(kinds_of(large), ElementsAre(HullDefectKind::large_panel));
  ASSERT_EQ(large.size(), 2U);
  EXPECT_THAT(large[0].message, HasSubstr("longest edge is 10 m"));
  EXPECT_THAT(large[0].message, HasSubstr("at most 7.5 m"));
  EXPECT_THAT(large[1].message, HasSubstr("more of this kind"));
  EXPECT_THAT(diagnose(box, {.water_level = 0, .shortest_wave_length = 80}), IsEmpty());
}

TEST(Hull, HalvesMirrorAndOpeningsClose) {
  const Hull box = make_box({4, 2, 2}, {4, 2, 2, 1});
  const Hull half = changed(box, [&](int panel, auto& corners) {
    if (box.panel_midpoint(panel).y() < 0 || box.panel_midpoint(panel).z() > 0.99) corners.clear();
  });
  const Hull whole = with_mirror_image(half, 1, 1e-9);
  EXPECT_THAT(kinds_of(diagnose(whole)), ElementsAre(HullDefectKind::open_edge));
  const Hull closed = with_lids(whole, 1e-9);
  EXPECT_THAT(diagnose(closed), IsEmpty());
  EXPECT_NEAR(calc_enclosed_volume(closed).volume, 16.0, 1e-12);
}

// A hull of warped panels (Wigley's: parabolas in both directions), a quarter mirrored twice: by
// symmetry it holds four quarters about a centre in both planes, to rounding.
TEST(Hull, ImagesOfWarpedPanelsAreImages) {
  const int columns = 4, rows = 3;
  Hull quarter("wigley");
  for (int i = 0; i <= columns; ++i) {
    for (int k = 0; k <= rows; ++k) {
      const double x = static_cast<double>(i) / columns, z = static_cast<double>(k) / rows - 1.0;
      quarter.add_vertex({50.0 * x, 5.0 * (1.0 - x * x) * (1.0 - z * z), 6.25 * z});
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (int k = 0; k < rows; ++k) {
      const int a = (rows + 1) * i + k, b = a + rows + 1;
      quarter.add_panel({a, a + 1, b + 1, b});
    }
  }
  // Over x = 0, y = 0 and z = 0 there is nothing to sum as seen from the origin.
  double volume = 0.0;
  for (int panel = 0; panel < quarter.panel_count(); ++panel) {
    for (const int number : {0, 1}) {
      const auto [a, b, c] = quarter.triangle(panel, number);
      volume += a.dot(b.cross(c)) / 6.0;
    }
  }
  ASSERT_GT(volume, 500.0);
  const Hull bare = with_mirror_image(with_mirror_image(quarter, 0, 1e-9), 1, 1e-9);
  const Hull whole = with_lids(bare, 1e-9);
  const EnclosedVolume enclosed = calc_enclosed_volume(whole);
  EXPECT_NEAR(enclosed.volume, 4.0 * volume, 1e-9);
  EXPECT_NEAR(enclosed.centre.x(), 0.0, 1e-9);
  EXPECT_NEAR(enclosed.centre.y(), 0.0, 1e-9);
  EXPECT_NEAR(calc_enclosed_volume(reverse(whole)).volume, -enclosed.volume, 1e-9);
}

TEST(Hull, RefusesALidOnABentRim) {
  const Hull box = make_box({4, 2, 2}, {2, 1, 2, 1});
  const Hull open = changed(box, [&](int panel, auto& corners) {
    const Vector3 p = box.panel_midpoint(panel);
    if (p.z() > 0.99 || (p.x() > 1.99 && p.z() > 0)) corners.clear();
  });
  EXPECT_THAT([&] { with_lids(open, 1e-6); }, ThrowsMessage<ModelError>(HasSubstr("not flat")));
}

TEST(Hull, RefusesPanelsOnVerticesThatAreNot) {
  Hull hull("h7");
  hull.add_vertex(Vector3::Zero());
  EXPECT_THAT(
      [&] {
        hull.add_panel({0, 1, 2});
      },
      ThrowsMessage<ModelError>(HasSubstr("hull \"h7\", panel 0 has the vertex 1")));
}

}  // namespace
}  // namespace blocklift::dynamics
