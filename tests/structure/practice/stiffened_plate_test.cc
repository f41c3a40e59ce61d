// A stiffener with its plate as a column.
#include "structure/practice/stiffened_plate.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/structure/practice/sample_steel.h"

namespace blocklift::structure {
namespace {

using test::steel_s355;

// EN 1993-1-5, table 4.1 and 4.4(2): lambda = (b / t) / (28.4 epsilon sqrt(4)), epsilon =
// sqrt(235 / f_y); b / t = 42 epsilon of internal parts in class 3 comes out whole. The norm's 28.4
// is rounded.
TEST(StiffenedPlate, TheEffectiveWidthIsThatOfTheNorm) {
  const double epsilon = std::sqrt(235.0 / 355);
  EXPECT_EQ(effective_width_share(steel_s355, 0.01, 0.01 * 38 * epsilon), 1);
  for (const double ratio : {50.0, 80.0, 120.0}) {
    const double lambda = ratio / (28.4 * epsilon * 2);
    EXPECT_NEAR(effective_width_share(steel_s355, 0.01, 0.01 * ratio),
                (lambda - 0.22) / (lambda * lambda), 2e-3)
        << ratio;
  }
}

// Flat bar 200 x 12 under a plate 800 x 10, span 2.4 m, by hand: gross area 104 cm^2, centroid
// 24.23 mm below the middle of the plate.
TEST(StiffenedPlate, AFlatBarUnderAPlateByHand) {
  const double web = 0.2 * 0.012, plate = 0.8 * 0.01;
  const StiffenerSection bar{web, -0.105, 0.012 * std::pow(0.2, 3) / 12, -0.205, -0.005};
  const std::array<PlateStrip, 2> plates{{{0.4, 0.01, 0}, {0.4, 0.01, 0}}};
  const Column column = stiffener_column(steel_s355, bar, plates, 2.4);
  const double area = web + plate, z = web * 0.105 / area;
  const double second_moment =
      bar.second_moment + web * std::pow(0.105 - z, 2) + 0.8 * 1e-6 / 12 + plate * z * z;
  EXPECT_NEAR(column.area, 0.0104, 1e-12);
  EXPECT_NEAR(column.second_moments[0], second_moment, 1e-12);
  const double share = effective_width_share(steel_s355, 0.01, 0.8);
  EXPECT_LT(share, 0.7);
  EXPECT_NEAR(column.effective_area, web + share * plate, 1e-12);
  // e is that of the stiffener, farther from the common centroid than the plate.
  EXPECT_NEAR(column.imperfection, 0.49 + 0.09 * (0.105 - z) / std::sqrt(second_moment / area),
              1e-12);
  const double reduced_z = web * 0.105 / column.effective_area;
  const double reduced = bar.second_moment + web * std::pow(0.105 - reduced_z, 2) +
                         share * 0.8 * 1e-6 / 12 + share * plate * reduced_z * reduced_z;
  EXPECT_NEAR(column.section_moduli[0], reduced / (0.205 - reduced_z), 1e-12);
  // Resistance: chi A_eff f_y with lambda^2 = beta_A f_y / sigma_cr.
  const double critical =
      std::numbers::pi * std::numbers::pi * 210e9 * second_moment / (area * 2.4 * 2.4);
  const double slenderness = std::sqrt(column.effective_area / area * 355e6 / critical);
  EXPECT_NEAR(buckling_resistance(column),
              buckling_reduction(slenderness, column.imperfection) * column.effective_area * 355e6,
              1);
  // The plate holds it sideways.
  EXPECT_DOUBLE_EQ(column_utilisation(column, {1e5, {0, 0}}, 1), 1e5 / buckling_resistance(column));
}

// A slab of plate alone bends as one of twice the half's width.
TEST(StiffenedPlate, SectionsJoinAsSteiner) {
  const StiffenedSection both =
      join_sections({0, 0, 0, 0, 0}, {{{0.5, 0.02, 0.1}, {0.5, 0.02, 0.1}}});
  EXPECT_NEAR(both.height, 0.1, 1e-15);
  EXPECT_NEAR(both.second_moment, std::pow(0.02, 3) / 12, 1e-18);
}

}  // namespace
}  // namespace blocklift::structure
