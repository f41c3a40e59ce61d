// One right-hand side of the two-goliath lift and of a block that gives way, and whole simulations:
// the 860 t block hoisted for 120 s, the turn-over statically and dynamically. "real_time" is
// simulated over elapsed time.
#include <benchmark/benchmark.h>

#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

void right_hand_side_of_two_goliaths(benchmark::State& state) {
  const LiftSystem lift = test::two_goliaths();
  LiftWorkspace w(lift);
  Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
  get_state(lift, lift.q_start(), lift.v_start(), y);
  const Contacts contacts = find_contacts(lift, 0.0, y, w);
  double t = 0.0;
  for (auto _ : state) {
    t = t < 900.0 ? t + 0.1 : 0.0;
    calc_right_hand_side(lift, t, y, &contacts, w, ydot);
    benchmark::DoNotOptimize(ydot.data());
  }
}
BENCHMARK(right_hand_side_of_two_goliaths)->Unit(benchmark::kMicrosecond);

enum class Modes { none, elastic, bodies };

// A block on four ropes whose lugs give way; with ten elastic modes, or beside as many bodies on
// prismatic joints and springs, which are not coupled to it.
LiftSystem block_that_gives_way(Modes kind) {
  constexpr double mass = 860e3;
  MechanismBuilder builder;
  BodyDefinition block{.name = "block", .joint = {.kind = JointKind::free}, .mass = mass};
  block.I_BBcm_B = mass * Vector3(30, 56, 70).asDiagonal();
  const BodyIndex body = builder.add_body(block);
  ElasticBody::Definition elastic{"block", body, {}, 1e-9 * Eigen::MatrixXd::Identity(12, 12),
                                  {},      {}};
  for (int k = 0; k < 10; ++k) {
    const std::string name = "mode " + std::to_string(k + 1);
    if (kind == Modes::elastic)
      elastic.modes.push_back(builder.add_elastic_mode(
          {.name = name, .body = body, .modal_mass = mass, .angular_frequency = 30.0 + 8 * k}));
    if (kind == Modes::bodies)
      builder.add_body({.name = name, .joint = {.kind = JointKind::prismatic}, .mass = mass});
  }
  elastic.shapes =
      Eigen::MatrixXd::Constant(12, static_cast<Eigen::Index>(elastic.modes.size()), 0.5);
  const Mechanism mechanism = builder.build();
  ForceElements elements;
  for (BodyIndex i = body + 1; i < mechanism.body_count(); ++i) {
    std::get<std::vector<JointSpring>>(elements).emplace_back(
        mechanism, JointSpring::Definition{.name = mechanism.body(i).name,
                                           .body = i,
                                           .stiffness = mass * 900,
                                           .free_coordinate = 0});
  }
  std::vector<Rope> ropes;
  for (int i = 0; i < 4; ++i) {
    const Vector3 lug(i % 2 == 0 ? 10 : -10, i < 2 ? 6 : -6, 5);
    RopeDefinition rope;
    rope.name = "R" + std::to_string(i + 1);
    rope.points = {{world_index, Vector3(0.8 * lug.x(), 0.8 * lug.y(), 40)}, {body, lug}};
    rope.axial_stiffness = 2e9;
    rope.unstretched_length = 34;
    ropes.emplace_back(mechanism, rope);
    elastic.ends.push_back({i, true});
  }
  LiftDefinition definition{
      mechanism, ropes, {}, elements, OperationBuilder().build(10), mechanism.zero_configuration()};
  definition.elastic_bodies.emplace_back(mechanism, ropes, elastic);
  return LiftSystem(std::move(definition));
}

void right_hand_side_of_a_block_that_gives_way(benchmark::State& state) {
  const LiftSystem lift = block_that_gives_way(static_cast<Modes>(state.range(0)));
  LiftWorkspace w(lift);
  Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
  get_state(lift, lift.q_start(), lift.v_start(), y);
  const Contacts contacts(4, 1);
  for (auto _ : state) {
    calc_right_hand_side(lift, 0, y, &contacts, w, ydot);
    benchmark::DoNotOptimize(ydot.data());
  }
}
BENCHMARK(right_hand_side_of_a_block_that_gives_way)
    ->ArgName("none_elastic_bodies")
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMicrosecond);

void report(benchmark::State& state, const LiftSystem& lift, const IntegrationStatistics& cost) {
  state.counters["steps"] = static_cast<double>(cost.steps);
  state.counters["right_hand_sides"] = static_cast<double>(cost.right_hand_sides);
  state.counters["jacobians"] = static_cast<double>(cost.jacobians);
  state.counters["real_time"] = benchmark::Counter(lift.operation().duration(),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}

void block_hoisted_on_six_ropes(benchmark::State& state) {
  const LiftSystem lift = examples::block_on_six_ropes();
  IntegrationStatistics cost;
  for (auto _ : state) {
    cost = integrate(lift, lift.q_start(), lift.v_start(), {.relative_tolerance = 1e-6}).statistics;
  }
  report(state, lift, cost);
}
BENCHMARK(block_hoisted_on_six_ropes)->Unit(benchmark::kMillisecond);

void integrate_turn_over(benchmark::State& state, const IntegrationSettings& settings) {
  const LiftSystem lift = test::two_goliaths();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  IntegrationStatistics cost;
  for (auto _ : state) cost = integrate(lift, q, lift.v_start(), settings).statistics;
  report(state, lift, cost);
}

void turn_over_in_time(benchmark::State& state) {
  integrate_turn_over(state, {.relative_tolerance = 1e-6});
}
BENCHMARK(turn_over_in_time)->Unit(benchmark::kMillisecond);

// As a study's member whose figures are tensions.
void turn_over_in_time_for_its_tensions(benchmark::State& state) {
  integrate_turn_over(
      state, {.relative_tolerance = 1e-6, .works = false, .recording = Recording::tensions()});
}
BENCHMARK(turn_over_in_time_for_its_tensions)->Unit(benchmark::kMillisecond);

void turn_over_static_sweep(benchmark::State& state) {
  const LiftSystem lift = test::two_goliaths();
  const Eigen::VectorXd times = sample_times(lift.operation().duration(), 1.0);
  for (auto _ : state) {
    const History sweep = static_sweep(lift, times, lift.q_start());
    benchmark::DoNotOptimize(sweep.time.data());
  }
}
BENCHMARK(turn_over_static_sweep)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace blocklift::dynamics

BENCHMARK_MAIN();
