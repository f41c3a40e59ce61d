#include "dynamics/marine/green/hull_equations.h"

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/panels/rankine_problem.h"
#include "dynamics/marine/radiation/incident_wave.h"
#include "tests/dynamics/marine/green/truncated_cylinder.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double standard_gravity = 9.80665;

PanelModel make_model(std::vector<WettedBody> bodies, const Water& water,
                      const Symmetry& symmetry) {
  SurfaceMesh none;
  none.mesh.symmetry = symmetry;
  return {std::move(bodies), none, water, symmetry};
}

PanelMesh cylinder_of(int meridians) {
  return make_vertical_cylinder(
      1.0, 0.5, true,
      {.meridians = meridians, .parallels = meridians / 4, .grading = 5.0, .graded_edge = true});
}

Eigen::MatrixXcd froude_krylov(const PanelModel& model,
                               const std::vector<HullEquations::Part>& parts, double w,
                               double heading) {
  const IncidentWave wave(model.water(), w, heading);
  Eigen::MatrixXcd force = Eigen::MatrixXcd::Zero(model.mode_count(), 1);
  for (const HullEquations::Part& part : parts) {
    const Eigen::VectorXcd potential = model.part_of(
        part.parity, [&](const Vector3& p, const Vector3&) { return wave.potential(p); });
    const Eigen::MatrixXd weighted = model.body_areas().asDiagonal() * part.normal_velocities;
    force(part.modes, 0) += Complex(0, w * model.water().density * model.symmetry().image_count()) *
                            (weighted.transpose() * potential);
  }
  return force;
}

/// B + i w A of one mode on itself.
Complex force_of(const PanelModel& model, const HullEquations::Settings& settings, double w,
                 int mode) {
  const HullEquations equations(model, settings);
  return equations.calc_radiation(equations.solve(w), w)(mode, mode);
}

// 144 panels on a quarter of the hull are off by 1.3 % in surge, 36 by 4.3 %: the edge keeps the
// order below 2.
TEST(HullEquations, TruncatedCylinder) {
  const PanelModel model = make_model({{"cylinder", cylinder_of(32), Vector3::Zero()}},
                                      {1.0, standard_gravity}, {true, true});
  const HullEquations equations(model, {});
  for (const test::CylinderForces& row : test::truncated_cylinder) {
    const Eigen::MatrixXcd force = equations.calc_radiation(equations.solve(row.w), row.w);
    const Complex surge_exact(row.surge_B, row.w * row.surge_A);
    const Complex heave_exact(row.heave_B, row.w * row.heave_A);
    EXPECT_LT(std::abs(force(surge, surge) - surge_exact) / std::abs(surge_exact), 0.015) << row.w;
    EXPECT_LT(std::abs(force(heave, heave) - heave_exact) / std::abs(heave_exact), 0.015) << row.w;
    EXPECT_NEAR(force(surge, surge).real() / row.surge_B, 1.0, 0.02) << row.w;
    EXPECT_NEAR(force(heave, heave).real() / row.heave_B, 1.0, 0.02) << row.w;
    EXPECT_LT(std::abs(force(surge, pitch) - force(pitch, surge)), 0.01 * std::abs(surge_exact));
  }
}

// A sphere of radius 1 m wholly under water, its middle 1.8 m deep, by a series of multipoles
// (Thorne 1953; 6, 10 and 14 of them agree to 2e-6), for water of 1 kg/m3. In water without a
// surface 512 panels of such a sphere are 0.6 % off.
TEST(HullEquations, SphereUnderWater) {
  struct Row {
    double w, surge_A, surge_B, heave_A, heave_B;
  };
  constexpr std::array<Row, 3> exact = {{{2.0, 2.249586, 0.327061, 2.404865, 0.690586},
                                         {3.0, 2.014939, 0.830292, 1.908998, 1.621323},
                                         {4.0, 1.892707, 0.431492, 1.699605, 0.791398}}};
  const PanelModel model = make_model(
      {{"sphere", make_ellipsoid({1, 1, 1}, {0, 0, -1.8}, {.meridians = 32, .parallels = 8}),
        Vector3(0, 0, -1.8)}},
      {1.0, standard_gravity}, {true, true});
  const HullEquations equations(model, {});
  for (const Row& row : exact) {
    const Eigen::MatrixXcd force = equations.calc_radiation(equations.solve(row.w), row.w);
    const Complex surge_exact(row.surge_B, row.w * row.surge_A);
    const Complex heave_exact(row.heave_B, row.w * row.heave_A);
    EXPECT_LT(std::abs(force(surge, surge) - surge_exact), 0.02 * std::abs(surge_exact)) << row.w;
    EXPECT_LT(std::abs(force(heave, heave) - heave_exact), 0.02 * std::abs(heave_exact)) << row.w;
  }
  const Eigen::MatrixXcd impulse = equations.calc_radiation(equations.solve(infinite), infinite);
  EXPECT_NEAR(impulse(surge, surge).real(), 2.028034, 0.02 * 2.028034);
  EXPECT_NEAR(impulse(heave, heave).real(), 1.963298, 0.02 * 1.963298);
}

