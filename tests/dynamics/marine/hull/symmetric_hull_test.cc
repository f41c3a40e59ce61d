// Hulls whose mesh becomes symmetric.
#include "dynamics/marine/hull/symmetric_hull.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "dynamics/marine/hull/hull_shapes.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// A sphere of meridians and parallels whose poles lie aslant: symmetric, but not its mesh.
Hull slanted_sphere(double radius) {
  constexpr int meridians = 24, parallels = 12;
  Hull hull("sphere");
  const Matrix3 R = rotation_about(Vector3(1, 2, 0.5).normalized(), 0.7);
  const auto at = [&](double polar, double azimuth) {
    return Vector3(radius * R *
                   Vector3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                           std::cos(polar)));
  };
  const int top = hull.add_vertex(at(0, 0)), bottom = hull.add_vertex(at(std::numbers::pi, 0));
  for (int i = 1; i < parallels; ++i) {
    for (int j = 0; j < meridians; ++j) {
      hull.add_vertex(at(std::numbers::pi * i / parallels, 2.0 * std::numbers::pi * j / meridians));
    }
  }
  const auto vertex = [&](int i, int j) { return 2 + (i - 1) * meridians + j % meridians; };
  for (int j = 0; j < meridians; ++j) {
    hull.add_panel({top, vertex(1, j), vertex(1, j + 1)});
    for (int i = 1; i + 1 < parallels; ++i) {
      hull.add_panel({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
    hull.add_panel({bottom, vertex(parallels - 1, j + 1), vertex(parallels - 1, j)});
  }
  return hull;
}

void expect_images(const Hull& hull, int axis) {
  for (const Vector3& vertex : hull.vertices()) {
    Vector3 image = vertex;
    image[axis] = -image[axis];
    double nearest = 1.0;
    for (const Vector3& other : hull.vertices()) {
      nearest = std::min(nearest, (other - image).norm());
    }
    EXPECT_LT(nearest, 1e-9) << vertex.transpose();
  }
}

TEST(SymmetricHull, IsClosedAndItsOwnImage) {
  const Hull sphere = slanted_sphere(5.0);
  ASSERT_THAT(diagnose(sphere, {.largest_warp = 0.5}), IsEmpty());
  const Hull both = made_symmetric(sphere, {1, 0});
  EXPECT_THAT(diagnose(both, {.largest_warp = 0.5}), IsEmpty());
  expect_images(both, 0);
  expect_images(both, 1);
  const double volume = calc_enclosed_volume(sphere).volume;
  EXPECT_NEAR(calc_enclosed_volume(both).volume, volume, 5e-3 * volume);
  for (int k = 0; k < both.panel_count(); ++k) {
    for (int axis = 0; axis < 2; ++axis) {
      double low = 0.0, high = 0.0;
      for (const int corner : both.panel(k)) {
        low = std::min(low, both.vertex(corner)[axis]);
        high = std::max(high, both.vertex(corner)[axis]);
      }
      EXPECT_TRUE(low > -1e-12 || high < 1e-12) << "panel " << k << " lies across the plane";
    }
  }
}

// What is symmetric already keeps its volume to the last digit.
TEST(SymmetricHull, ABargeStaysABarge) {
  const Hull barge = make_barge({.length = 40, .breadth = 20, .depth = 6}, {8, 5, 3, 2});
  const Hull both = made_symmetric(barge, {1});
  EXPECT_THAT(diagnose(both, {}), IsEmpty());
  EXPECT_NEAR(calc_enclosed_volume(both).volume, 40 * 20 * 6, 1e-9);
}

TEST(SymmetricHull, RefusesWhatIsNotSymmetric) {
  const Hull aside = transform(Pose::translation({0, 1.0, 0}), slanted_sphere(5.0));
  EXPECT_THAT([&] { made_symmetric(aside, {1}); },
              ThrowsMessage<ModelError>(HasSubstr("not symmetric in y = 0")));
  const Hull beyond = transform(Pose::translation({-20.0, 0, 0}), slanted_sphere(5.0));
  EXPECT_THAT([&] { made_symmetric(beyond, {0}); },
              ThrowsMessage<ModelError>(HasSubstr("no panel lies at positive x")));
}

}  // namespace
}  // namespace blocklift::dynamics
