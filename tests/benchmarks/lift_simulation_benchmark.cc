// One right-hand side of the two-goliath lift, and whole simulations: the 860 t block hoisted for
// 120 s, the turn-over statically and dynamically. "real_time" is simulated over elapsed time.
#include <benchmark/benchmark.h>

#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

void right_hand_side_of_two_goliaths(benchmark::State& state) {
  const LiftSystem lift = samples::two_goliaths();
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

void report(benchmark::State& state, const LiftSystem& lift, const IntegrationStatistics& cost) {
  state.counters["steps"] = static_cast<double>(cost.steps);
  state.counters["right_hand_sides"] = static_cast<double>(cost.right_hand_sides);
  state.counters["jacobians"] = static_cast<double>(cost.jacobians);
  state.counters["real_time"] = benchmark::Counter(lift.operation().duration(),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}

void block_hoisted_on_six_ropes(benchmark::State& state) {
  const LiftSystem lift = samples::block_on_six_ropes();
  IntegrationStatistics cost;
  for (auto _ : state) {
    cost = integrate(lift, lift.q_start(), lift.v_start(), {.relative_tolerance = 1e-6}).statistics;
  }
  report(state, lift, cost);
}
BENCHMARK(block_hoisted_on_six_ropes)->Unit(benchmark::kMillisecond);

void turn_over_in_time(benchmark::State& state) {
  const LiftSystem lift = samples::two_goliaths();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  IntegrationStatistics cost;
  for (auto _ : state) {
    cost = integrate(lift, q, lift.v_start(), {.relative_tolerance = 1e-6}).statistics;
  }
  report(state, lift, cost);
}
BENCHMARK(turn_over_in_time)->Unit(benchmark::kMillisecond);

void turn_over_static_sweep(benchmark::State& state) {
  const LiftSystem lift = samples::two_goliaths();
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
