// Envelope over 10,000 instants at 200,000 points with 30 unit responses (six lugs): a history like
// a lift's, and noise, in which no instant is near another and everything has to be evaluated.
#include <benchmark/benchmark.h>

#include "structure/envelope/envelope.h"
#include "tests/structure/sample_history.h"

namespace {

using namespace blocklift::structure;

constexpr int points = 200000, instants = 10000, units = 30;

void envelope(benchmark::State& state, const Eigen::MatrixXd& factors, int threads) {
  // Responses of 1,000 points, again and again: 288 MB of them would not say more.
  const Eigen::MatrixXd responses = test::random_responses(6 * 1000, units, 1);
  for (auto unused : state) {
    const LoadHistory history(factors, Eigen::VectorXd::Ones(units));
    benchmark::DoNotOptimize(find_stress_envelope(
        history, points,
        [&](int first, int count) {
          return responses.middleRows(6 * (first % (1000 - count)), 6 * count);
        },
        threads));
  }
  state.counters["rank"] = LoadHistory(factors, Eigen::VectorXd::Ones(units)).rank();
}

void lift(benchmark::State& state) {
  envelope(state, test::lift_like_history(units, instants, 2), static_cast<int>(state.range(0)));
}
BENCHMARK(lift)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

void noise(benchmark::State& state) {
  envelope(state, test::noise_history(units, instants, 2), static_cast<int>(state.range(0)));
}
BENCHMARK(noise)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
