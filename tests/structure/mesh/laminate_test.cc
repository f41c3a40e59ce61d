// Layered plates against closed forms.

#include "structure/mesh/laminate.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace blocklift::structure {
namespace {

const Material steel{"steel", 206e9, 0.3, 7850, 0};
const Material foam{"foam", 0.1e9, 0.3, 60, 0};

TEST(Laminate, OneLayerIsAPlate) {
  const double t = 0.02;
  const Laminate plate = stack({{isotropic_ply(steel), t, 0.7}});
  const double a = steel.youngs_modulus * t / (1 - 0.09);
  EXPECT_NEAR(plate.membrane(0, 0), a, 1e-9 * a);
  EXPECT_NEAR(plate.membrane(0, 1), 0.3 * a, 1e-9 * a);
  EXPECT_NEAR(plate.bending(1, 1), a * t * t / 12, 1e-9 * a * t * t);
  EXPECT_NEAR(plate.shear(0, 0), 5.0 / 6 * steel.shear_modulus() * t, 1e-6);
  EXPECT_NEAR(plate.shear(0, 1), 0, 1e-9);
  const NearestPlate nearest = nearest_plate(plate, t);
  EXPECT_TRUE(nearest.is_exact());
  EXPECT_NEAR(nearest.youngs_modulus, steel.youngs_modulus, 1);
  EXPECT_NEAR(nearest.poisson_ratio, 0.3, 1e-9);
}

TEST(Laminate, LayersOfOneMaterialAreOnePlate) {
  const Laminate plate =
      stack({{isotropic_ply(steel), 0.004, 0}, {isotropic_ply(steel), 0.006, 1}});
  EXPECT_TRUE(nearest_plate(plate, 0.01).is_exact());
  EXPECT_LT(plate.coupling.norm(), 1e-9 * plate.membrane.norm() * 0.01);
}

// Sandwich: D = E_f ((h + c)^3 - c^3...) / 12 with h the whole height, and across the plate the
// core's G (c + f)^2 / c as faces get thin (Allen 1969, equation 2.16).
TEST(Laminate, Sandwich) {
  const double face = 0.001, core = 0.05, whole = core + 2 * face;
  const Laminate plate = stack({{isotropic_ply(steel), face, 0},
                                {isotropic_ply(foam), core, 0},
                                {isotropic_ply(steel), face, 0}});
  const double of_faces =
      (std::pow(whole, 3) - std::pow(core, 3)) / 12 * steel.youngs_modulus / 0.91;
  const double of_core = std::pow(core, 3) / 12 * foam.youngs_modulus / 0.91;
  EXPECT_NEAR(plate.bending(0, 0), of_faces + of_core, 1e-9 * of_faces);
  EXPECT_NEAR(plate.membrane(0, 0),
              (2 * face * steel.youngs_modulus + core * foam.youngs_modulus) / 0.91, 1.0);
  const double across = foam.shear_modulus() * std::pow(core + face, 2) / core;
  EXPECT_NEAR(plate.shear(0, 0), across, 0.01 * across);
  EXPECT_FALSE(nearest_plate(plate, whole).is_exact());
  EXPECT_LT(nearest_plate(plate, whole).membrane_error, 1e-9);
}

// Two layers: B_11 = (E_2 - E_1) / (1 - nu^2) t^2 / 2 of equal heights t.
TEST(Laminate, TwoMaterialsCoupleStretchingAndBending) {
  Material other = steel;
  other.youngs_modulus = 70e9;
  const Laminate plate = stack({{isotropic_ply(steel), 0.01, 0}, {isotropic_ply(other), 0.01, 0}});
  EXPECT_NEAR(plate.coupling(0, 0), (70e9 - 206e9) / 0.91 * 1e-4 / 2, 1);
  EXPECT_GT(nearest_plate(plate, 0.02).coupling_error, 0.1);
}

// Jones (1999), equation 2.97: E_x of a layer at an angle.
TEST(Laminate, LayerAtAnAngle) {
  const double e1 = 140e9, e2 = 10e9, nu = 0.3, g = 5e9, angle = 0.6;
  const Eigen::Matrix3d q = orthotropic_ply(e1, e2, nu, g, g, g, 0).in_plane;
  const double c = std::cos(angle), s = std::sin(angle);
  const double compliance =
      std::pow(c, 4) / e1 + (1 / g - 2 * nu / e1) * c * c * s * s + std::pow(s, 4) / e2;
  EXPECT_NEAR(turned(q, angle).inverse()(0, 0), compliance, 1e-9 * compliance);
}

// Layers at 0, 45, -45, 90 degrees: the same in all directions (Tsai and Pagano 1968).
TEST(Laminate, QuasiIsotropicMembrane) {
  const PlyMaterial ply = orthotropic_ply(140e9, 10e9, 0.3, 5e9, 5e9, 4e9, 1600);
  const double quarter = std::numbers::pi / 4;
  std::vector<Ply> plies;
  for (const double angle : {0.0, quarter, -quarter, 2 * quarter})
    plies.push_back({ply, 1e-3, angle});
  for (std::size_t i = 4; i-- > 0;) plies.push_back(plies[i]);
  const NearestPlate nearest = nearest_plate(stack(plies), 8e-3);
  EXPECT_LT(nearest.membrane_error, 1e-9);
  EXPECT_LT(nearest.coupling_error, 1e-9);
  EXPECT_GT(nearest.bending_error, 0.1);
}

}  // namespace
}  // namespace blocklift::structure
