// Skew of four slings on either diagonal, as the structure feels it.
#include "pipeline/checks/structure_skew.h"

#include <cmath>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

using structure::Vector3;

/// Slings from the corners of a rectangle to a hook above it.
std::array<DiagonalSling, 4> pyramid(const Vector3& hook, const std::array<double, 4>& tensions,
                                     double skew) {
  const std::array<Vector3, 4> corners{Vector3(-3, -2, 0), Vector3(3, -2, 0), Vector3(3, 2, 0),
                                       Vector3(-3, 2, 0)};
  std::array<DiagonalSling, 4> slings;
  for (std::size_t i = 0; i < 4; ++i)
    slings[i] = {corners[i], tensions[i] * (hook - corners[i]).normalized(), skew};
  return slings;
}

// Four equal slings at 1.25: 62.5 to 37.5 per cent on the diagonals, either way.
TEST(StructureSkew, EqualSlingsShareByTheirFactor) {
  const auto slings = pyramid({0, 0, 4}, {1e5, 1e5, 1e5, 1e5}, 1.25);
  const auto changes = diagonal_changes(slings);
  ASSERT_TRUE(changes);
  for (std::size_t i = 0; i < 4; ++i) {
    const double one = (*changes)[0][i].dot(slings[i].force) / 1e10,
                 other = (*changes)[1][i].dot(slings[i].force) / 1e10;
    EXPECT_NEAR(std::abs(one), 0.25, 1e-12);
    EXPECT_NEAR(other, -one, 1e-12);
    EXPECT_NEAR((*changes)[0][i].norm(), 0.25e5, 1e-6);
  }
  // Neighbours differ, those across agree.
  EXPECT_GT((*changes)[0][0].dot(slings[0].force) * (*changes)[0][2].dot(slings[2].force), 0);
  EXPECT_LT((*changes)[0][0].dot(slings[0].force) * (*changes)[0][1].dot(slings[1].force), 0);
}

// The hook off the middle: neither force nor moment is left over, and of the slings that bear more
// one just reaches its factor.
TEST(StructureSkew, ChangesAreInBalance) {
  const auto slings = pyramid({0.4, -0.3, 5}, {9e4, 1.1e5, 8e4, 1.2e5}, 1.3);
  const auto changes = diagonal_changes(slings);
  ASSERT_TRUE(changes);
  for (const DiagonalChange& change : *changes) {
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    double least_raised = 10;
    for (std::size_t i = 0; i < 4; ++i) {
      force += change[i];
      moment += slings[i].p_B.cross(change[i]);
      if (change[i].dot(slings[i].force) > 0)
        least_raised =
            std::min(least_raised, (slings[i].force + change[i]).norm() / slings[i].force.norm());
    }
    EXPECT_LT(force.norm(), 1e-6);
    EXPECT_LT(moment.norm(), 1e-5);
    EXPECT_NEAR(least_raised, 1.3, 1e-12);
  }
}

// A factor beyond two equal slings' share leaves two of them slack, and no more.
TEST(StructureSkew, NoSlingPushes) {
  const auto slings = pyramid({0, 0, 4}, {1e5, 1e5, 1e5, 1e5}, 3);
  const auto changes = diagonal_changes(slings);
  ASSERT_TRUE(changes);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR((*changes)[0][i].norm(), 1e5, 1e-6);
}

// Upright slings have many such sets; lines that do not meet, and slings that hang slack, none.
TEST(StructureSkew, OtherArrangementsHaveNone) {
  auto slings = pyramid({0, 0, 4}, {1e5, 1e5, 1e5, 1e5}, 1.25);
  for (DiagonalSling& sling : slings) sling.force = {0, 0, 1e5};
  EXPECT_FALSE(diagonal_changes(slings));
  slings = pyramid({0, 0, 4}, {1e5, 1e5, 1e5, 1e5}, 1.25);
  slings[1].p_B += Vector3(0, 0.5, 0);
  EXPECT_FALSE(diagonal_changes(slings));
  slings = pyramid({0, 0, 4}, {1e5, 0, 1e5, 0}, 1.25);
  EXPECT_FALSE(diagonal_changes(slings));
}

}  // namespace
}  // namespace blocklift::pipeline
