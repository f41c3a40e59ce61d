// Forward dynamics, kinematics included: one evaluation of vdot from q, v and tau.
// Chains of 10 to 100 revolute joints and a floating base with five arms of six.
#include <random>

#include <benchmark/benchmark.h>

#include "dynamics/multibody/forward_dynamics.h"

namespace blocklift::dynamics {
namespace {

// Joints alternately about z and y, 1 kg, 1 m.
BodyDefinition link(int number, const std::string& parent, const Vector3& place) {
  BodyDefinition body;
  body.name = parent + "." + std::to_string(number);
  body.parent = parent;
  body.joint = {JointKind::revolute, number % 2 == 0 ? Vector3::UnitZ() : Vector3::UnitY()};
  body.X_PJ = Pose::translation(place);
  body.mass = 1;
  body.p_BoBcm_B = {0.5, 0.03, -0.02};
  body.I_BBcm_B << 0.02, 0.002, -0.001,  //
      0.002, 0.09, 0.003,                //
      -0.001, 0.003, 0.085;
  return body;
}

void add_chain(MechanismBuilder& builder, int count, std::string parent, Vector3 place) {
  for (int i = 0; i < count; ++i) {
    const BodyDefinition body = link(i, parent, place);
    builder.add_body(body);
    parent = body.name;
    place = Vector3::UnitX();
  }
}

void evaluate(benchmark::State& state, const Mechanism& mechanism) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto values = [&](int n) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(engine); }).eval();
  };
  Eigen::VectorXd q = values(mechanism.nq());
  mechanism.normalise(q);
  const Eigen::VectorXd v = values(mechanism.nv());
  Eigen::VectorXd tau = values(mechanism.nv());
  Eigen::VectorXd vdot(mechanism.nv());
  Kinematics kinematics(mechanism);
  ForwardDynamicsWorkspace workspace(mechanism);
  const std::vector<ForceVector> none(static_cast<std::size_t>(mechanism.body_count()),
                                      ForceVector::zero());
  for (auto _ : state) {
    compute_kinematics(mechanism, q, v, kinematics);
    compute_forward_dynamics(mechanism, kinematics, v, none, workspace, tau, vdot);
    benchmark::DoNotOptimize(vdot.data());
  }
}

void forward_dynamics_chain(benchmark::State& state) {
  MechanismBuilder builder;
  add_chain(builder, static_cast<int>(state.range(0)), std::string(world_name), Vector3::Zero());
  evaluate(state, builder.build());
}
BENCHMARK(forward_dynamics_chain)
    ->Arg(10)
    ->Arg(20)
    ->Arg(50)
    ->Arg(100)
    ->Unit(benchmark::kMicrosecond);

void forward_dynamics_floating_tree(benchmark::State& state) {
  MechanismBuilder builder;
  BodyDefinition base;
  base.name = "base";
  base.joint.kind = JointKind::free;
  base.mass = 10;
  base.I_BBcm_B = Vector3(1, 1, 1).asDiagonal();
  builder.add_body(base);
  for (int arm = 0; arm < 5; ++arm) {
    BodyDefinition mount;
    mount.name = "mount" + std::to_string(arm);
    mount.parent = "base";
    mount.mass = 0;
    mount.X_PJ = {rotation_about(Vector3::UnitZ(), 2 * M_PI * arm / 5), Vector3::Zero()};
    builder.add_body(mount);
    add_chain(builder, 6, mount.name, 0.3 * Vector3::UnitX());
  }
  evaluate(state, builder.build());
}
BENCHMARK(forward_dynamics_floating_tree)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace blocklift::dynamics

BENCHMARK_MAIN();
