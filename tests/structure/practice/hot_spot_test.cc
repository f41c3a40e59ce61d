// Structural stress at weld toes.
#include "structure/practice/hot_spot.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace blocklift::structure {
namespace {

// A stress that is linear towards the toe is met exactly; Hobbacher (2016), section 2.2.3.4, has
// the factors as 1.67 and 0.67.
TEST(HotSpot, LinearStressIsExtrapolatedExactly) {
  const HotSpot spot{{1, 2, 3}, Vector3::UnitY(), 0.02};
  EXPECT_LT((spot.places()[0] - Vector3(1, 2.008, 3)).norm(), 1e-15);
  EXPECT_LT((spot.places()[1] - Vector3(1, 2.020, 3)).norm(), 1e-15);
  const auto stress_at = [&](const Vector3& p) {
    return Stress(Stress::Ones() * (200e6 - 3e9 * (p.y() - 2)));
  };
  const Stress toe = hot_spot_stress(stress_at(spot.places()[0]), stress_at(spot.places()[1]));
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(toe[c], 200e6, 1);
  const Stress rounded = 1.67 * stress_at(spot.places()[0]) - 0.67 * stress_at(spot.places()[1]);
  EXPECT_NEAR(rounded[0], toe[0], 0.0034 * 36e6);
}

TEST(HotSpot, PrincipalStressCountsWithinSixtyDegreesOfTheWeldsNormal) {
  const auto uniaxial = [](double angle) {  // 100 MPa at an angle to x
    const double c = std::cos(angle), s = std::sin(angle);
    Stress stress;
    stress << 100e6 * c * c, 100e6 * s * s, 0, 100e6 * c * s, 0, 0;
    return stress;
  };
  const double degree = std::numbers::pi / 180;
  for (const double angle : {0.0, 30.0, 59.0}) {
    const HotSpotStress found = evaluate_hot_spot(uniaxial(angle * degree), Vector3::UnitX());
    EXPECT_NEAR(found.governing, 100e6, 1);
    EXPECT_NEAR(found.angle, angle * degree, 1e-7);
  }
  const HotSpotStress along = evaluate_hot_spot(uniaxial(70 * degree), Vector3::UnitX());
  EXPECT_NEAR(along.governing, 100e6 * std::pow(std::cos(70 * degree), 2), 1);
  EXPECT_NEAR(along.principal, 100e6, 1);
  // Compression governs with its sign.
  EXPECT_NEAR(evaluate_hot_spot(-uniaxial(0), Vector3::UnitX()).governing, -100e6, 1);
}

}  // namespace
}  // namespace blocklift::structure
