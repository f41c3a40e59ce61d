// Forces that are linear in waves and motion act along axes that turn with a body's yaw alone: what
// they are on a body that rolls and pitches, their means, and their energy.
#include "dynamics/marine/loads/level_axes.h"

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;
using Complex = std::complex<double>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double straight_angle = std::numbers::pi;
constexpr double wave_frequency = 1.0, level_gravity = 9.80665;  // rad/s, m/s2
constexpr double box_wave_number = wave_frequency * wave_frequency / level_gravity;
constexpr double box_mass = 3.69e6, box_roll_inertia = 1.8e8, box_pitch_inertia = 1e9;

Matrix3 attitude(double yaw_angle, double pitch_angle, double roll_angle) {
  return rotation_about(Vector3::UnitZ(), yaw_angle) *
         rotation_about(Vector3::UnitY(), pitch_angle) *
         rotation_about(Vector3::UnitX(), roll_angle);
}

/// Of a box's size: K = P exp(-t/2) (cos t - sin t/2), which does not brake steady motion and is
/// passive,  int K exp(-i w t) dt = P i w/((i w + 1/2)^2 + 1).
const Vector6 box_added_mass = (Vector6() << 2e5, 1e6, 4e6, 1.5e8, 6e8, 3e8).finished();
const Vector6 box_memory_peak = (Vector6() << 1e5, 5e5, 1e6, 1e7, 8e7, 2e7).finished();
const Complex memory_per_peak =
    Complex(0, wave_frequency) /
    ((Complex(0.5, wave_frequency)) * (Complex(0.5, wave_frequency)) + Complex(1, 0));
/// X from whatever heading.
const Eigen::Matrix<Complex, 6, 1> box_excitation =
    (Eigen::Matrix<Complex, 6, 1>() << 0, std::polar(3e6, 0.9), 5e6, Complex(0, 1e7), 0, 0)
        .finished();

std::shared_ptr<const HydrodynamicDatabase> database_of_box() {
  auto database = std::make_shared<HydrodynamicDatabase>();
  database->water = {.density = 1025, .gravity = level_gravity};
  database->body_names = {"box"};
  database->reference_points = {Vector3::Zero()};
  database->infinite_added_mass = box_added_mass.asDiagonal();
  database->frequencies = {wave_frequency};
  for (int j = 0; j < 72; ++j) database->headings.push_back(j * straight_angle / 36);
  database->diffraction.emplace_back(box_excitation.replicate(1, 72));
  return database;
}

std::shared_ptr<const RadiatedWater> water_of_box(const BodyFrame& frame) {
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(12);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(12, 6), C = Eigen::MatrixXd::Zero(6, 12);
  for (Eigen::Index mode = 0; mode < 6; ++mode) {
    turn[2 * mode] = 1.0;
    B(2 * mode, mode) = 1.0;
    B(2 * mode + 1, mode) = -0.5;
    C(mode, 2 * mode) = box_memory_peak[mode];
  }
  auto series = std::make_shared<HydrodynamicSeries>();
  series->draughts = {0.0};
  series->databases = {*database_of_box()};
  series->memories.emplace_back(Eigen::VectorXd::Constant(12, -0.5), turn, B, C, 0.0);
  RadiatedWater::Definition definition;
  definition.frames = {frame};
  definition.series = series;
  return std::make_shared<const RadiatedWater>(definition);
}

DiffractionForce waves_on_box(const BodyFrame& frame, double amplitude) {
  DiffractionForce::Definition d;
  d.name = "box";
  d.frame = frame;
  d.database = database_of_box();
  d.sea = std::make_shared<const Sea>(
      Sea{WaveField(Water{.gravity = level_gravity},
                    {{amplitude, wave_frequency, straight_angle / 2, 0.0}}),
          {}});
  return DiffractionForce(d);
}

