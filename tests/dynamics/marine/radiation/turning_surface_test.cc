// The water's surface marched beside a barge off the origin that is carried along and turned: the
// waves it meets, and their force.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/simulation/marched_surface.h"

namespace blocklift::dynamics {
namespace {

constexpr double degree = std::numbers::pi / 180;
const Water water{1025.0, 9.81};

/// A box of 20 x 8 x 2 m, its middle off the origin, and a surface that is wide enough for its
/// waves.
PanelModel barge_off_the_origin() {
  const Vector3 middle(3, -2, 0);
  std::vector<WettedBody> bodies{
      {"barge", translate(make_box_hull(20, 8, 2, {10, 4, 1, 1.0}), middle), middle}};
  const SurfaceMesh surface = make_surface_mesh(
      find_water_lines(bodies), {.first_ring = 2.0, .growth = 1.25, .radius = 70.0});
  return PanelModel(std::move(bodies), surface, water);
}

DirectRadiation meeting(const PanelModel& model, const RegularWave& wave,
                        const Eigen::Vector2d& origin = Eigen::Vector2d::Zero()) {
  DirectRadiation::Settings settings;
  settings.damping_strength = 0.6;
  settings.waves = {wave};
  settings.ramp = WaveRamp{0.0, 4.0};
  settings.origin = origin;
  return DirectRadiation(model, settings);
}

/// The wave as it is seen by someone at `place` (m) who is turned by `turn` (rad).
RegularWave seen_from(const Eigen::Vector2d& place, double turn, RegularWave wave) {
  const double k = calc_wave_number(wave.frequency, water);
  const Eigen::Vector2d ahead(std::cos(wave.heading), std::sin(wave.heading));
  wave.amplitude *= std::polar(1.0, -k * ahead.dot(place));
  wave.heading -= turn;
  return wave;
}

constexpr double step = 0.1;
const RegularWave wave{1.3, 40 * degree, {0.3, 0.2}};

/// Largest difference between the forces of two surfaces over the largest force of each mode, both
/// marched at rest.
double apart(DirectRadiation& a, DirectRadiation& b) {
  a.start(step);
  b.start(step);
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(6), difference = largest;
  for (int n = 0; n < 120; ++n) {
    const Eigen::VectorXd force = a.calc_force();
    largest = largest.cwiseMax(force.cwiseAbs());
    difference = difference.cwiseMax((force - b.calc_force()).cwiseAbs());
    a.advance(Eigen::VectorXd::Zero(6));
    b.advance(Eigen::VectorXd::Zero(6));
  }
  return difference.cwiseQuotient(largest).maxCoeff();
}

// What a turned barge off the origin elsewhere meets is what it meets at home from the heading
// against it: exactly at turns of the grid, to 0.2^2/8 of a panel's share between them.
TEST(TurningSurface, MeetsWavesUnderTheHeadingAgainstIt) {
  const PanelModel model = barge_off_the_origin();
  const Eigen::Vector2d origin(100, 50), home(3, -2), place(131, 20);
  DirectRadiation turned = meeting(model, wave, origin);
  for (const double turn : {30.0, -150.0, 32.5}) {
    turned.carry(place, turn * degree);
    // seen_from(place) has the phase there; the panels at home take theirs at the mean of the hull.
    const double k = calc_wave_number(wave.frequency, water);
    const double heading = wave.heading - turn * degree;
    RegularWave seen = seen_from(place - origin, turn * degree, wave);
    seen.amplitude *=
        std::polar(1.0, k * (std::cos(heading) * home.x() + std::sin(heading) * home.y()));
    DirectRadiation expected = meeting(model, seen);
    const bool on_grid = std::abs(std::remainder(turn, 5.0)) < 1e-9;
    EXPECT_LT(apart(expected, turned), on_grid ? 1e-6 : 0.01) << turn;
  }
}

// Turned by a quarter within half a minute its force neither jumps, nor remembers after a few
// periods that it turned.
TEST(TurningSurface, TurnsWithoutAJump) {
  const PanelModel model = barge_off_the_origin();
  const Eigen::Vector2d home(3, -2);
  DirectRadiation turning = meeting(model, wave);
  DirectRadiation turned = meeting(model, wave);
  turned.carry(home, 90 * degree);
  turning.start(step);
  turned.start(step);
  Eigen::VectorXd before[2] = {turning.calc_force(), turning.calc_force()};
  double largest = 0, sharpest = 0, left = 0;
  for (int n = 1; n <= 600; ++n) {
    const double turn = std::min(90.0, 0.3 * n) * degree;
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(6);
    turning.carry(home, turn);
    turning.advance(velocity);
    turned.advance(velocity);
    const Eigen::VectorXd now = turning.calc_force();
    largest = std::max(largest, std::abs(now[heave]));
    sharpest = std::max(sharpest, std::abs(now[heave] - 2 * before[0][heave] + before[1][heave]));
    before[1] = before[0];
    before[0] = now;
    if (n > 500) left = std::max(left, std::abs(now[heave] - turned.calc_force()[heave]));
  }
  // A wave of this frequency and the turn's own change of phase, k L/2 times 3 degrees a second,
  // bend it no more.
  const double rate = wave.frequency + 0.172 * 10 * 3 * degree;
  EXPECT_LT(sharpest, 1.2 * std::pow(rate * step, 2) * largest);
  EXPECT_LT(left, 0.02 * largest);  // short waves that this coarse surface keeps: 1.3 %
}

/// The force on a barge off the origin that heaves and surges along itself as it lies at a place
/// under a heading, in its own axes.
Eigen::MatrixXd march(const PanelModel& model, DirectRadiation radiation, const Pose& X_WB) {
  MechanismBuilder builder;
  builder.add_body({.name = "barge",
                    .joint = {.kind = JointKind::free},
                    .mass = 1e5,
                    .I_BBcm_B = 1e6 * Matrix3::Identity()});
  const Mechanism mechanism = builder.build();
  const LiftSystem system(
      {.mechanism = mechanism,
       .operation = OperationBuilder().build(10.0),
       .q_start = mechanism.zero_configuration(),
       .v_start = Eigen::VectorXd::Zero(6),
       .water = std::make_shared<const RadiatedWater>(
           std::vector<BodyFrame>{{1, {Matrix3::Identity(), model.bodies()[0].reference_point}}},
           radiation.infinite_added_mass())});
  LiftWorkspace w(system);
  w.q << X_WB.p, quaternion_from_rotation(X_WB.R);
  w.v.setZero();
  MarchedSurface surface(radiation, step, system, w);
  Eigen::MatrixXd force(6, 60);
  for (int n = 0; n < 60; ++n) {
    w.v[3] = 0.4 * std::sin(0.9 * step * n);
    w.v[5] = 0.2 * std::cos(1.1 * step * n);
    compute_kinematics(mechanism, w.q, w.v, w.kinematics);
    surface.advance(w);
    force.col(n) = w.marched.coefficients.rowwise().sum();
  }
  return force;
}

// The barge off the origin, and the wave with it, turned and carried elsewhere: the same force in
// her own axes.
TEST(TurningSurface, KeepsTheForceInTheBargesOwnAxes) {
  const PanelModel model = barge_off_the_origin();
  const Eigen::MatrixXd home = march(model, meeting(model, wave), Pose::identity());
  const double turn = 60 * degree;
  const Pose X_WB{rotation_about(Vector3::UnitZ(), turn), {200, -80, 0}};
  RegularWave turned = wave;
  turned.heading += turn;
  const double k = calc_wave_number(wave.frequency, water);
  turned.amplitude *= std::polar(
      1.0, k * (std::cos(turned.heading) * X_WB.p.x() + std::sin(turned.heading) * X_WB.p.y()));
  const Eigen::MatrixXd elsewhere = march(model, meeting(model, turned), X_WB);
  EXPECT_GT(home.row(2).cwiseAbs().maxCoeff(), 0);
  for (Eigen::Index mode = 0; mode < 6; ++mode) {
    EXPECT_LT((home - elsewhere).row(mode).cwiseAbs().maxCoeff(),
              1e-6 * home.row(mode).cwiseAbs().maxCoeff());
  }
}

}  // namespace
}  // namespace blocklift::dynamics
