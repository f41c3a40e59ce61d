// The structural stage on the hull block: seconds of assembly, factorisation and unit responses as
// counters, then the evaluation of a load case, the checked stress and the error estimate. Run
// alone on the machine; our threads and those of OpenBLAS take all cores.
#include <benchmark/benchmark.h>

#include "structure/accuracy/block_error.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/squares.h"
#include "structure/stress/stress.h"
#include "structure/system/assembly.h"
#include "structure/system/cholesky_factor.h"
#include "tests/structure/block_models.h"
#include "tests/structure/hull_block.h"

namespace {

using namespace blocklift::structure;

void generate_mesh(benchmark::State& state) {
  const BlockDescription block = test::hull_block();
  for (auto unused : state) benchmark::DoNotOptimize(generate_shell_mesh(block));
}
BENCHMARK(generate_mesh)->Unit(benchmark::kMillisecond);

void unit_responses(benchmark::State& state) {
  for (auto unused : state) {
    const ElasticModel model = test::make_elastic_model(test::hull_block(), 3);
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

void factorisation(benchmark::State& state) {
  const ElasticModel model = test::make_elastic_model(test::hull_block(), 3);
  SparseLower stiffness = assemble_stiffness(model.space());
  // In the place of supports; a column's diagonal comes first.
  for (long column = 0; column < stiffness.cols(); ++column)
    stiffness.valuePtr()[stiffness.outerIndexPtr()[column]] *= 1.001;
  CholeskyFactor factor(stiffness);
  const int threads = static_cast<int>(state.range(0));
  for (auto unused : state) factor.factorise(stiffness, stiffness.diagonal(), threads);
  state.counters["unknowns"] = static_cast<double>(stiffness.cols());
  state.counters["factor_GB"] = factor.bytes() / 1e9;
}
BENCHMARK(factorisation)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void evaluate_load_case(benchmark::State& state) {
  BlockDescription block = test::hull_block();
  const ElasticModel model = test::make_elastic_model(block, 2);
  const UnitResponses responses(model);
  const StressRecovery recovery(responses);
  LoadCase load_case{"pull", std::vector<Vector3>(6, Vector3(0, 0, 1.4e6)), {}};
  for (auto unused : state) benchmark::DoNotOptimize(recovery.evaluate(load_case));
}
BENCHMARK(evaluate_load_case)->Unit(benchmark::kMillisecond);

/// A motion without a meaning: neither the checked stress nor the error estimate asks for one.
Eigen::MatrixXd any_motion(const ElasticModel& model) {
  return Eigen::VectorXd::LinSpaced(model.space().freedoms(), -1e-3, 1e-3);
}

void checked_stress(benchmark::State& state) {
  const ElasticModel model =
      test::make_elastic_model(test::hull_block(), static_cast<int>(state.range(0)));
  const Eigen::MatrixXd motion = any_motion(model);
  std::size_t squares = 0;
  for (auto unused : state) squares = CheckedStress(model, motion).squares().size();
  state.counters["squares"] = static_cast<double>(squares);
}
BENCHMARK(checked_stress)->ArgName("degree")->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);

void error_estimate(benchmark::State& state) {
  const ElasticModel model =
      test::make_elastic_model(test::hull_block(), static_cast<int>(state.range(0)));
  const Eigen::MatrixXd motion = any_motion(model);
  for (auto unused : state) benchmark::DoNotOptimize(estimate_block_errors(model, motion));
}
BENCHMARK(error_estimate)->ArgName("degree")->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
