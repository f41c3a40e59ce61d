#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "algebra/decompositions.h"
#include "structure/system/held_points.h"

namespace blocklift::structure {
namespace {

// What is held of the six rigid motions, rotations about the first point over its size: of a
// support that holds them all no combination of them is left.
double least_resistance(const Eigen::Matrix3Xd& points, double size) {
  const std::vector<HeldComponent> support = hold_points(points);
  EXPECT_EQ(support.size(), 6U);
  Eigen::Matrix<double, 6, 6> rows = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index r = 0; r < 6; ++r) {
    const HeldComponent& held = support[static_cast<std::size_t>(r)];
    const Vector3 axis = Vector3::Unit(held.axis % 3);
    const Vector3 place = points.col(held.point) - points.col(support[0].point);
    if (held.axis < 3)
      rows.row(r) << axis.transpose(), place.cross(axis).transpose() / size;
    else
      rows.row(r) << Eigen::RowVector3d::Zero(), axis.transpose();
  }
  return algebra::smallest_singular_value(rows);
}

// The nodes of a pipe lie on a line, to the digits that its deck has; along a diagonal of the axes
// it is held worst, where no axis lies along it.
TEST(Support, PointsOnALineAreHeldAgainstATurnAboutIt) {
  constexpr double length = 12;
  for (const Vector3& along : {Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(0, 0, 1),
                               Vector3(1, 1, 1), Vector3(-3, 2, 0.1)})
    for (const double rounding : {0.0, 1e-8}) {
      Eigen::Matrix3Xd points(3, 7);
      for (int i = 0; i < 7; ++i)
        points.col(i) = Vector3(100, -50, 20) + i * length / 6 * along.normalized() +
                        rounding * length * Vector3((i * 7) % 3, (i * 5) % 4, i % 2);
      EXPECT_GT(least_resistance(points, length), 0.1) << along.transpose();
    }
}

// Three points that are no line, however thin their triangle is, need no node that turns.
TEST(Support, PointsBesideALineAreHeldByDisplacements) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 4, 8, 12, 0, 0.002, 0, 0, 0, 0, 0, 0;
  for (const HeldComponent& held : hold_points(points)) EXPECT_LT(held.axis, 3);
  EXPECT_GT(least_resistance(points, 12), 1e-5);
}

}  // namespace
}  // namespace blocklift::structure
