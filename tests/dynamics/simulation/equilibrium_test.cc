#include "dynamics/simulation/equilibrium.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/linearisation.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using examples::g;

/// A beam (free body) of 10 t on vertical ropes of given places and unstretched lengths, all of
/// k = 1 MN/m, held at the height 10 m.
struct BeamOnRopes {
  std::vector<double> x;
  std::vector<double> length;
  std::vector<SupportPad> supports = {};
  double hoisted = 0.0;  ///< m, by all winches from 0 s on
  double start_height = 0.0;

  LiftSystem build() const {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -g});
    builder.add_body({.name = "beam",
                      .joint = {.kind = JointKind::free},
                      .mass = 10e3,
                      .I_BBcm_B = Vector3(1e3, 20e3, 20e3).asDiagonal()});
    Mechanism mechanism = builder.build();
    std::vector<Rope> ropes;
    OperationBuilder operation;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::string name = "H" + std::to_string(i + 1);
      ropes.emplace_back(mechanism,
                         RopeDefinition{.name = name,
                                        .points = {{world_index, {x[i], 0, 10}}, {1, {x[i], 0, 0}}},
                                        .axial_stiffness = 1e6 * length[i],
                                        .damping_time = 0.02,
                                        .unstretched_length = length[i]});
      operation.add_winch(name, static_cast<int>(i), length[i]);
      if (hoisted != 0.0) operation.add_move(name, {0.0, -hoisted, {0.1, 0.1, 0.2}});
    }
    const Operation built = operation.build(20.0);
    Eigen::VectorXd q = mechanism.zero_configuration();
    q[2] = start_height;
    return LiftSystem({.mechanism = std::move(mechanism),
                       .ropes = std::move(ropes),
                       .supports = supports,
                       .elements = {},
                       .operation = built,
                       .q_start = q,
                       .v_start = {}});
  }
};

Eigen::VectorXd tensions(const LiftWorkspace& w) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(w.rope_loads.size()));
  for (std::size_t i = 0; i < w.rope_loads.size(); ++i) {
    result[i] = w.rope_loads[i].tension;
  }
  return result;
}

TEST(Equilibrium, TwoRopesShareByTheLever) {
  const LiftSystem lift = BeamOnRopes{{-1, 3}, {10, 10}, {}, 0.0, 0.0}.build();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  const Eigen::VectorXd T = tensions(solver.workspace());
  // The beam hangs a little oblique, so each lever arm shrinks alike: shares stay 3/4 and 1/4.
  EXPECT_NEAR(T.sum(), 10e3 * g, 5e-5 * 10e3 * g);
  EXPECT_NEAR(T[0] / T[1], 3.0, 2e-3);
  EXPECT_NEAR(T[0] / 1e6, solver.workspace().rope_loads[0].elongation(), 1e-9);
}

TEST(Equilibrium, RopeTooLongHangsSlack) {
  const LiftSystem lift = BeamOnRopes{{-2, 0, 2}, {10, 10.5, 10}, {}, 0.0, 0.0}.build();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  const Eigen::VectorXd T = tensions(solver.workspace());
  EXPECT_NEAR(T[0], 5e3 * g, 1e-6 * 5e3 * g);
  EXPECT_EQ(T[1], 0.0);
  EXPECT_NEAR(T[2], 5e3 * g, 1e-6 * 5e3 * g);
}

// All ropes slack and the beam tilted at the start: it falls into them.
TEST(Equilibrium, FindsItsWayFromARoughGuess) {
  const LiftSystem lift = BeamOnRopes{{-2, 2}, {10, 10}, {}, 0.0, 3.0}.build();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  q.tail<4>() = quaternion_exponential({0.1, 0.3, 0.2});
  q[0] = 0.5;
  solver.solve(0.0, q);
  const Eigen::VectorXd T = tensions(solver.workspace());
  EXPECT_NEAR(T.sum(), 10e3 * g, 1e-3 * 10e3 * g);
  EXPECT_LT(q[2], 0.0);
}

