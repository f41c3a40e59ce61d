// A cylinder whose bottom is near that of the sea, by panels and by matched eigenfunctions.
#include "tests/dynamics/marine/green/shallow_cylinder.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "dynamics/marine/green/hull_equations.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/incident_wave.h"
#include "tests/dynamics/marine/green/truncated_cylinder.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
constexpr double g = 9.80665;

// In water ten draughts deep waves of 3 rad/s are 7 m long and feel no bottom.
TEST(ShallowCylinder, IsYeungsInDeepWater) {
  const test::CylinderForces& row = test::truncated_cylinder[2];
  const test::ShallowCylinder cylinder(1.0, 0.5, 5.0, g);
  const Complex surge_force = cylinder.surge(row.w), heave_force = cylinder.heave(row.w);
  EXPECT_NEAR(surge_force.real(), row.surge_A, 0.006 * row.surge_A);
  EXPECT_NEAR(-row.w * surge_force.imag(), row.surge_B, 0.006 * row.surge_B);
  EXPECT_NEAR(heave_force.real(), row.heave_A, 0.006 * row.heave_A);
  EXPECT_NEAR(-row.w * heave_force.imag(), row.heave_B, 0.006 * row.heave_B);
}

/// Radius 1 m, draught 0.5 m; 144 panels on a quarter, as in deep water.
PanelModel make_cylinder(double depth) {
  SurfaceMesh none;
  none.mesh.symmetry = {true, true};
  return {
      {{"cylinder",
        make_vertical_cylinder(
            1.0, 0.5, true, {.meridians = 32, .parallels = 8, .grading = 5.0, .graded_edge = true}),
        Vector3::Zero()}},
      none,
      {1.0, g, depth},
      {true, true}};
}

// Panels are as good as over deep water, while as much water is under the bottom as the cylinder
// draws. The force of waves follows from the damping of a round body (Haskind; Newman 1962):
// B = k X^2/(4 rho g c_g) in heave, half of that in surge.
TEST(ShallowCylinder, PanelsAgree) {
  constexpr double depth = 1.0, allowed = 0.02;
  const PanelModel model = make_cylinder(depth);
  const HullEquations equations(model, {});
  const test::ShallowCylinder cylinder(1.0, 0.5, depth, g);
  for (const double w : {1.5, 2.5, 3.5}) {
    const auto parts = equations.solve(w);
    const Eigen::MatrixXcd force = equations.calc_radiation(parts, w);
    Eigen::VectorXcd waves = equations.calc_diffraction(parts, w, {0.0}).col(0);
    const IncidentWave wave(model.water(), w, 0.0);
    for (const HullEquations::Part& part : parts) {
      const Eigen::VectorXcd potential = model.part_of(
          part.parity, [&](const Vector3& p, const Vector3&) { return wave.potential(p); });
      const Eigen::MatrixXd weighted = model.body_areas().asDiagonal() * part.normal_velocities;
      waves(part.modes) += Complex(0.0, 4.0 * w) * (weighted.transpose() * potential);
    }
    const double k = cylinder.wave_number(w);
    EXPECT_NEAR(k, calc_wave_number(w, model.water()), 1e-9 * k);
    for (const int mode : {surge, heave}) {
      const Complex exact =
          Complex(0.0, w) * (mode == surge ? cylinder.surge(w) : cylinder.heave(w));
      EXPECT_LT(std::abs(force(mode, mode) - exact), allowed * std::abs(exact)) << mode << ' ' << w;
      const double share = mode == surge ? 8.0 : 4.0;
      const double excited =
          std::sqrt(share * g * calc_group_velocity(w, model.water()) * exact.real() / k);
      EXPECT_NEAR(std::abs(waves[mode]), excited, allowed * excited) << mode << ' ' << w;
    }
  }
}

}  // namespace
}  // namespace blocklift::dynamics
