// Force of the water on a barge of 110 x 46 x 7.5 m, one evaluation: still water, one regular wave,
// an irregular sea of 200 components. Argument: panel size in decimetres.
#include <benchmark/benchmark.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/loads/hull_force.h"
#include "dynamics/marine/waves/wave_spectrum.h"

namespace blocklift::dynamics {
namespace {

enum class SeaKind { still, regular, irregular };

WaveField waves_of(SeaKind kind) {
  switch (kind) {
    case SeaKind::still:
      return WaveField();
    case SeaKind::regular:
      return {Water{}, {{0.5, 0.628, 0.785, 0}}};
    case SeaKind::irregular:
      return realise(WaveSpectrum::jonswap(2, 8), {}, {.components = 200});
  }
  return WaveField();
}

void evaluate(benchmark::State& state, SeaKind kind) {
  MechanismBuilder builder;
  builder.add_body({.name = "barge",
                    .joint = {.kind = JointKind::free},
                    .mass = 1.0,
                    .I_BBcm_B = Matrix3::Identity()});
  const Mechanism mechanism = builder.build();
  const double size = 0.1 * static_cast<double>(state.range(0));
  const auto hull = std::make_shared<const HullClusters>(
      make_barge({.length = 110, .breadth = 46, .depth = 7.5, .bilge_radius = 1},
                 PanelDivision::of_size(size, 110, 46, 7.5)));
  const HullForce force({"barge", 1, hull, std::make_shared<const Sea>(Sea{waves_of(kind), {}})});
  Eigen::VectorXd q = mechanism.zero_configuration();
  q.tail<4>() << 1, 0.03, 0.02, 0.4;
  q[2] = -4;
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
  Kinematics kinematics(mechanism);
  compute_kinematics(mechanism, q, v, kinematics);
  double time = 0;
  for (auto _ : state) {
    ForceVector F = force.calc_force({time, q, v, kinematics});
    benchmark::DoNotOptimize(F);
    time += 0.01;
  }
  state.counters["panels"] = hull->hull().panel_count();
}

BENCHMARK_CAPTURE(evaluate, still, SeaKind::still)->Arg(20)->Arg(40)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(evaluate, regular, SeaKind::regular)
    ->Arg(20)
    ->Arg(40)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(evaluate, irregular, SeaKind::irregular)
    ->Arg(20)
    ->Arg(40)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace blocklift::dynamics

BENCHMARK_MAIN();