/// A load of 5 t on one rope from 10 m above its pin, in wind along +x on a flat area whose centre
/// of pressure is 0.5 m beside its centre of mass; drawn at a heading.
LiftSystem load_in_wind(double speed, double heading) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  builder.add_body({.name = "load",
                    .joint = {.kind = JointKind::free},
                    .mass = 5e3,
                    .I_BBcm_B = Vector3(4e3, 6e3, 8e3).asDiagonal()});
  Mechanism mechanism = builder.build();
  std::vector<Rope> ropes;
  ropes.emplace_back(mechanism,
                     RopeDefinition{.name = "sling",
                                    .points = {{world_index, {0, 0, 12}}, {1, {0, 0, 2}}},
                                    .axial_stiffness = 1e8,
                                    .unstretched_length = 10});
  ForceElements elements;
  std::get<std::vector<WindArea>>(elements).emplace_back(
      Wind::level(speed, 0), WindArea::Definition{.name = "side",
                                                  .centre_of_pressure = {1, {0, 0.5, 0}},
                                                  .area = 10,
                                                  .coefficient = 1.2,
                                                  .normal_B = Vector3::UnitX()});
  Eigen::VectorXd q = mechanism.zero_configuration();
  q.tail<4>() = quaternion_exponential({0, 0, heading});
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .supports = {},
                     .elements = std::move(elements),
                     .operation = OperationBuilder().build(1.0),
                     .q_start = q,
                     .v_start = {}});
}

// What hangs on one point turns its edge to the wind, unless its heading is held: then the wind
// presses on it, sideways by F = 1/2 rho C A U^2 cos^2 of the heading.
TEST(Equilibrium, HeldHeadingFeelsTheWind) {
  for (const double heading : {0.0, 0.4, -1.0, 3.0}) {
    const LiftSystem lift = load_in_wind(15, heading);
    const Matrix3 R_WB(Eigen::AngleAxisd(heading, Vector3::UnitZ()));
    EquilibriumSolver solver(lift, {.held_heading = HeldHeading{1, R_WB}});
    Eigen::VectorXd q = lift.q_start();
    solver.solve(0.0, q);
    const LiftWorkspace& w = solver.workspace();
    const Vector3 x_W = w.kinematics.X_WB[1].R.col(0);
    EXPECT_NEAR(std::remainder(std::atan2(x_W.y(), x_W.x()) - heading, 2 * M_PI), 0, 1e-3);
    const Vector3 force = 0.5 * 1.25 * 1.2 * 10 * 15 * 15 * std::abs(x_W.x()) * x_W.x() * x_W;
    const Vector3 pull =
        w.rope_loads[0].tension *
        Vector3(-q.head<3>() - w.kinematics.X_WB[1].R * Vector3(0, 0, 2) + Vector3(0, 0, 12))
            .normalized();
    EXPECT_LT((pull + force - Vector3(0, 0, 5e3 * g)).norm(), 1e-5 * 5e3 * g) << heading;
    // The couple is among the loads, so that these balance.
    EXPECT_LT(w.loads.F_Bo_W[1].moment.norm(), 1e-6 * 5e3 * g) << heading;
  }
}

TEST(Equilibrium, HeldHeadingIsThatOfABodyOnAFreeJoint) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = 10e3});
  const LiftSystem lift({.mechanism = builder.build(),
                         .ropes = {},
                         .supports = {},
                         .elements = {},
                         .operation = OperationBuilder().build(1.0),
                         .q_start = Vector3::Zero(),
                         .v_start = {}});
  EXPECT_THAT(([&] { EquilibriumSolver(lift, {.held_heading = HeldHeading{.body = 1}}); }),
              ThrowsMessage<ModelError>(HasSubstr("must have a free joint")));
}

