// Nonlinear hydrostatics beyond what `blocklift verify` computes.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/hull/floating_position.h"
#include "dynamics/marine/hull/hull_shapes.h"

namespace blocklift::dynamics {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Free to trim: a ship with a transom trims as it heels, and no moment about the level transverse
// axis is left. The arms are the derivative of the least energy: GZ = dE/dphi / (W cos(trim)).
TEST(RightingArms, AreTheSlopeOfTheEnergyWhenFreeToTrim) {
  const HullClusters ship(make_ship({.length = 100,
                                     .breadth = 18,
                                     .depth = 10,
                                     .draught = 6,
                                     .bow_length = 40,
                                     .stern_length = 30,
                                     .transom_breadth = 12},
                                    {20, 6, 4, 4}));
  const FloatingBody body = {.mass = 5e6, .p_BoBcm_B = {-1, 0, 6}};
  const double volume = body.mass / body.water_density;
  const auto energy = [&](const RightingArm& arm) {
    const Matrix3 R =
        rotation_about(Vector3::UnitY(), arm.trim) * rotation_about(Vector3::UnitX(), arm.heel);
    return calc_buoyancy(ship, {R, {0, 0, arm.height}}).energy_over_rho_g +
           volume * (arm.height + (R * body.p_BoBcm_B).z());
  };
  double largest_trim_change = 0, first_trim = 0;
  for (int i = 1; i < 18; ++i) {
    const double heel = 10 * i * degree, step = 1e-4;
    const auto arms = calc_righting_arms(ship, body, {heel - step, heel, heel + step});
    const double slope = (energy(arms[2]) - energy(arms[0])) / (2 * step);
    EXPECT_NEAR(arms[1].GZ, slope / (volume * std::cos(arms[1].trim)), 1e-5) << i;
    if (i == 1) first_trim = arms[1].trim;
    largest_trim_change = std::max(largest_trim_change, std::abs(arms[1].trim - first_trim));
  }
  EXPECT_GT(largest_trim_change, 0.5 * degree);
}

}  // namespace
}  // namespace blocklift::dynamics