/// The box, free, with buoyancy by its stiffness about Bo, which is its centre of mass in the water
/// line; and what else acts.
LiftSystem floating_box(std::shared_ptr<const RadiatedWater> water, ForceElements elements,
                        double duration) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -level_gravity});
  builder.add_body(
      {.name = "box",
       .joint = {.kind = JointKind::free},
       .mass = box_mass,
       .I_BBcm_B = Vector3(box_roll_inertia, box_pitch_inertia, box_pitch_inertia).asDiagonal()});
  LinearBuoyancy::Definition buoyancy;
  buoyancy.name = "box";
  buoyancy.frame = {1, Pose::identity()};
  buoyancy.rest_height = 0.0;
  buoyancy.buoyancy = box_mass * level_gravity;
  buoyancy.centre = {0, 0};
  // Roll is at resonance.
  const double roll_stiffness =
      wave_frequency * wave_frequency * (box_roll_inertia + box_added_mass[3]);
  buoyancy.stiffness = Vector3(1.2e7, roll_stiffness, 4e9).asDiagonal();
  std::get<std::vector<LinearBuoyancy>>(elements).emplace_back(buoyancy);
  const Mechanism mechanism = builder.build();
  return LiftSystem({.mechanism = mechanism,
                     .ropes = {},
                     .supports = {},
                     .elements = std::move(elements),
                     .operation = OperationBuilder().build(duration),
                     .q_start = mechanism.zero_configuration(),
                     .v_start = {},
                     .water = std::move(water)});
}

TEST(LevelAxes, TurnWithTheYawAlone) {
  for (const double yaw_angle : {-2.0, 0.0, 0.7, 3.0}) {
    const Matrix3 R = attitude(yaw_angle, 0.4, -0.9);
    EXPECT_NEAR(find_heading(R), yaw_angle, 1e-12);
    EXPECT_LT((level_axes(R) - rotation_about(Vector3::UnitZ(), yaw_angle)).norm(), 1e-12);
  }
  // Where no heading is left there are axes all the same.
  Matrix3 upright;
  upright << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  EXPECT_TRUE(level_axes(upright).isIdentity(0.0));
}

// Rolled and pitched about R, the body is pressed as it is upright with the same heading.
TEST(LevelAxes, DiffractionDoesNotTiltWithTheBody) {
  const BodyFrame frame{1, {rotation_about(Vector3::UnitZ(), 0.3), {1, 2, -0.5}}};
  const DiffractionForce force = waves_on_box(frame, 1.5);
  const Vector3 p_WR(4, -7, 0.3);
  test::OneBody body;
  body.time = 2.3;
  const auto place = [&](double pitch_angle, double roll_angle) {
    const Matrix3 R_WB = attitude(1.1, pitch_angle, roll_angle) * frame.X_BH.R.transpose();
    body.q << p_WR - R_WB * frame.X_BH.p, quaternion_from_rotation(R_WB);
    body.v << 0.1, -0.2, 0.3, 1, 2, -1;
    body.update();
    return force.calc_force(body.state());
  };
  const ForceVector upright = place(0.0, 0.0);
  const ForceVector tilted = place(-0.2, 0.35);
  EXPECT_GT(upright.force.norm(), 1e6);
  EXPECT_LT((tilted.force - upright.force).norm(), 1e-9 * upright.force.norm());
  EXPECT_LT((tilted.moment - upright.moment).norm(), 1e-9 * upright.moment.norm());
  test::expect_balanced(body, force);
}