// Wind that would turn a load round is not what tips it over: the pin is 2 m above its centre.
TEST(Equilibrium, TurningInTheWindIsNoTipping) {
  const LiftSystem lift = load_in_wind(2, M_PI / 2);
  EquilibriumSolver solver(lift, {.held_heading = HeldHeading{
                                      1, Matrix3(Eigen::AngleAxisd(M_PI / 2, Vector3::UnitZ()))}});
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  TangentMatrices tangent(lift);
  EXPECT_NEAR(calc_righting_height(lift, 0.0, solver.workspace(), 1, tangent, true), 2, 0.01);
}

// A V of two ropes: T = m g / (2 cos a), with the angle that the stretched ropes have.
TEST(Equilibrium, RopesInAVee) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = 10e3});
  Mechanism mechanism = builder.build();
  std::vector<Rope> ropes;
  for (const double x : {-3.0, 3.0}) {
    ropes.emplace_back(mechanism, RopeDefinition{.name = x < 0 ? "left" : "right",
                                                 .points = {{0, {x, 0, 0}}, {1, Vector3::Zero()}},
                                                 .axial_stiffness = 1e6,
                                                 .unstretched_length = 5.0});
  }
  const LiftSystem lift({.mechanism = mechanism,
                         .ropes = ropes,
                         .supports = {},
                         .elements = {},
                         .operation = OperationBuilder().build(1.0),
                         .q_start = Vector3(1, 2, -3),
                         .v_start = {}});
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  const double length = std::hypot(3.0, q[2]);
  const double tension = 10e3 * g / 2.0 * length / -q[2];
  EXPECT_NEAR(q[0], 0.0, 1e-8);
  EXPECT_NEAR(q[1], 0.0, 1e-8);
  EXPECT_NEAR(solver.workspace().rope_loads[0].tension, tension, 1e-8 * tension);
  EXPECT_NEAR(tension, 1e6 / 5.0 * (length - 5.0), 1e-8 * tension);
}

std::vector<SupportPad> cradle() {
  std::vector<SupportPad> pads;
  for (const double x : {-2.0, 2.0}) {
    for (const double y : {-1.0, 1.0}) {
      pads.emplace_back(SupportPad::Definition{.name = "pad " + std::to_string(pads.size() + 1),
                                               .point = {1, {x, y, -1}},
                                               .p_WG = {x, y, -1},
                                               .stiffness = 50e6,
                                               .damping = 1e6,
                                               .friction_coefficient = 0.4,
                                               .tangential_stiffness = 20e6,
                                               .tangential_damping = 1e5});
    }
  }
  return pads;
}

// From the cradle into the ropes, statically and dynamically: ground and ropes carry the weight
// together, at the end the ropes alone.
TEST(Equilibrium, BeamIsLiftedOffItsCradle) {
  const LiftSystem lift = BeamOnRopes{{-2, 2}, {10.05, 10.05}, cradle(), 0.5, 0.0}.build();
  const History sweep = static_sweep(lift, sample_times(20.0, 0.5), lift.q_start());
  const auto ground = [](const History& history, Eigen::Index i) {
    double sum = 0.0;
    for (const SupportHistory& pad : history.supports) sum += pad.normal_force[i];
    return sum;
  };
  for (Eigen::Index i = 0; i < sweep.sample_count(); ++i) {
    const double carried = ground(sweep, i) + sweep.ropes[0].tension[i] + sweep.ropes[1].tension[i];
    EXPECT_NEAR(carried, 10e3 * g, 1e-6 * 10e3 * g) << "at " << sweep.time[i] << " s";
  }
  const Eigen::Index last = sweep.sample_count() - 1;
  EXPECT_EQ(sweep.ropes[0].tension[0], 0.0);
  EXPECT_EQ(ground(sweep, last), 0.0);

  const IntegrationResult run =
      integrate(lift, (Eigen::VectorXd(7) << sweep.bodies[0].pose.row(0).transpose()).finished(),
                lift.v_start(), {.relative_tolerance = 1e-7});
  EXPECT_GE(run.statistics.contact_changes, 6);  // two ropes take up, four pads let go
  const History& history = run.history;
  EXPECT_NEAR(history.bodies[0].pose(history.sample_count() - 1, 2), sweep.bodies[0].pose(last, 2),
              1e-4);
  const EnergyHistory& e = history.energy;
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd work = e.drive_work + e.winch_work - e.dissipated;
  EXPECT_LT((energy - energy[0] - work).abs().maxCoeff(), 1e-4 * 10e3 * g);
}

