// Mechanisms with loops: constrained dynamics, projection, and whole runs of Andrews' squeezer.
#include <benchmark/benchmark.h>

#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/loop_projection.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/simulation/sample_mechanisms.h"

namespace blocklift::dynamics {
namespace {

// A chain of n revolute joints about z and y in turn, its end held by a spherical loop: n
// velocities, three rows.
Mechanism closed_chain(int n) {
  MechanismBuilder builder;
  std::string parent(world_name);
  for (int i = 0; i < n; ++i) {
    BodyDefinition body;
    body.name = "link" + std::to_string(i + 1);
    body.parent = parent;
    body.joint = {JointKind::revolute, i % 2 == 0 ? Vector3::UnitZ() : Vector3::UnitY()};
    if (i > 0) body.X_PJ.p = Vector3(1, 0, 0);
    body.mass = 1.0;
    body.p_BoBcm_B = Vector3(0.5, 0, 0);
    body.I_BBcm_B = Vector3(0.01, 0.1, 0.1).asDiagonal();
    builder.add_body(body);
    parent = body.name;
  }
  LoopDefinition end;
  end.name = "end";
  end.kind = LoopKind::spherical;
  end.first = parent;
  end.X_FirstK.p = Vector3(1, 0, 0);
  end.X_SecondK.p = Vector3(0.7 * n, 0, 0);
  end.second = world_name;
  builder.add_loop(end);
  return builder.build();
}

void constrained_dynamics(benchmark::State& state, const Mechanism& mechanism, Eigen::VectorXd q) {
  assemble(mechanism, q);
  Eigen::VectorXd v = Eigen::VectorXd::Ones(mechanism.nv());
  LoopProjector projector(mechanism);
  projector.look(q);
  projector.project_velocities(v);
  const LoopRows rows = projector.independent_rows();
  Kinematics kinematics(mechanism);
  ConstrainedDynamicsWorkspace w(mechanism);
  const std::vector<ForceVector> forces(static_cast<std::size_t>(mechanism.body_count()),
                                        ForceVector::zero());
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(mechanism.nv());
  Eigen::VectorXd vdot = tau;
  for (auto _ : state) {
    compute_kinematics(mechanism, q, v, kinematics);
    compute_constrained_dynamics(mechanism, kinematics, q, v, forces, &rows, w, tau, vdot);
    benchmark::DoNotOptimize(vdot.data());
  }
}

void closed_chain_dynamics(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  constrained_dynamics(state, closed_chain(n), Eigen::VectorXd::Constant(n, 0.3));
}
BENCHMARK(closed_chain_dynamics)->Arg(10)->Arg(20)->Arg(50)->Unit(benchmark::kMicrosecond);

void andrews_dynamics(benchmark::State& state) {
  constrained_dynamics(state, test::AndrewsSqueezer{LoopKind::revolute}.build(),
                       test::AndrewsSqueezer::q_start());
}
BENCHMARK(andrews_dynamics)->Unit(benchmark::kMicrosecond);

void andrews_projection(benchmark::State& state) {
  const Mechanism mechanism = test::AndrewsSqueezer{LoopKind::revolute}.build();
  LoopProjector projector(mechanism);
  const Eigen::VectorXd start = test::AndrewsSqueezer::q_start();
  Eigen::VectorXd q = start;
  Eigen::VectorXd v = Eigen::VectorXd::Zero(mechanism.nv());
  projector.look(q);
  for (auto _ : state) {
    q = start;
    q[0] += 1e-8;
    benchmark::DoNotOptimize(projector.project_positions(q));
    benchmark::DoNotOptimize(projector.project_velocities(v));
  }
}
BENCHMARK(andrews_projection)->Unit(benchmark::kMicrosecond);

// 0.03 s to 1e-8 rad: the counters tell the error and what it cost.
void andrews_run(benchmark::State& state, LoopKind kind, double tolerance) {
  const LiftSystem system = test::andrews(kind);
  IntegrationStatistics statistics;
  double error = 0.0;
  for (auto _ : state) {
    const IntegrationResult run =
        integrate(system, system.q_start(), system.v_start(),
                  {.relative_tolerance = tolerance, .sample_interval = 0.03, .works = false});
    statistics = run.statistics;
    error = (run.q_end - test::andrews_q_end()).lpNorm<Eigen::Infinity>();
  }
  state.counters["error_rad"] = error;
  state.counters["steps"] = static_cast<double>(statistics.steps);
  state.counters["right_hand_sides"] = static_cast<double>(statistics.right_hand_sides);
  state.counters["jacobians"] = static_cast<double>(statistics.jacobians);
}
BENCHMARK_CAPTURE(andrews_run, point_on_line, LoopKind::point_on_line, 1e-12)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(andrews_run, revolute, LoopKind::revolute, 3e-13)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace blocklift::dynamics

BENCHMARK_MAIN();
