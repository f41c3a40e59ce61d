// Bodies that give way where ropes pull: springs in series by hand, the rigid limit, conservation
// of energy, derivatives against differences, and modes against the static compliance that they
// make up.
#include "dynamics/rope/elastic_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/energy.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/linearisation.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/allocation_counter.h"

namespace blocklift::dynamics {
namespace {

constexpr double mass = 1000, gravity = 9.81, stiffness = 2e5, rope_length = 10;

// What a beam on ropes is made of.
struct Sample {
  int ropes = 3;                  ///< side by side, 4 m apart, upright
  Eigen::MatrixXd compliance{};   ///< 3 ropes square; empty: a rigid body
  Eigen::MatrixXd shapes{};       ///< 3 ropes x modes
  Eigen::VectorXd frequencies{};  ///< of the modes, rad/s
  double modal_damping = 0;
  double modal_mass = 1;
  double damping_time = 0;
  double inclination = 0;  ///< sideways distance of the ropes' upper ends, m
  double lean = 0.3;       ///< of each further rope, across the beam, m
  bool curved = false;     ///< ropes that grow stiffer with their load
};

double place(int rope) { return 4.0 * rope; }

LiftSystem hang(const Sample& sample) {
  MechanismBuilder builder;
  builder.set_gravity(Vector3(0, 0, -gravity));
  const double middle = place(sample.ropes - 1) / 2;
  BodyDefinition beam;
  beam.name = "beam";
  beam.joint.kind = JointKind::free;
  beam.mass = mass;
  beam.p_BoBcm_B = Vector3(middle, 0, -1);
  beam.I_BBcm_B = Vector3(300, 5000, 5000).asDiagonal();
  const BodyIndex body = builder.add_body(beam);
  std::vector<int> modes;
  for (Eigen::Index k = 0; k < sample.frequencies.size(); ++k) {
    modes.push_back(builder.add_elastic_mode({.name = "mode " + std::to_string(k + 1),
                                              .body = body,
                                              .modal_mass = sample.modal_mass,
                                              .angular_frequency = sample.frequencies[k],
                                              .damping_ratio = sample.modal_damping}));
  }
  const Mechanism mechanism = builder.build();
  std::vector<Rope> ropes;
  ElasticBody::Definition elastic{"beam", body, {}, sample.compliance, sample.shapes, modes};
  for (int i = 0; i < sample.ropes; ++i) {
    RopeDefinition rope;
    rope.name = "R" + std::to_string(i + 1);
    rope.points = {
        {world_index, Vector3(place(i) + sample.inclination * (i - 1), sample.lean * i, 20)},
        {body, Vector3(place(i), 0, 0)}};
    if (sample.curved)
      rope.tension_law = TensionLaw({{0, 0}, {0.002, 1e3}, {0.004, 4e3}, {0.008, 16e3}});
    else
      rope.axial_stiffness = stiffness * rope_length;
    rope.damping_time = sample.damping_time;
    rope.unstretched_length = rope_length;
    ropes.emplace_back(mechanism, rope);
    elastic.ends.push_back({i, true});
  }
  Eigen::VectorXd q = mechanism.zero_configuration();
  q[2] = 20 - rope_length - 0.02;
  LiftDefinition definition{mechanism, ropes, {}, {}, OperationBuilder().build(2), q};
  if (sample.compliance.size() > 0) {
    elastic.shapes.conservativeResize(3 * sample.ropes, sample.frequencies.size());
    definition.elastic_bodies.emplace_back(mechanism, ropes, elastic);
  }
  return LiftSystem(std::move(definition));
}

Eigen::VectorXd tensions_at_rest(const LiftSystem& system, Eigen::VectorXd* q_rest = nullptr) {
  Eigen::VectorXd q = system.q_start();
  EquilibriumSolver(system).solve(0, q);
  LiftWorkspace w(system);
  w.q = q;
  w.v.setZero();
  calc_loads(system, 0, nullptr, w);
  if (q_rest) *q_rest = q;
  Eigen::VectorXd tension(static_cast<Eigen::Index>(w.rope_loads.size()));
  for (Eigen::Index i = 0; i < tension.size(); ++i) tension[i] = w.rope_loads[i].tension;
  return tension;
}

// A symmetric positive compliance that couples all directions of all lugs, m/N.
Eigen::MatrixXd coupled_compliance(int ropes, double size) {
  Eigen::MatrixXd root(3 * ropes, 3 * ropes);
  for (Eigen::Index i = 0; i < root.rows(); ++i)
    for (Eigen::Index j = 0; j < root.cols(); ++j)
      root(i, j) = std::sin(1.0 + 3.0 * static_cast<double>(i) + 1.7 * static_cast<double>(j * j));
  return size / static_cast<double>(root.rows()) * root * root.transpose();
}

// One rope on a lug that gives way by c: the weight stretches both springs.
TEST(ElasticBody, RopeAndLugAreSpringsInSeries) {
  const double c = 3e-6;
  Eigen::VectorXd rigid_q, elastic_q;
  const Sample single{.ropes = 1};
  tensions_at_rest(hang(single), &rigid_q);
  Sample sample = single;
  sample.compliance = c * Eigen::Matrix3d::Identity();
  const Eigen::VectorXd tension = tensions_at_rest(hang(sample), &elastic_q);
  EXPECT_NEAR(tension[0], mass * gravity, 1e-6 * mass * gravity);
  EXPECT_NEAR(rigid_q[2] - elastic_q[2], mass * gravity * c, 1e-7);
}

// The same with a rope that grows stiffer with its load: it stretches by its law at the weight.
TEST(ElasticBody, RopeWithATensionLawAndLugAreSpringsInSeries) {
  const double c = 3e-6;
  Eigen::VectorXd q;
  const Sample sample{.ropes = 1, .compliance = c * Eigen::Matrix3d::Identity(), .curved = true};
  const LiftSystem system = hang(sample);
  const Eigen::VectorXd tension = tensions_at_rest(system, &q);
  const double weight = mass * gravity;
  EXPECT_NEAR(tension[0], weight, 1e-9 * weight);
  const double strain = system.ropes()[0].definition().tension_law->find_strain(weight);
  EXPECT_NEAR(20 - q[2], rope_length * (1 + strain) + weight * c, 1e-8);
}

// A stiff beam level on three upright ropes: with a lug in the middle that gives way, loads share
// by the compliances 1/k, 1/k + c, 1/k. Level by symmetry, T_i (1/k + c_i) is equal.
TEST(ElasticBody, LoadsShareByTheLugsCompliances) {
  const double c = 4e-6;
  Sample sample;
  sample.compliance = Eigen::MatrixXd::Zero(9, 9);
  sample.compliance(5, 5) = c;
  // Upright: the ropes' upper ends right above the lugs.
  const LiftSystem system = hang(sample);
  const Eigen::VectorXd tension = tensions_at_rest(system);
  const double side = 1 / stiffness, middle = 1 / stiffness + c;
  const double share = mass * gravity / (2 / side + 1 / middle);
  // The ropes lean by 0.3 m over 10 m across the beam, and so hold a little more than the weight.
  EXPECT_NEAR(tension[1] / (share / middle), 1, 2e-3);
  EXPECT_NEAR(tension[0] / (share / side), 1, 2e-3);
  EXPECT_LT(tension[1], 0.62 * tension[0]);
}

TEST(ElasticBody, WithoutComplianceItIsTheRigidBody) {
  Sample sample{.damping_time = 0.02, .inclination = 1};
  const LiftSystem rigid = hang(sample);
  sample.compliance = Eigen::MatrixXd::Zero(9, 9);
  const LiftSystem elastic = hang(sample);
  LiftWorkspace of_rigid(rigid), of_elastic(elastic);
  Eigen::VectorXd y(rigid.state_size()), rigid_rate(y.size()), elastic_rate(y.size());
  get_state(rigid, rigid.q_start(), Eigen::VectorXd::LinSpaced(6, -0.1, 0.2), y);
  calc_right_hand_side(rigid, 0, y, nullptr, of_rigid, rigid_rate);
  calc_right_hand_side(elastic, 0, y, nullptr, of_elastic, elastic_rate);
  EXPECT_LT((rigid_rate - elastic_rate).norm(), 1e-12 * rigid_rate.norm());
}

TEST(ElasticBody, EnergyIsKept) {
  Sample sample{.inclination = 1};
  sample.compliance = coupled_compliance(3, 4e-6);
  sample.frequencies = Eigen::Vector2d(20, 45);
  sample.shapes = Eigen::MatrixXd::NullaryExpr(9, 2, [](Eigen::Index i, Eigen::Index k) {
    return 0.02 * std::cos(2.0 + static_cast<double>(i * (k + 1)));
  });
  for (const double damping : {0.0, 0.03}) {
    sample.damping_time = sample.modal_damping = damping;
    const LiftSystem system = hang(sample);
    IntegrationSettings settings;
    settings.relative_tolerance = 1e-9;
    settings.sample_interval = 0.1;
    Eigen::VectorXd v = Eigen::VectorXd::Zero(system.mechanism().nv());
    v.head<6>() << 0.02, -0.01, 0.01, 0.05, 0.05, -0.1;
    const History history = integrate(system, system.q_start(), v, settings).history;
    const EnergyHistory& energy = history.energy;
    const Eigen::VectorXd sum =
        energy.kinetic + energy.gravity + energy.elastic + energy.dissipated;
    const double exchanged = energy.elastic.maxCoeff() - energy.elastic.minCoeff();
    ASSERT_GT(exchanged, 100);
    // Undamped what the steps lose (6e-7). A damped rope that went slack while it was stretched
    // comes to rest within a step, where the damping of its neighbours jumps and the sum of the
    // works with it.
    EXPECT_LT((sum.array() - sum[0]).abs().maxCoeff(), (damping > 0 ? 1e-5 : 1e-6) * exchanged);
    EXPECT_GT(energy.elastic.minCoeff(), 0);
    if (damping > 0) {
      EXPECT_GT(energy.dissipated.tail<1>()[0], 0.01 * exchanged);
    }
  }
}

// As above, without damping: the balance tells whether stored energy, tension and stiffness of the
// ropes' law belong together on a body that gives way.
TEST(ElasticBody, EnergyIsKeptWithTensionLaws) {
  Sample sample{.inclination = 1, .curved = true};
  sample.compliance = coupled_compliance(3, 4e-6);
  const LiftSystem system = hang(sample);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(system.mechanism().nv());
  v.head<6>() << 0.02, -0.01, 0.01, 0.05, 0.05, -0.1;
  const EnergyHistory energy =
      integrate(system, system.q_start(), v, {.relative_tolerance = 1e-9, .sample_interval = 0.1})
          .history.energy;
  const Eigen::VectorXd sum = energy.kinetic + energy.gravity + energy.elastic;
  const double exchanged = energy.elastic.maxCoeff() - energy.elastic.minCoeff();
  ASSERT_GT(exchanged, 50);
  EXPECT_LT((sum.array() - sum[0]).abs().maxCoeff(), 1e-5 * exchanged);
}

TEST(ElasticBody, DerivativesOfTensionLawsAreThoseOfDifferences) {
  Sample sample{.damping_time = 0.02, .inclination = 2, .curved = true};
  sample.compliance = coupled_compliance(3, 4e-6);
  const LiftSystem system = hang(sample);
  Eigen::VectorXd q;
  tensions_at_rest(system, &q);
  LiftWorkspace w(system);
  JacobianWorkspace workspace(system);
  Eigen::MatrixXd jacobian(system.state_size(), system.state_size());
  Eigen::VectorXd y(system.state_size());
  const Contacts contacts(3, 1);
  get_state(system, q, Eigen::VectorXd::Zero(system.mechanism().nv()), y);
  calc_jacobian(system, 0, y, &contacts, w, workspace, jacobian);
  const Eigen::MatrixXd by_differences = difference_jacobian(system, 0, y, &contacts, w, 1e-6);
  EXPECT_LT((jacobian - by_differences).cwiseAbs().maxCoeff(),
            2e-6 * by_differences.cwiseAbs().maxCoeff());
}

// Central differences with a step h are good to h^2 and to the rounding over h.
TEST(ElasticBody, DerivativesAreThoseOfDifferences) {
  Sample sample{.damping_time = 0.02, .inclination = 2};
  sample.compliance = coupled_compliance(3, 4e-6);
  sample.frequencies = Eigen::Vector2d(20, 45);
  sample.shapes = Eigen::MatrixXd::NullaryExpr(9, 2, [](Eigen::Index i, Eigen::Index k) {
    return 0.02 * std::cos(2.0 + static_cast<double>(i * (k + 1)));
  });
  const LiftSystem system = hang(sample);
  Eigen::VectorXd q;
  tensions_at_rest(system, &q);
  LiftWorkspace w(system);
  JacobianWorkspace workspace(system);
  Eigen::MatrixXd jacobian(system.state_size(), system.state_size());
  Eigen::VectorXd y(system.state_size());
  const Contacts contacts(3, 1);
  for (const double speed : {0.0, 0.05}) {
    const Eigen::VectorXd v = speed * Eigen::VectorXd::LinSpaced(system.mechanism().nv(), -1, 1.5);
    get_state(system, q, v, y);
    calc_jacobian(system, 0, y, &contacts, w, workspace, jacobian);
    const Eigen::MatrixXd by_differences = difference_jacobian(system, 0, y, &contacts, w, 1e-6);
    // In motion the damping's change with the direction of the pull is left out.
    const double tolerance = speed > 0 ? 1e-3 : 2e-7;
    EXPECT_LT((jacobian - by_differences).cwiseAbs().maxCoeff(),
              tolerance * by_differences.cwiseAbs().maxCoeff())
        << "speed " << speed;
  }
}

// Two flexible modes' worth of compliance of three lugs, m/N.
Eigen::MatrixXd two_shapes() {
  return Eigen::MatrixXd::NullaryExpr(
      9, 2, [](auto i, auto k) { return std::cos(1.0 + static_cast<double>(i * (k + 2))); });
}

// Tension of the first rope as the beam swings sideways from rest, and the tensions at rest.
struct Swing {
  Eigen::VectorXd tension, at_rest;
};
Swing swing(const LiftSystem& system) {
  Swing result;
  Eigen::VectorXd q;
  result.at_rest = tensions_at_rest(system, &q);
  IntegrationSettings settings;
  settings.relative_tolerance = 1e-8;
  settings.sample_interval = 0.01;
  Eigen::VectorXd v = Eigen::VectorXd::Zero(system.mechanism().nv());
  v[3] = 0.1;
  result.tension = integrate(system, q, v, settings).history.ropes[0].tension;
  return result;
}

// The beam whose compliance is made up of two modes at omega, and that whose compliance follows at
// once.
double largest_difference(double omega, double damping_time, double* mean = nullptr) {
  Sample still{.damping_time = damping_time, .inclination = 1};
  Sample moving = still;
  still.compliance = 2e-6 * two_shapes() * two_shapes().transpose();
  moving.compliance = Eigen::MatrixXd::Zero(9, 9);
  moving.frequencies = Eigen::Vector2d(omega, omega);
  moving.shapes = omega * std::sqrt(2e-6) * two_shapes();
  moving.modal_damping = 0.05;
  const Swing by_modes = swing(hang(moving)), at_once = swing(hang(still));
  EXPECT_LT((by_modes.at_rest - at_once.at_rest).norm(), 1e-6 * at_once.at_rest.norm());
  const Eigen::VectorXd difference = (by_modes.tension - at_once.tension).cwiseAbs();
  if (mean) *mean = difference.mean();
  return difference.maxCoeff();
}

// Modes whose sum is the compliance: the same at rest; the faster they are beside the motion, the
// less they move by themselves. The inertia of a mode changes what it gives by (Omega / omega)^2,
// Omega being the frequency of the motion: of second order, so that twice omega leaves about a
// quarter.
TEST(ElasticBody, ModesComeToTheStaticComplianceAsTheMotionSlows) {
  double coarse = 0, fine = 0;
  largest_difference(120, 0, &coarse);
  largest_difference(240, 0, &fine);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

// What remains with damped ropes and modes far above the motion is the condensed damping's error,
// of second order in the damping time.
TEST(ElasticBody, CondensedDampingIsExactToTheFirstOrder) {
  EXPECT_NEAR(std::log2(largest_difference(480, 0.01) / largest_difference(480, 0.005)), 2, 0.4);
}

// Modes of a free uniform beam, cos bL cosh bL = 1, at x from one end, with the mean square 1.
// Source: Blevins (1979), table 8-1, free-free.
double free_beam_mode(double bL, double x_over_length) {
  const double a = bL * x_over_length;
  // 1 - sigma, and cosh - sigma sinh, without the cancellation of large numbers.
  const double rest =
      (std::cos(bL) - std::sin(bL) - std::exp(-bL)) / (std::sinh(bL) - std::sin(bL));
  const double hyperbolic = rest / 2 * std::exp(a) + (1 - rest / 2) * std::exp(-a);
  return hyperbolic + std::cos(a) - (1 - rest) * std::sin(a);
}

// bL of the n-th of them, by Newton's method.
double free_beam_root(int n) {
  double bL = (n + 0.5) * std::numbers::pi;
  for (int i = 0; i < 5; ++i)
    bL -= (std::cos(bL) - 1 / std::cosh(bL)) /
          (-std::sin(bL) + std::sinh(bL) / std::pow(std::cosh(bL), 2));
  return bL;
}

// A uniform beam of its own weight on three upright ropes of stiffness k, at its ends and its
// middle, level at first. From the deflection 5 W L^3 / 384 EI of the simply supported beam less R
// L^3 / 48 EI by the middle rope, equal to what the ropes give, R / k - (W - R) / 2k:
//   R = W (5 L^3 / 384 EI + 1/2k) / (L^3 / 48 EI + 3/2k)
// (Timoshenko, Strength of Materials I, 1955, beam on elastic supports.) The free beam's compliance
// is the sum over its modes, phi_i phi_j L^3 / (EI (bL)^4), the sum of whose terms beyond the 18th
// is below 2e-5.
TEST(ElasticBody, AUniformBeamOnThreeRopesSharesItsWeight) {
  const double length = place(2), weight = mass * gravity;
  for (const double flexibility : {0.1, 1.0, 10.0}) {  // L^3 / (48 EI) times k
    const double by_middle = flexibility / stiffness, c = 48 * by_middle;
    Sample sample{.lean = 0};
    sample.compliance = Eigen::MatrixXd::Zero(9, 9);
    for (int mode = 1; mode <= 18; ++mode) {
      const double bL = free_beam_root(mode);
      Eigen::VectorXd shape = Eigen::VectorXd::Zero(9);
      for (int rope = 0; rope < 3; ++rope)
        shape[3 * rope + 2] = free_beam_mode(bL, place(rope) / length);
      sample.compliance += c / std::pow(bL, 4) * shape * shape.transpose();
    }
    const double middle =
        weight * (5.0 / 8 * by_middle + 0.5 / stiffness) / (by_middle + 1.5 / stiffness);
    const Eigen::VectorXd tension = tensions_at_rest(hang(sample));
    EXPECT_NEAR(tension[1] / middle, 1, 1e-4) << "flexibility " << flexibility;
    EXPECT_NEAR(tension[0], (weight - middle) / 2, 1e-4 * weight);
    EXPECT_NEAR(tension[2], tension[0], 1e-6 * weight);
  }
}

// A uniform beam that hangs from its middle on one upright rope of stiffness k vibrates upright
// where the beam's receptance there is -1/k. Of the free beam, with x = bL / 2, by its halves,
// whose slope vanishes in the middle (Bishop and Johnson 1960, The Mechanics of Vibration,
// chapter 7):
//   k (1 + cos x cosh x) = 2 EI b^3 (sin x cosh x + cos x sinh x).
// This is against six modes of the free beam and the compliance of 34 more, whose inertia is
// neglected: a frequency changes by about (omega / omega_13)^4. What the modes beyond have of the
// compliance, 8e-12 m/N, is 2e-6 of the rope's.
TEST(ElasticBody, AFreeBeamOnARopeVibratesAsItsReceptanceSays) {
  const double length = 8, slowest = 20;  // m, rad/s
  const double EI = std::pow(slowest * std::pow(length / free_beam_root(1), 2), 2) * mass / length;
  Sample sample{.ropes = 1, .modal_mass = mass};
  sample.compliance = Eigen::MatrixXd::Zero(3, 3);
  sample.shapes = Eigen::MatrixXd::Zero(3, 6);
  sample.frequencies.resize(6);
  const auto frequency = [&](int n) {
    return slowest * std::pow(free_beam_root(n) / free_beam_root(1), 2);
  };
  for (int i = 0; i < 40; ++i) {
    const int n = 2 * i + 1;  // the others stand still in the middle
    const double shape = free_beam_mode(free_beam_root(n), 0.5);
    if (i < 6) {
      sample.frequencies[i] = frequency(n);
      sample.shapes(2, i) = shape;
    } else {
      sample.compliance(2, 2) += shape * shape / (mass * std::pow(frequency(n), 2));
    }
  }
  const LiftSystem system = hang(sample);
  Eigen::VectorXd q = system.q_start();
  EquilibriumSolver solver(system);
  solver.solve(0, q);
  const std::vector<Mode> modes = linearise(system, 0, solver.workspace()).modes;

  const auto equation = [&](double x) {
    const double b = 2 * x / length;
    return stiffness * (1 / std::cosh(x) + std::cos(x)) -
           2 * EI * std::pow(b, 3) * (std::sin(x) + std::cos(x) * std::tanh(x));
  };
  int found = 0;
  for (double x = 0.1; found < 3; x += 0.01) {
    if (equation(x) * equation(x + 0.01) > 0) continue;
    double low = x, high = x + 0.01;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (equation(low) * equation(middle) > 0 ? low : high) = middle;
    }
    const double omega = std::sqrt(EI * length / mass) * std::pow(2 * low / length, 2);
    const auto nearest =
        std::min_element(modes.begin(), modes.end(), [&](const Mode& one, const Mode& other) {
          return std::abs(one.natural_frequency() - omega) <
                 std::abs(other.natural_frequency() - omega);
        });
    EXPECT_NEAR(nearest->natural_frequency() / omega, 1, 1e-6 + std::pow(omega / frequency(13), 4));
    double energy = 0;
    for (const ElasticModeMotion& motion : nearest->elastic_modes) energy += motion.energy_share;
    if (found == 2) {
      EXPECT_EQ(nearest->name, "beam: vibration in mode 2");
      EXPECT_GT(energy, 0.5);
    }
    EXPECT_NEAR(nearest->bodies.front().energy_share, 1, 1e-9);
    ++found;
  }
}

// With nothing that pulls at it a mode is an oscillator of one degree of freedom:
//   eta = eta0 exp(-zeta omega t) (cos wt + zeta omega / w sin wt),  w^2 = omega^2 (1 - zeta^2).
TEST(ElasticBody, AModeThatNoRopeFeelsDiesAwayAsAnOscillator) {
  const double omega = 20, zeta = 0.05, start = 1;
  Sample sample{
      .frequencies = Eigen::VectorXd::Constant(1, omega), .modal_damping = zeta, .modal_mass = 700};
  sample.compliance = Eigen::MatrixXd::Zero(9, 9);
  sample.shapes = Eigen::MatrixXd::Zero(9, 1);
  const LiftSystem system = hang(sample);
  Eigen::VectorXd q = system.q_start();
  EquilibriumSolver(system).solve(0, q);
  q[system.mechanism().elastic_modes()[0].q_index] = start;
  const History history = integrate(system, q, Eigen::VectorXd::Zero(system.mechanism().nv()),
                                    {.relative_tolerance = 1e-10, .sample_interval = 0.01})
                              .history;
  const ElasticModeHistory& mode = history.elastic_mode("mode 1");
  const double w = omega * std::sqrt(1 - zeta * zeta);
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    const double t = history.time[i], decay = start * std::exp(-zeta * omega * t);
    EXPECT_NEAR(mode.coordinate[i], decay * (std::cos(w * t) + zeta * omega / w * std::sin(w * t)),
                1e-7 * start);
    EXPECT_NEAR(mode.rate[i], -decay * omega * omega / w * std::sin(w * t), 1e-6 * start * omega);
    EXPECT_NEAR(mode.acceleration[i],
                -omega * omega * mode.coordinate[i] - 2 * zeta * omega * mode.rate[i],
                1e-12 * start * omega * omega);
  }
}

// Two bodies in space, joined by stretched ropes; one of them vibrates. What the ropes do to one
// they do to the other, at points that the vibration displaces; the modes have no momentum.
TEST(ElasticBody, AVibratingBodyOnRopesToAnotherKeepsMomentum) {
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  BodyDefinition beam{.name = "beam", .joint = {.kind = JointKind::free}, .mass = mass};
  beam.I_BBcm_B = Vector3(300, 5000, 5000).asDiagonal();
  BodyDefinition block = beam;
  block.name = "block";
  const BodyIndex body = builder.add_body(beam), other = builder.add_body(block);
  ElasticBody::Definition elastic{"beam", body, {}, coupled_compliance(3, 4e-6), {}, {}};
  elastic.shapes = Eigen::MatrixXd::NullaryExpr(
      9, 2, [](auto i, auto k) { return std::cos(1.0 + static_cast<double>(i * (k + 2))); });
  for (const double omega : {20.0, 45.0}) {
    elastic.modes.push_back(builder.add_elastic_mode({.name = std::to_string(omega),
                                                      .body = body,
                                                      .modal_mass = mass,
                                                      .angular_frequency = omega}));
  }
  const Mechanism mechanism = builder.build();
  std::vector<Rope> ropes;
  for (int i = 0; i < 3; ++i) {
    RopeDefinition rope;
    rope.name = std::to_string(i);
    rope.points = {{other, Vector3(i, 0.5 * i, -0.2)}, {body, Vector3(2.0 * i - 2, 0.3 * i, 0.5)}};
    rope.axial_stiffness = stiffness * rope_length;
    rope.unstretched_length =
        (Vector3(0, 0, rope_length) + rope.points[0].p_BoQ_B - rope.points[1].p_BoQ_B).norm() -
        0.05;
    ropes.emplace_back(mechanism, rope);
    elastic.ends.push_back({i, true});
  }
  Eigen::VectorXd q = mechanism.zero_configuration(), v = Eigen::VectorXd::Zero(mechanism.nv());
  q[mechanism.body(other).q_offset + 2] = rope_length;
  v << 0.02, -0.01, 0.03, 0.1, 0.2, -0.1, -0.05, 0.02, 0.01, -0.1, 0.3, 0.2, 0.1, -0.2;
  LiftDefinition definition{mechanism, ropes, {}, {}, OperationBuilder().build(2), q};
  definition.elastic_bodies.emplace_back(mechanism, ropes, elastic);
  const IntegrationResult result = integrate(LiftSystem(std::move(definition)), q, v,
                                             {.relative_tolerance = 1e-10, .sample_interval = 0.1});
  const auto momentum = [&](const Eigen::VectorXd& q_now, const Eigen::VectorXd& v_now) {
    Kinematics kinematics(mechanism);
    compute_kinematics(mechanism, q_now, v_now, kinematics);
    return calc_momentum(mechanism, kinematics);
  };
  const ForceVector before = momentum(q, v), after = momentum(result.q_end, result.v_end);
  EXPECT_LT((after.force - before.force).norm(), 1e-6 * before.force.norm());
  EXPECT_LT((after.moment - before.moment).norm(), 1e-6 * before.moment.norm());
  EXPECT_GT(result.history.elastic_modes[0].coordinate.cwiseAbs().maxCoeff(), 0.005);
  const EnergyHistory& energy = result.history.energy;
  const Eigen::VectorXd sum = energy.kinetic + energy.elastic;
  const double exchanged = energy.elastic.maxCoeff() - energy.elastic.minCoeff();
  EXPECT_LT((sum.array() - sum[0]).abs().maxCoeff(), 1e-6 * exchanged);
}

TEST(ElasticBody, SlackRopesLeaveTheirLoadToTheOthers) {
  Sample sample;
  sample.compliance = coupled_compliance(3, 4e-6);
  const LiftSystem system = hang(sample);
  LiftWorkspace w(system);
  w.q[2] = 20 - rope_length - 0.02;
  w.q[4] = 0;  // level; the rope in the middle is let out
  w.feeds[1].unstretched_length = rope_length + 0.5;
  calc_loads(system, 0, nullptr, w);
  EXPECT_EQ(w.rope_loads[1].tension, 0);
  EXPECT_LT(w.rope_loads[1].slack_indicator(), 0);
  EXPECT_GT(w.rope_loads[0].tension, 0);
  EXPECT_GT(w.rope_loads[2].tension, 0);
  // The same by declaration.
  const Eigen::Vector2d before(w.rope_loads[0].tension, w.rope_loads[2].tension);
  const Contacts contacts{1, 0, 1};
  calc_loads(system, 0, &contacts, w);
  EXPECT_EQ(before[0], w.rope_loads[0].tension);
  EXPECT_EQ(before[1], w.rope_loads[2].tension);
}

TEST(ElasticBody, TheRightHandSideDoesNotAllocate) {
  Sample sample{.damping_time = 0.02, .inclination = 1};
  sample.compliance = coupled_compliance(3, 4e-6);
  sample.frequencies = Eigen::Vector2d(20, 45);
  sample.shapes = Eigen::MatrixXd::Constant(9, 2, 0.01);
  const LiftSystem system = hang(sample);
  LiftWorkspace w(system);
  JacobianWorkspace workspace(system);
  Eigen::MatrixXd jacobian(system.state_size(), system.state_size());
  Eigen::VectorXd y(system.state_size()), rates(system.state_size());
  get_state(system, system.q_start(), Eigen::VectorXd::Zero(system.mechanism().nv()), y);
  const Contacts contacts(3, 1);
  calc_jacobian(system, 0, y, &contacts, w, workspace, jacobian);
  if (!blocklift::test::counts_allocations())
    GTEST_SKIP() << "sanitizers bring their own allocator";
  const long before = blocklift::test::allocations();
  calc_right_hand_side(system, 0, y, &contacts, w, rates);
  calc_right_hand_side(system, 0, y, nullptr, w, rates);
  calc_jacobian(system, 0, y, &contacts, w, workspace, jacobian);
  EXPECT_EQ(blocklift::test::allocations(), before);
}

TEST(ElasticBody, WhatCannotBeIsRefused) {
  Sample sample;
  sample.compliance = -Eigen::MatrixXd::Identity(9, 9);
  EXPECT_THROW(hang(sample), ModelError);
  sample.compliance = Eigen::MatrixXd::Identity(6, 6);
  EXPECT_THROW(hang(sample), ModelError);
  sample.compliance = Eigen::MatrixXd::Identity(9, 9);
  sample.compliance(0, 1) = 0.1;
  EXPECT_THROW(hang(sample), ModelError);
}

// A mode that no elastic body gives a shape would have no spring.
TEST(ElasticBody, EveryModeHasAShape) {
  Sample sample{.frequencies = Eigen::Vector2d(20, 45)};
  try {
    hang(sample);
    FAIL() << "modes of a rigid body";
  } catch (const ModelError& error) {
    EXPECT_STREQ(error.what(),
                 "elastic mode \"mode 1\" has its shape from 0 elastic bodies; one is due");
  }
}

}  // namespace
}  // namespace blocklift::dynamics