TEST(Equilibrium, SweepOfTheTwoGoliathsCarriesTheWeight) {
  const LiftSystem lift = test::two_goliaths();
  const History sweep =
      static_sweep(lift, sample_times(lift.operation().duration(), 10.0), lift.q_start());
  const WindArea& side = std::get<std::vector<WindArea>>(lift.elements()).back();
  const Wind wind = Wind::level(8.0, 0.5);
  const double half_density_area =
      0.5 * wind.air_density * side.definition().coefficient * side.definition().area;
  const BodyHistory& block = sweep.body("block");
  for (Eigen::Index i = 0; i < sweep.sample_count(); ++i) {
    const Vector3 n = block.X_WB(i).R * *side.definition().normal_B;
    const double u = wind.velocity_W.dot(n);
    Vector3 force = Vector3(0, 0, -860e3 * g) + half_density_area * std::abs(u) * u * n;
    for (const RopeHistory& rope : sweep.ropes) {
      if (rope.name.starts_with("sling")) force += rope.last_force.row(i).transpose();
    }
    EXPECT_LT(force.norm(), 1e-8 * 860e3 * g) << "at " << sweep.time[i] << " s";
  }
}

// A sweep goes on with the stiffness of earlier instants: where it arrives is what a solver that
// knows nothing of them finds for each instant by itself, from some way off.
TEST(Equilibrium, SweepIsWhatEachInstantGivesAlone) {
  const LiftSystem lift = test::two_goliaths();
  const Eigen::VectorXd beside = Eigen::VectorXd::Constant(lift.mechanism().nv(), 0.01);
  int compared = 0;
  const auto compare = [&](Eigen::Index sample, double t, LiftWorkspace& w) {
    if (sample % 50 != 0) return;
    EquilibriumSolver alone(lift);
    Eigen::VectorXd q(w.q.size());
    lift.mechanism().integrate(w.q, beside, 1.0, q);
    alone.solve(t, q);
    const Eigen::VectorXd difference = tensions(w) - tensions(alone.workspace());
    EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-8 * 860e3 * g) << "at " << t << " s";
    ++compared;
  };
  static_sweep(lift, sample_times(lift.operation().duration(), 1.0), lift.q_start(), {}, {},
               compare);
  EXPECT_GT(compared, 5);
}

TEST(Equilibrium, NoneSaysWhenWhoAndWhatToTry) {
  const LiftSystem lift = BeamOnRopes{{}, {}, {}, 0.0, 0.0}.build();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  EXPECT_THAT(
      [&] { solver.solve(4.0, q); },
      ThrowsMessage<SimulationError>(AllOf(HasSubstr("no static equilibrium"), HasSubstr("t = 4 s"),
                                           HasSubstr("beam"), HasSubstr("try a start position"))));
}

TEST(History, LargestTensionsComeWithTheOthers) {
  const LiftSystem lift = BeamOnRopes{{-1, 3}, {10, 10}, {}, 0.3, 0.0}.build();
  const History sweep = static_sweep(lift, sample_times(20.0, 1.0), lift.q_start());
  const std::vector<LinkedMaximum> maxima = find_largest_tensions(sweep);
  ASSERT_EQ(maxima.size(), 2u);
  const LinkedMaximum& first = maxima[0];
  EXPECT_EQ(first.tension, sweep.ropes[0].tension.maxCoeff());
  EXPECT_EQ(first.tensions[0], first.tension);
  EXPECT_EQ(first.tensions[1], sweep.ropes[1].tension[first.sample]);
  EXPECT_THAT([&] { sweep.rope("H9"); }, ThrowsMessage<ModelError>(HasSubstr("H1, H2")));
}

}  // namespace
}  // namespace blocklift::dynamics