// Nor does what the memory does, and what it is told: the same states press with the same force at
// R, and the same velocities of R drive them, whatever roll and pitch.
TEST(LevelAxes, MemoryDoesNotTiltWithTheBody) {
  const BodyFrame frame{1, {rotation_about(Vector3::UnitZ(), 0.3), {1, 2, -0.5}}};
  const auto water = water_of_box(frame);
  const LiftSystem system = floating_box(water, {}, 1.0);
  LiftWorkspace workspace(system);
  Random random(3);
  const Eigen::VectorXd states = random.values(12, 1);
  const MotionVector V_R_W{{0.1, -0.3, 0.2}, {1.0, -0.5, 0.7}};
  const auto at = [&](double pitch_angle, double roll_angle) {
    const Matrix3 R_WB = attitude(1.1, pitch_angle, roll_angle) * frame.X_BH.R.transpose();
    const Vector3 p_BoR_W = R_WB * frame.X_BH.p;
    const MotionVector V_Bo_W = shift(V_R_W, Vector3(-p_BoR_W));
    workspace.q << Vector3(4, -7, 0.3) - p_BoR_W, quaternion_from_rotation(R_WB);
    workspace.v << R_WB.transpose() * V_Bo_W.angular, R_WB.transpose() * V_Bo_W.linear;
    workspace.memory = states;
    compute_kinematics(system.mechanism(), workspace.q, workspace.v, workspace.kinematics);
    workspace.loads.set_zero();
    calc_water_forces(*water, 0.0, workspace);
    add_level_forces(water->frames(), workspace.kinematics, workspace.water_force,
                     workspace.loads.F_Bo_W);
    water->calc_rate(workspace.water_shares, workspace.memory, workspace.level_velocity,
                     workspace.memory_rate);
    const ForceVector F_R_W = shift_to(workspace.loads.F_Bo_W[1], Vector3(-p_BoR_W));
    // The force's power equals the ledger's.
    EXPECT_NEAR(dot(F_R_W, V_R_W), workspace.water_force.dot(workspace.level_velocity), 1.0);
    Eigen::Matrix<double, 18, 1> found;
    found << F_R_W.moment, F_R_W.force, workspace.memory_rate;
    return found;
  };
  const auto upright = at(0.0, 0.0), tilted = at(-0.2, 0.35);
  EXPECT_LT((tilted - upright).head<6>().norm(), 1e-9 * upright.head<6>().norm());
  EXPECT_LT((tilted - upright).tail<12>().norm(), 1e-9 * upright.tail<12>().norm());
}

// A body that rolls in time with the waves, at one place: the waves' force along the water has no
// mean over a period. Turned with the body it would have  -|a|^2 Re(X_heave conj(roll))/2.
TEST(LevelAxes, RollBringsNoMeanForce) {
  const double amplitude = 1.0;
  const Complex roll_amplitude = std::polar(0.05, 0.4);
  const DiffractionForce force = waves_on_box({1, Pose::identity()}, amplitude);
  test::OneBody body;
  Vector3 mean = Vector3::Zero(), mean_in_body = Vector3::Zero();
  constexpr int count = 64;
  for (int n = 0; n < count; ++n) {
    body.time = 2 * straight_angle / wave_frequency * n / count;
    const double angle = (roll_amplitude * std::polar(1.0, wave_frequency * body.time)).real();
    const Matrix3 R = attitude(0.0, 0.0, angle);
    body.q.tail<4>() = quaternion_from_rotation(R);
    body.update();
    const Vector3 F = force.calc_force(body.state()).force;
    mean += F / count;
    mean_in_body += R * F / count;
  }
  EXPECT_LT(mean.norm(), 1e-9 * box_excitation.norm());
  // The third order of the roll leaves an eighth of its square, as J_1 has it.
  const double tilt = -0.5 * (box_excitation[2] * std::conj(roll_amplitude)).real();
  EXPECT_NEAR(mean_in_body.y(), tilt, 2.0 * std::norm(roll_amplitude) * std::abs(tilt));
}

