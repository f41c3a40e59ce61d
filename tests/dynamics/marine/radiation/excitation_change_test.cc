// How far panels leave the force of waves off, beside what they leave of radiation.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/database_parts.h"

namespace blocklift::dynamics {
namespace {

// Of 3 + 4i and 2 heave has 5 at most; sway has a ten-thousandth of that, which is nothing.
TEST(ExcitationChange, IsTheLargestDifferenceOfTheLargestForce) {
  HydrodynamicDatabase database;
  database.body_names = {"box"};
  database.frequencies = {1.0, 2.0};
  database.headings = {0.0};
  database.froude_krylov.assign(2, Eigen::MatrixXcd::Zero(6, 1));
  database.diffraction = database.froude_krylov;
  database.froude_krylov[0](heave, 0) = 3.0;
  database.diffraction[0](heave, 0) = {0.0, 4.0};
  database.diffraction[1](heave, 0) = 2.0;
  database.diffraction[1](sway, 0) = 5e-4;
  database.diffraction[1](roll, 0) = {0.0, 0.1};
  CoarserForces coarser(6, 2, 1);
  coarser.diffraction = database.diffraction;
  coarser.diffraction[0](heave, 0) = {0.0, 3.5};
  coarser.diffraction[1](heave, 0) = {2.0, 1.0};
  coarser.diffraction[1](sway, 0) = 0.0;
  // Turned by a right angle alone: the phase counts.
  coarser.diffraction[1](roll, 0) = 0.1;
  const Eigen::VectorXd change = largest_excitation_change(database, coarser);
  ASSERT_EQ(change.size(), 6);
  EXPECT_NEAR(change[heave], 1.0 / 5.0, 1e-12);
  EXPECT_NEAR(change[roll], std::sqrt(2.0), 1e-12);
  EXPECT_EQ(change[sway], 0.0);
  EXPECT_EQ(change[surge], 0.0);
  coarser.diffraction[0].setConstant(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isinf(largest_excitation_change(database, coarser)[heave]));
  database.headings.clear();
  EXPECT_EQ(largest_excitation_change(database, coarser).size(), 0);
}

/// A box of 20 x 10 m that draws 3 m, and turns about the water line.
HydrodynamicDatabase compute_box(const BoxDivision& division) {
  const Water water{1000.0, 9.80665};
  const std::vector<WettedBody> bodies{
      {"box", make_box_hull(20.0, 10.0, 3.0, division), Vector3::Zero()}};
  DatabaseSettings settings;
  settings.frequencies = {0.6, 0.8, 1.0, 1.2, 1.4};
  settings.headings = {0.0, std::numbers::pi / 6.0, std::numbers::pi / 3.0, std::numbers::pi / 2.0};
  settings.with_coarser = true;
  const auto length = [&](double w) { return 2.0 * std::numbers::pi / calc_wave_number(w, water); };
  const auto lines = find_water_lines(bodies);
  const SurfaceMesh surface =
      make_surface_mesh(lines, surface_settings(lines, length(1.4), length(0.6)));
  return compute_database({bodies, surface, water, {true, true}}, settings);
}

// The moment of waves about the long axis is the small rest of what they do to bottom and sides:
// panels of 2 m miss half of it where the radiation force on roll is known to a tenth.
TEST(ExcitationChange, TellsOfRoll) {
  const HydrodynamicDatabase coarse =
      compute_box({.length = 10, .breadth = 6, .draught = 2, .grading = 1.0});
  const HydrodynamicDatabase fine =
      compute_box({.length = 20, .breadth = 12, .draught = 4, .grading = 1.0});
  const Eigen::VectorXd& change = coarse.excitation_change_from_coarser;
  ASSERT_EQ(change.size(), 6);
  for (int mode = 0; mode < modes_per_body; ++mode) {
    double error = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < coarse.frequencies.size(); ++k) {
      const Eigen::RowVectorXcd X = coarse.excitation(k).row(mode);
      error = std::max(error, (X - fine.excitation(k).row(mode)).cwiseAbs().maxCoeff());
      largest = std::max(largest, X.cwiseAbs().maxCoeff());
    }
    std::printf("mode %d: error %.3f, estimated %.3f\n", mode, error / largest, change[mode]);
    EXPECT_GT(change[mode], error / largest) << mode;
    if (mode != roll) continue;
    EXPECT_GT(error / largest, 0.2);
    EXPECT_GT(change[roll], 0.2);
  }
  EXPECT_LT(coarse.change_from_coarser[roll], change[roll]);
}

}  // namespace
}  // namespace blocklift::dynamics
