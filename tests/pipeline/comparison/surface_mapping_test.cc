#include "pipeline/comparison/surface_mapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "pipeline/comparison/triangle_tree.h"
#include "tests/pipeline/comparison/sample_folder.h"

namespace blocklift::pipeline {
namespace {

using Eigen::Vector3d;
using test::sample_stress;
using test::sample_surface;

/// The largest difference between a surface's own values and those mapped onto it.
double largest_error(const BlockSurface& surface, const BlockSurface& reference) {
  const std::vector<double> own = sample_stress(surface, 1), given = sample_stress(reference, 1);
  const std::vector<MappedPoint> mapped = map_surface(surface, reference);
  double largest = 0;
  for (std::size_t i = 0; i < own.size(); ++i)
    largest = std::max(largest, std::abs(own[i] - mapped_value(mapped[i], given)));
  return largest;
}

TEST(SurfaceMapping, SameMeshesAreMappedPointByPointExactly) {
  const BlockSurface surface = sample_surface(3);
  BlockSurface rounded = surface;
  for (double& value : rounded.points) value += 1e-9;
  EXPECT_TRUE(have_same_mesh(surface, rounded));
  EXPECT_EQ(largest_error(surface, surface), 0.0);
  const std::vector<MappedPoint> mapped = map_surface(surface, rounded);
  for (std::size_t i = 0; i < mapped.size(); ++i)
    EXPECT_EQ(mapped[i].points[0], static_cast<std::int32_t>(i));
}

// The field is linear on each plate and other on the bulkhead than on the deck, also where both
// are: finer, coarser and meshes that do not fit each other give it to rounding (of 1e8 Pa).
TEST(SurfaceMapping, AFieldThatIsLinearOnEachPlateIsMappedExactly) {
  for (const int squares : {1, 4, 5, 8, 9})
    EXPECT_LT(largest_error(sample_surface(squares), sample_surface(4)),
              squares == 4 ? 1e-30 : 1e-4)
        << squares;
}

// Between its points a field x^2 is off by at most h^2 / 8 times its second derivative, 2: linear
// interpolation, on an edge of a triangle.
TEST(SurfaceMapping, AFieldThatIsNotLinearIsMappedWithinItsInterpolation) {
  const auto square = [](const BlockSurface& surface) {
    std::vector<double> values;
    for (std::size_t i = 0; i < surface.point_count(); ++i)
      values.push_back(surface.points[3 * i] * surface.points[3 * i]);
    return values;
  };
  for (const int squares : {2, 4, 8}) {
    const BlockSurface fine = sample_surface(16), coarse = sample_surface(squares);
    const std::vector<double> own = square(fine), given = square(coarse);
    const std::vector<MappedPoint> mapped = map_surface(fine, coarse);
    double largest = 0;
    for (std::size_t i = 0; i < own.size(); ++i)
      largest = std::max(largest, std::abs(own[i] - mapped_value(mapped[i], given)));
    const double edge = 4.0 / squares;
    EXPECT_NEAR(largest, edge * edge / 4, 1e-9) << squares;
  }
}

TEST(SurfaceMapping, APartThatTheReferenceLacksHasNoCounterpart) {
  const BlockSurface surface = sample_surface(4, "new bulkhead");
  for (const BlockSurface& reference : {sample_surface(4), sample_surface(3)}) {
    const std::vector<MappedPoint> mapped = map_surface(surface, reference);
    for (std::size_t quad = 0; quad < surface.quad_count(); ++quad)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto point = static_cast<std::size_t>(surface.quads[4 * quad + i]);
        EXPECT_EQ(mapped[point].has_counterpart(), surface.quad_groups[quad] == 0);
      }
  }
  EXPECT_TRUE(std::isnan(mapped_value(MappedPoint{}, {1, 2, 3})));
}

TEST(SurfaceMapping, APlateThatWasMadeLongerHasNoCounterpartBeyondAnEdge) {
  BlockSurface longer = sample_surface(4);
  for (std::size_t i = 0; i < longer.point_count(); ++i) longer.points[3 * i] *= 1.5;  // 12 m
  const std::vector<MappedPoint> mapped = map_surface(longer, sample_surface(4));
  for (std::size_t i = 0; i < longer.point_count(); ++i)
    EXPECT_EQ(mapped[i].has_counterpart(), longer.points[3 * i] <= 8 + 1.5 + 1e-9) << i;
}

TEST(SurfaceMapping, SurfacesWithoutGroupsAreOnePart) {
  BlockSurface surface = sample_surface(4), reference = sample_surface(3);
  for (BlockSurface* one : {&surface, &reference}) {
    one->quad_groups.clear();
    one->groups.clear();
  }
  for (const MappedPoint& place : map_surface(surface, reference))
    EXPECT_TRUE(place.has_counterpart());
}

TEST(NearestOnTriangle, IsAPlaceInsideOnAnEdgeOrACorner) {
  const std::array<Vector3d, 3> corners{Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)};
  const auto place = [&](const Vector3d& point) -> Vector3d {
    const NearestPlace found = nearest_on_triangle(point, corners);
    Vector3d where = found.weights[0] * corners[0] + found.weights[1] * corners[1] +
                     found.weights[2] * corners[2];
    EXPECT_NEAR((where - point).norm(), found.distance, 1e-12);
    return where;
  };
  EXPECT_TRUE(place({1, 1, 3}).isApprox(Vector3d(1, 1, 0)));
  EXPECT_TRUE(place({3, 3, -1}).isApprox(Vector3d(2, 2, 0)));
  EXPECT_TRUE(place({2, -5, 0}).isApprox(Vector3d(2, 0, 0)));
  EXPECT_TRUE(place({9, -1, 2}).isApprox(Vector3d(4, 0, 0)));
}