// Whole, halved and quartered: the same flow, with panels and cells in other places of the matrix.
TEST(HullEquations, SymmetryChangesNothing) {
  const Water water{1000.0, standard_gravity, 8.0};
  const PanelMesh box = make_box_hull(8, 4, 2, {.length = 8, .breadth = 4, .draught = 2});
  const double w = 1.7;
  std::vector<Eigen::MatrixXcd> forces, waves;
  for (const Symmetry& symmetry : {Symmetry{}, Symmetry{false, true}, Symmetry{true, true}}) {
    const PanelModel model = make_model({{"box", box, {0, 0, -0.5}}}, water, symmetry);
    const HullEquations equations(model, {.lids = {{{-6, -3}, {6, 3}, 0.2}}, .cell_size = 1.0});
    const auto parts = equations.solve(w);
    forces.push_back(equations.calc_radiation(parts, w));
    waves.push_back(equations.calc_diffraction(parts, w, {0.4}));
  }
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_LT((forces[k] - forces[0]).norm(), 1e-9 * forces[0].norm());
    EXPECT_LT((waves[k] - waves[0]).norm(), 1e-9 * waves[0].norm());
  }
}

// Water within the cylinder would swing at K = j/a coth(j d/a), j = 2.405: 5.32 rad/s. There the
// equations without cells have no solution.
TEST(HullEquations, WaterWithinTheHullDoesNotSwing) {
  const PanelModel model = make_model({{"cylinder", cylinder_of(24), Vector3::Zero()}},
                                      {1.0, standard_gravity}, {true, true});
  const double j = 2.404826, swing = std::sqrt(standard_gravity * j / std::tanh(0.5 * j));
  const auto added_mass = [&](double w, bool cover) {
    return force_of(model, {.cover_water_planes = cover}, w, heave).imag() / w;
  };
  double worst = 0.0, worst_bare = 0.0;
  for (const double share : {0.98, 0.99, 1.0, 1.01, 1.02}) {
    const double w = share * swing;
    const double even = 0.5 * (added_mass(0.93 * swing, true) + added_mass(1.07 * swing, true));
    worst = std::max(worst, std::abs(added_mass(w, true) / even - 1.0));
    worst_bare = std::max(worst_bare, std::abs(added_mass(w, false) / even - 1.0));
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_GT(worst_bare, 0.1);
}

// The flow within the hull is nothing but for the panels' error: cells of twice the panels' size
// give what cells of their size give, at all frequencies that three panels suffice for.
TEST(HullEquations, CoarseCoversAreAsGood) {
  const PanelModel model = make_model({{"cylinder", cylinder_of(24), Vector3::Zero()}},
                                      {1.0, standard_gravity}, {true, true});
  const double size = std::sqrt(model.body_areas().mean());
  const HullEquations coarse(model, {}), fine(model, {.cover_size = size});
  EXPECT_LT(coarse.cell_count(), 0.45 * fine.cell_count());
  double worst = 0.0;
  for (double w = 1.0; w < 7.6; w += 0.25) {
    const Eigen::MatrixXcd a = coarse.calc_radiation(coarse.solve(w), w);
    const Eigen::MatrixXcd b = fine.calc_radiation(fine.solve(w), w);
    for (const int mode : {surge, heave, pitch}) {
      worst = std::max(worst, std::abs(a(mode, mode) - b(mode, mode)) / std::abs(b(mode, mode)));
    }
  }
  EXPECT_LT(worst, 0.005);
}

// The scattered waves' own pressure is what Haskind's relation says, to the panels' error, and
// clusters of panels give nearly the same flow as panels.
TEST(HullEquations, ScatteringAndClustersAgreeWithTheModes) {
  const PanelModel model = make_model({{"cylinder", cylinder_of(24), Vector3::Zero()}},
                                      {1.0, standard_gravity}, {true, true});
  const HullEquations equations(model, {});
  const double w = 2.0;
  const auto parts = equations.solve(w, {.headings = {0.4}, .coarser = true});
  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(6);
  for (const HullEquations::Part& part : parts) {
    const Eigen::MatrixXd weighted = model.body_areas().asDiagonal() * part.normal_velocities;
    force(part.modes) += Complex(0, 4.0 * w) * (weighted.transpose() * part.scattered);
  }
  const Eigen::MatrixXcd haskind = equations.calc_diffraction(parts, w, {0.4});
  EXPECT_LT((force - haskind.col(0)).norm(), 0.01 * haskind.norm());
  const Eigen::MatrixXcd modes = equations.calc_radiation(parts, w);
  const Eigen::MatrixXcd coarser = equations.calc_coarser_radiation(parts, w);
  for (const int mode : {surge, heave}) {
    const double change = std::abs(coarser(mode, mode) / modes(mode, mode) - 1.0);
    EXPECT_GT(change, 1e-3) << mode;
    EXPECT_LT(change, 0.1) << mode;
  }
}

// At infinite frequency the clusters' flow is that of the other method, whose matrices of the hull
// are the same in deep water: second method.
TEST(HullEquations, ClustersAgreeWithTheMarchAtInfiniteFrequency) {
  const PanelModel model = make_model({{"cylinder", cylinder_of(24), Vector3::Zero()}},
                                      {1.0, standard_gravity}, {true, true});
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const HullEquations equations(model, {});
  const Eigen::MatrixXcd coarser =
      equations.calc_coarser_radiation(equations.solve(infinite, {.coarser = true}), infinite);
  RankineSettings settings;
  settings.coarser = std::make_shared<const CoarserPanels>(
      make_coarser_panels(model.body_mesh(), model.surface_mesh()));
  for (const Parity& parity : model.parities()) {
    const RankinePart part(model, parity, settings);
    const Eigen::MatrixXd& volume = part.coarser()->infinite_frequency_volume();
    for (Eigen::Index m = 0; m < volume.rows(); ++m) {
      const double mass = coarser(part.modes()[m], part.modes()[m]).real();
      EXPECT_NEAR(mass, volume(m, m), 1e-6 * volume.cwiseAbs().maxCoeff());
    }
  }
}

// A column that stands on the bottom: |F| = 4 rho g tanh(k h)/(k^2 |H1'(k a)|) (MacCamy and Fuchs
// 1954).
TEST(HullEquations, StandingCylinder) {
  const Water water{1000.0, standard_gravity, 4.0};
  const PanelModel model = make_model(
      {{"column",
        make_vertical_cylinder(1.0, 4.0, false, {.meridians = 32, .parallels = 10, .grading = 2.0}),
        Vector3::Zero()}},
      water, {true, true});
  const HullEquations equations(model, {});
  for (const double w : {0.5, 1.5, 3.0}) {
    const auto parts = equations.solve(w);
    const Complex force = equations.calc_diffraction(parts, w, {0.0})(surge, 0) +
                          froude_krylov(model, parts, w, 0.0)(surge, 0);
    const double k = calc_wave_number(w, water);
    const double J = ::j0(k) - ::j1(k) / k, Y = ::y0(k) - ::y1(k) / k;
    const double exact =
        4.0 * water.density * standard_gravity * std::tanh(4.0 * k) / (k * k * std::hypot(J, Y));
    EXPECT_NEAR(std::abs(force) / exact, 1.0, 0.01) << w;
  }
}

// What a round body's damping takes, its waves carry away: B = k X^2/(4 rho g c_g) in heave, half
// of it in surge along the waves (Newman 1962).
TEST(HullEquations, DampingIsWhatTheWavesCarry) {
  for (const double depth : {3.0, infinite}) {
    const Water water{1025.0, standard_gravity, depth};
    const PanelModel model =
        make_model({{"cylinder", cylinder_of(24), Vector3::Zero()}}, water, {true, true});
    const HullEquations equations(model, {});
    for (const double w : {0.8, 2.0, 4.0}) {
      const auto parts = equations.solve(w);
      const Eigen::MatrixXcd force = equations.calc_radiation(parts, w);
      const Eigen::MatrixXcd waves =
          equations.calc_diffraction(parts, w, {0.0}) + froude_krylov(model, parts, w, 0.0);
      const double carried = calc_wave_number(w, water) / (4.0 * water.density * standard_gravity *
                                                           calc_group_velocity(w, water));
      EXPECT_NEAR(force(heave, heave).real() / (carried * std::norm(waves(heave, 0))), 1.0, 0.02);
      EXPECT_NEAR(force(surge, surge).real() / (0.5 * carried * std::norm(waves(surge, 0))), 1.0,
                  0.02);
    }
  }
}

// A hemisphere's added mass without waves (Hulme 1982): 0.5 in heave, 0.2732 in surge, of 2/3 pi
// rho a^3. In high waves it comes to that.
TEST(HullEquations, AnImpulseIsTheLimit) {
  const PanelModel model =
      make_model({{"hemisphere", make_half_ellipsoid({1, 1, 1}, {.meridians = 32, .parallels = 8}),
                   Vector3::Zero()}},
                 {1.0, standard_gravity}, {true, true});
  const HullEquations equations(model, {});
  const double mass = 2.0 / 3.0 * std::numbers::pi;
  const Eigen::MatrixXcd impulse = equations.calc_radiation(equations.solve(infinite), infinite);
  EXPECT_NEAR(impulse(heave, heave).real() / mass, 0.5, 0.01);
  EXPECT_NEAR(impulse(surge, surge).real() / mass, 0.2732, 0.006);
  EXPECT_LT(impulse.imag().norm(), 1e-12);
  EXPECT_THROW(equations.solve(0.0), ModelError);
  EXPECT_THROW(HullEquations(model, {.memory_limit = 1e5}), SimulationError);
}

}  // namespace
}  // namespace blocklift::dynamics