// The box on springs, abeam to waves in which it rolls most. What the springs bear in the mean is
// that R sways in the waves,  Re(-i k X conj(sway))/2 = (k/w) times the power of the waves' sway
// force, and the rest is of fourth order. Excitation and memory turned with the roll would add
// -Re((X - i w K xi)_heave conj(roll))/2, here 35 times as much against the waves.
TEST(LevelAxes, ABoxThatRollsInWavesIsHardlyPushed) {
  const double amplitude = 0.1;
  const BodyFrame frame{1, Pose::identity()};
  ForceElements elements;
  LinearRestraint::Definition springs;
  springs.name = "springs";
  springs.point = {1, Vector3::Zero()};
  springs.X_WR = Pose::identity();
  springs.stiffness.diagonal() << 0, 0, 3e8, 4.7e5, 4.7e5, 0;
  springs.damping.diagonal() << 2e7, 0, 3e8, 6e5, 6e5, 0;
  std::get<std::vector<LinearRestraint>>(elements).emplace_back(springs);
  std::get<std::vector<DiffractionForce>>(elements).push_back(waves_on_box(frame, amplitude));

  const auto response = [&](Eigen::Index mode, double inertia, double damping, double stiffness) {
    const Complex impedance = damping + memory_per_peak * box_memory_peak[mode];
    return box_excitation[mode] /
           (stiffness - wave_frequency * wave_frequency * (inertia + box_added_mass[mode]) +
            Complex(0, wave_frequency) * impedance);
  };
  const Complex sway_of = response(1, box_mass, 6e5, 4.7e5);
  const Complex heave_of = response(2, box_mass, 0, 1.2e7);
  const Complex roll_of =
      response(3, box_roll_inertia, 2e7,
               wave_frequency * wave_frequency * (box_roll_inertia + box_added_mass[3]));
  const double swaying = 0.5 * box_wave_number * (box_excitation[1] * std::conj(sway_of)).imag();
  const Complex heave_force = box_excitation[2] - Complex(0, wave_frequency) * memory_per_peak *
                                                      box_memory_peak[2] * heave_of;
  const double tilting = -0.5 * (heave_force * std::conj(roll_of)).real();
  ASSERT_GT(std::abs(tilting), 30 * std::abs(swaying));

  constexpr int per_period = 40;
  const double period = 2 * straight_angle / wave_frequency;
  const LiftSystem system = floating_box(water_of_box(frame), std::move(elements), 50 * period);
  const IntegrationResult result =
      integrate(system, system.q_start(), system.v_start(),
                {.relative_tolerance = 1e-8, .sample_interval = period / per_period});
  const auto tail = result.history.bodies[0].pose.bottomRows(10 * per_period);
  const double mean = 4.7e5 * tail.col(1).mean() / (amplitude * amplitude);
  const double roll_size = amplitude * std::abs(roll_of);
  std::printf("mean %.0f N/m2, of swaying %.0f, of a force that rolls it would be %.0f\n", mean,
              swaying, tilting);
  EXPECT_NEAR(2 * tail.col(4).cwiseAbs().maxCoeff(), roll_size, 0.02 * roll_size);
  EXPECT_NEAR(mean, swaying, roll_size * roll_size * std::abs(tilting));
}

// Let go with a large roll and pitch: what the memory takes is accounted for, and it never gives
// back more than it was given.
TEST(LevelAxes, MemoryKeepsItsAccountAtLargeMotions) {
  const LiftSystem system = floating_box(
      water_of_box({1, {rotation_about(Vector3::UnitZ(), 0.3), {3, 1, -1}}}), {}, 20.0);
  Eigen::VectorXd q = system.q_start(), v = system.v_start();
  q.tail<4>() = quaternion_from_rotation(attitude(0.0, 0.15, 0.5));
  v << 0.1, 0.02, 0.05, 0.5, -0.3, 0.2;
  const IntegrationResult result =
      integrate(system, q, v, {.relative_tolerance = 1e-9, .sample_interval = 0.1});
  const EnergyHistory& e = result.history.energy;
  const Eigen::VectorXd total = e.kinetic + e.gravity + e.elastic - e.outside_work + e.dissipated;
  const double turned_over = e.kinetic.maxCoeff();
  EXPECT_LT((total.array() - total[0]).abs().maxCoeff(), 1e-4 * turned_over);
  EXPECT_LT(e.outside_work.maxCoeff(), 1e-4 * turned_over);
  EXPECT_LT(e.outside_work.minCoeff(), -0.01 * turned_over);
}

}  // namespace
}  // namespace blocklift::dynamics
