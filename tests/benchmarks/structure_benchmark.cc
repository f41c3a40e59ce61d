// The structural stage on the hull block: seconds of assembly, factorisation and unit responses as
// counters, then a load case's evaluation. Run alone on the machine; OpenBLAS takes all cores.
#include <benchmark/benchmark.h>

#include "structure/response/unit_responses.h"
#include "structure/stress/stress.h"
#include "tests/structure/block_models.h"
#include "tests/structure/hull_block.h"

namespace {

using namespace blocklift::structure;

void generate_mesh(benchmark::State& state) {
  const BlockDescription block = testing::hull_block();
  for (auto unused : state) benchmark::DoNotOptimize(generate_shell_mesh(block));
}
BENCHMARK(generate_mesh)->Unit(benchmark::kMillisecond);

void unit_responses(benchmark::State& state) {
  for (auto unused : state) {
    const ElasticModel model = testing::make_elastic_model(testing::hull_block(), 3);
    const UnitResponses responses(model);
    const SolutionTiming& timing = responses.timing();
    state.counters["unknowns"] = model.space().unknowns();
    state.counters["assembly_s"] = timing.assembly_s;
    state.counters["analysis_s"] = timing.analysis_s;
    state.counters["factorisation_s"] = timing.factorisation_s;
    state.counters["solve_s"] = timing.solve_s;
    state.counters["factor_GB"] = timing.factor_bytes / 1e9;
    state.counters["assembly/factorisation"] = timing.assembly_s / timing.factorisation_s;
  }
}
BENCHMARK(unit_responses)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

void evaluate_load_case(benchmark::State& state) {
  BlockDescription block = testing::hull_block();
  const ElasticModel model = testing::make_elastic_model(block, 2);
  const UnitResponses responses(model);
  const StressRecovery recovery(responses);
  LoadCase load_case{"pull", std::vector<Vector3>(6, Vector3(0, 0, 1.4e6)), {}};
  for (auto unused : state) benchmark::DoNotOptimize(recovery.evaluate(load_case));
}
BENCHMARK(evaluate_load_case)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