TEST(NearestOnTriangle, ATriangleMayBeALineOrAPoint) {
  const Vector3d a(0, 0, 0), b(2, 0, 0);
  EXPECT_NEAR(nearest_on_triangle({1, 1, 0}, {a, b, b}).distance, 1, 1e-12);
  EXPECT_NEAR(nearest_on_triangle({3, 0, 0}, {a, b, Vector3d(1, 0, 0)}).distance, 1, 1e-12);
  EXPECT_NEAR(nearest_on_triangle({0, 3, 4}, {a, a, a}).distance, 5, 1e-12);
}

// The tree against all triangles one by one, places of pseudorandom numbers.
TEST(TriangleTree, FindsWhatLookingAtEachTriangleFinds) {
  std::srand(7);
  std::vector<TriangleTree::Triangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const Vector3d corner = 10 * Vector3d::Random();
    triangles.push_back(
        {{corner, corner + Vector3d::Random(), corner + Vector3d::Random()}, i % 3});
  }
  const TriangleTree tree(triangles);
  for (int i = 0; i < 200; ++i) {
    const Vector3d point = 12 * Vector3d::Random();
    std::array<double, 3> nearest{1e9, 1e9, 1e9};
    for (const TriangleTree::Triangle& triangle : triangles) {
      double& least = nearest[triangle.plate];
      least = std::min(least, nearest_on_triangle(point, triangle.corners).distance);
    }
    EXPECT_DOUBLE_EQ(tree.find_nearest(point).distance,
                     *std::min_element(nearest.begin(), nearest.end()));
    EXPECT_DOUBLE_EQ(tree.find_nearest(point, 1, 1e9).distance, nearest[1]);
    EXPECT_FALSE(tree.find_nearest(point, 1, 0.99 * nearest[1]).is_found());
  }
  EXPECT_FALSE(TriangleTree({}).find_nearest(Vector3d::Zero()).is_found());
}

}  // namespace
}  // namespace blocklift::pipeline
