#include "dynamics/marine/green/hull_database.h"

#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/green/hull_equations.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/floating_motion.h"
#include "dynamics/marine/radiation/mean_drift.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"
#include "tests/dynamics/marine/green/truncated_cylinder.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

constexpr double deep = std::numeric_limits<double>::infinity();
constexpr double gravity_here = 9.80665;

PanelModel make_round_model(PanelMesh hull, double depth) {
  const Symmetry symmetry{true, true};
  SurfaceMesh none;
  none.mesh.symmetry = symmetry;
  return {
      {{"round", std::move(hull), Vector3::Zero()}}, none, {1.0, gravity_here, depth}, symmetry};
}

PanelModel make_unit_hemisphere(double depth, int meridians) {
  return make_round_model(
      make_half_ellipsoid({1, 1, 1}, {.meridians = meridians, .parallels = meridians / 4}), depth);
}

DatabaseSettings round_settings() {
  DatabaseSettings settings;
  settings.frequencies = {1.0, 2.0, 3.0, 4.0, 5.0};
  settings.headings = {0.0, 0.5};
  return settings;
}

// What the retardation functions say of frequencies that were not asked for is what is solved
// there, and beyond all of them they never give energy back: what a pole just outside the band
// would do.
TEST(HullDatabase, RetardationFunctionsGiveEachFrequency) {
  for (const auto& [depth, meridians] : {std::pair{deep, 24}, {deep, 48}, {2.5, 24}}) {
    const PanelModel model = make_unit_hemisphere(depth, meridians);
    HullDatabaseReport report;
    const HydrodynamicDatabase database = compute_hull_database(model, round_settings(), &report);
    EXPECT_NO_THROW(require_sound(database));
    EXPECT_LT(report.frequencies.size(), 30U);
    EXPECT_LT(report.memory_error, 0.01);
    EXPECT_NEAR(calc_memory_error(database), report.memory_error, 0.005);
    const HullEquations equations(model, {});
    MatrixXd mass, damping;
    for (const double w : {0.8, 1.5, 2.5, 3.7, 4.9}) {
      calc_added_mass_and_damping(database, w, mass, damping);
      const Eigen::MatrixXcd force = equations.calc_radiation(equations.solve(w), w);
      for (const int mode : {surge, heave}) {
        const Complex by_memory(damping(mode, mode), w * mass(mode, mode));
        EXPECT_LT(std::abs(by_memory - force(mode, mode)), 0.01 * std::abs(force(mode, mode)))
            << depth << " m, " << w << " rad/s, mode " << mode;
      }
    }
    for (const int mode : {surge, heave}) {
      double peak = 0.0;
      for (const MatrixXd& B : database.damping) peak = std::max(peak, B(mode, mode));
      for (double w = 5.0; w < 30.0; w += 0.5) {
        calc_added_mass_and_damping(database, w, mass, damping);
        EXPECT_GT(damping(mode, mode), -2e-3 * peak) << w << " rad/s, mode " << mode;
      }
    }
  }
}

// Through the retardation functions, so that panels (1.3 %) and memory are both in it.
TEST(HullDatabase, TruncatedCylinderThroughItsMemory) {
  const PanelModel model = make_round_model(
      make_vertical_cylinder(
          1.0, 0.5, true, {.meridians = 32, .parallels = 8, .grading = 5.0, .graded_edge = true}),
      deep);
  const HydrodynamicDatabase database = compute_hull_database(model, round_settings());
  for (const test::CylinderForces& row : test::truncated_cylinder) {
    MatrixXd A, B;
    calc_added_mass_and_damping(database, row.w, A, B);
    const Complex surge_exact(row.surge_B, row.w * row.surge_A);
    const Complex heave_exact(row.heave_B, row.w * row.heave_A);
    const Complex by_surge(B(surge, surge), row.w * A(surge, surge));
    const Complex by_heave(B(heave, heave), row.w * A(heave, heave));
    EXPECT_LT(std::abs(by_surge / surge_exact - 1.0), 0.025) << row.w;
    EXPECT_LT(std::abs(by_heave / heave_exact - 1.0), 0.025) << row.w;
  }
}

