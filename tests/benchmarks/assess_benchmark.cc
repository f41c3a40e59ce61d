// The whole way of the shipped turn-over, stage by stage: what a user waits for.
#include <benchmark/benchmark.h>

#include "pipeline/assessment/assess.h"

namespace blocklift::pipeline {
namespace {

void assess_goliath_turnover(benchmark::State& state) {
  for (auto _ : state) {
    const Assessment assessment =
        assess(read_lift_case(BLOCKLIFT_CASES "/goliath-turnover"), [](auto&&...) {});
    const structure::SolutionTiming& solution = assessment.block.responses->timing();
    state.counters["times_real_time"] = assessment.lift->simulated_s() / assessment.lift->dynamic_s;
    state.counters["static_s"] = assessment.lift->static_s;
    state.counters["dynamic_s"] = assessment.lift->dynamic_s;
    state.counters["assembly_s"] = solution.assembly_s;
    state.counters["factorisation_s"] = solution.factorisation_s;
    state.counters["assembly_over_factorisation"] = solution.assembly_s / solution.factorisation_s;
    state.counters["solve_s"] = solution.solve_s;
    state.counters["unknowns"] = assessment.block.model->space().unknowns();
  }
}
BENCHMARK(assess_goliath_turnover)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace
}  // namespace blocklift::pipeline

BENCHMARK_MAIN();
