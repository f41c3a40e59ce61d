// Which shells lie near a place, what a ray meets.
#include "structure/mesh/fields/shell_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace blocklift::structure {
namespace {

/// Squares of 1 m on the plane z = 0, `count` along each side.
Mesh plane(int count) {
  Mesh mesh;
  const int row = count + 1;
  for (int j = 0; j <= count; ++j)
    for (int i = 0; i <= count; ++i) mesh.vertices.emplace_back(i, j, 0);
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const int a = j * row + i;
      mesh.shells.push_back({{a, a + 1, a + row, a + row + 1}, 0, 0, -1, 0});
    }
  return mesh;
}

std::vector<int> all_of(const Mesh& mesh) {
  std::vector<int> shells(mesh.shells.size());
  std::iota(shells.begin(), shells.end(), 0);
  return shells;
}

TEST(ShellTree, FindsTheShellsNearAPlace) {
  const Mesh mesh = plane(20);
  const ShellTree tree(mesh, all_of(mesh));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1, 21);
  for (int k = 0; k < 200; ++k) {
    const Vector3 place(anywhere(random), anywhere(random), 0.3);
    const double distance = 0.5;
    std::vector<int> found;
    tree.for_each_near(place, distance, [&](int shell) { found.push_back(shell); });
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
    for (int shell = 0; shell < static_cast<int>(mesh.shells.size()); ++shell) {
      const double x = shell % 20, y = static_cast<double>(shell / 20);
      const double beside = Eigen::Vector2d(place.x() - std::clamp(place.x(), x, x + 1),
                                            place.y() - std::clamp(place.y(), y, y + 1))
                                .norm();
      if (std::hypot(beside, place.z()) >= distance) continue;
      EXPECT_TRUE(std::find(found.begin(), found.end(), shell) != found.end()) << place;
    }
    EXPECT_LE(found.size(), 16U);  // those of a leaf at most come along
  }
}

TEST(ShellTree, RaysMeetThePlaneWhereItIsAndEdgesLetNothingThrough) {
  const Mesh mesh = plane(8);
  const ShellTree tree(mesh, all_of(mesh));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-2, 10), slope(-1, 1);
  for (int k = 0; k < 500; ++k) {
    const Vector3 origin(anywhere(random), anywhere(random), 1);
    const Vector3 direction = Vector3(slope(random), slope(random), -1).normalized();
    const Vector3 met = origin - origin.z() / direction.z() * direction;
    const bool is_inside = met.head<2>().minCoeff() > 0 && met.head<2>().maxCoeff() < 8;
    EXPECT_EQ(tree.is_hit(origin, direction, 0), is_inside) << met.transpose();
    EXPECT_FALSE(tree.is_hit(origin, -direction, 0));
    EXPECT_FALSE(tree.is_hit(origin, direction, (met - origin).norm() + 1e-6));
  }
  for (const Vector3& on_edge : {Vector3(3, 3, 1), Vector3(3, 2.5, 1), Vector3(2.5, 2.5, 1)})
    EXPECT_TRUE(tree.is_hit(on_edge, -Vector3::UnitZ(), 0));
  // Edgewise.
  EXPECT_FALSE(tree.is_hit({-1, 2.2, 0}, Vector3::UnitX(), 0));
}

TEST(ShellTree, CurvedShellsAreMetWhereTheyBulge) {
  // A quarter of a cylinder of radius 1 m about x, as one shell of order 4.
  Mesh mesh;
  Eigen::Matrix3Xd points(3, 25);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) {
      const double angle = std::numbers::pi / 2 * j / 4;
      points.col(5 * j + i) << i / 4.0, std::cos(angle), std::sin(angle);
    }
  for (const int corner : {0, 4, 20, 24}) mesh.vertices.emplace_back(points.col(corner));
  mesh.curved_shells.push_back(points);
  mesh.shells.push_back({{0, 1, 2, 3}, 0, 0, 0, 0});
  const ShellTree tree(mesh, {0});
  const Vector3 outwards = Vector3(0, 1, 1).normalized();
  EXPECT_TRUE(tree.is_hit({0.5, 0, 0}, outwards, 0.99));  // the chord lies at 0.71 m
  EXPECT_FALSE(tree.is_hit({0.5, 0, 0}, outwards, 1.01));
}

TEST(SquaredDistance, IsThatOfInsideEdgesAndCorners) {
  const Vector3 a(0, 0, 0), x(2, 0, 0), y(0, 1, 0);
  EXPECT_NEAR(squared_distance({0.5, 0.25, 3}, a, x, y), 9, 1e-14);
  EXPECT_NEAR(squared_distance({-1, 0.5, 2}, a, x, y), 5, 1e-14);
  EXPECT_NEAR(squared_distance({-1, -2, 0}, a, x, y), 5, 1e-14);
  EXPECT_NEAR(squared_distance({3, -1, 1}, a, x, y), 3, 1e-14);
  // Beyond the long edge x / 2 + y = 1, whose unit normal is (1, 2) / sqrt 5.
  EXPECT_NEAR(squared_distance({1 + 1, 0.5 + 2, 0}, a, x, y), 5, 1e-13);
  // A triangle that is a line.
  EXPECT_NEAR(squared_distance({1, 1, 0}, a, x, Vector3::Zero()), 1, 1e-14);
}

}  // namespace
}  // namespace blocklift::structure