// IEA OES Task 10 (Wendt et al. 2019): extrema of a sphere that is let go a metre up, by Cummins'
// equation, against linear theory exactly (multipole expansion).
TEST(HullDatabase, FreeDecayOfASphere) {
  constexpr std::array<double, 4> exact = {-.8670, .6347, -.4645, .3462};
  SurfaceMesh none;
  none.mesh.symmetry = {true, true};
  const PanelModel model(
      {{"sphere", make_half_ellipsoid({5, 5, 5}, {.meridians = 40, .parallels = 14}), {0, 0, -2}}},
      none, {1000.0, 9.81}, {true, true});
  LinearFloatation sphere;
  sphere.mass = MatrixXd::Zero(6, 6);
  sphere.mass.diagonal() << 261.8e3, 261.8e3, 261.8e3, 1.690e6, 1.690e6, 2.606e6;
  sphere.stiffness = MatrixXd::Zero(6, 6);
  sphere.stiffness(heave, heave) = 7.695e5;
  sphere.start = Eigen::VectorXd::Zero(6);
  sphere.start[heave] = 1.0;
  DatabaseSettings settings;
  settings.frequencies = {0.5, 1.0, 1.5, 2.0, 2.5};
  const HydrodynamicDatabase database = compute_hull_database(model, settings);
  const std::vector<Extremum> found =
      find_extrema(march_with_database(sphere, database, 0.05, 10.0), heave);
  ASSERT_GE(found.size(), exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k) EXPECT_NEAR(found[k].value, exact[k], 1.5e-3) << k;
}

// A body that is held takes no energy out of waves: what is scattered is missing behind it, but for
// the panels' error, at 5 rad/s a twelfth of a wave across.
TEST(HullDatabase, FarFieldKeepsTheEnergyOfWaves) {
  const PanelModel model = make_unit_hemisphere(deep, 32);
  DatabaseSettings settings = round_settings();
  settings.with_coarser = true;
  settings.with_far_field = true;
  const HydrodynamicDatabase database = compute_hull_database(model, settings);
  const auto absorbed = calc_absorbed_power(database, {});
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double w = database.frequencies[k];
    // rho g c_g/2 over the diameter.
    const double met = gravity_here * 0.5 * (0.5 * gravity_here / w) * 2.0;
    EXPECT_LT(absorbed[k].cwiseAbs().maxCoeff(), 0.02 * met) << w;
  }
  for (const int mode : {surge, sway, heave}) {
    EXPECT_GT(database.change_from_coarser[mode], 1e-3);
    EXPECT_LT(database.change_from_coarser[mode], 0.15);
  }
}

TEST(HullDatabase, WhatCannotBeComputedIsRefused) {
  const PanelModel model = make_unit_hemisphere(deep, 24);
  DatabaseSettings settings = round_settings();
  settings.frequencies = {2.0, 1.0};
  EXPECT_THROW(compute_hull_database(model, settings), ModelError);
  settings.frequencies = {2.0, 60.0};
  EXPECT_THROW(compute_hull_database(model, settings), ModelError);
  settings.frequencies = {};
  EXPECT_THROW(compute_hull_database(model, settings), ModelError);
  // A memory that is cut off does not give the forces that were solved.
  settings = round_settings();
  settings.duration = 0.5;
  EXPECT_THAT([&] { compute_hull_database(model, settings); },
              ::testing::ThrowsMessage<ModelError>(::testing::AllOf(
                  ::testing::HasSubstr("retardation functions miss the waves' forces by"),
                  ::testing::HasSubstr("10 % is allowed"),
                  ::testing::HasSubstr("take a higher highest_frequency"),
                  ::testing::HasSubstr("leave out method: green function"))));
}

}  // namespace
}  // namespace blocklift::dynamics
