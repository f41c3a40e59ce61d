// Factorisations of the rows of loops beside Eigen's, and the least motion that they ask for.
#include <cstddef>
#include <cstdlib>
#include <vector>

#include <Eigen/QR>
#include <benchmark/benchmark.h>

#include "dynamics/multibody/rank_revealing_qr.h"

namespace blocklift::dynamics {
namespace {

// Rows of loops, transposed: `dependent` of the columns are sums of others, as of a loop that says
// again what another one has said.
Eigen::MatrixXd rows_of_loops(Eigen::Index velocities, Eigen::Index rows, Eigen::Index dependent) {
  std::srand(1);
  Eigen::MatrixXd transposed = Eigen::MatrixXd::Random(velocities, rows);
  for (Eigen::Index i = 0; i < dependent; ++i) {
    transposed.col(rows - 1 - i) = transposed.col(i) + transposed.col(i + 1);
  }
  return transposed;
}

constexpr double threshold = 1e-8;

/// The least x with A^T x = b, and the least y with A y = x.
struct Answers {
  Eigen::VectorXd x, y;
};

struct ByRankRevealingQr {
  explicit ByRankRevealingQr(const Eigen::MatrixXd& A)
      : group(static_cast<std::size_t>(A.cols()), 0), qr(A.rows(), A.cols()) {}

  void solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, Answers& answers) {
    qr.columns(A.cols()) = A;
    qr.factorise(A.cols(), group, threshold);
    answers.x.setZero();
    qr.correct(b, answers.x);
    qr.multipliers(answers.y);
  }

  std::vector<char> group;
  RankRevealingQr qr;
};

/// By a decomposition of Eigen, which neither scales columns nor tells those of zero.
template <class Decomposition>
struct ByEigen {
  explicit ByEigen(const Eigen::MatrixXd& A) : decomposition(A.rows(), A.cols()) {
    decomposition.setThreshold(threshold);
  }

  void solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, Answers& answers) {
    decomposition.compute(A);
    answers.x = decomposition.transpose().solve(b);
    answers.y = decomposition.solve(answers.x);
  }

  Decomposition decomposition;
};

// The counter says how far the answers are from those of a complete orthogonal decomposition.
template <class Solver>
void loop_rows(benchmark::State& state) {
  const Eigen::MatrixXd A = rows_of_loops(state.range(0), state.range(1), state.range(2));
  const Eigen::VectorXd b = A.transpose() * Eigen::VectorXd::Ones(A.rows());
  Answers answers{Eigen::VectorXd::Zero(A.rows()), Eigen::VectorXd::Zero(A.cols())};
  Answers complete = answers;
  ByEigen<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>>(A).solve(A, b, complete);
  Solver solver(A);
  for (auto _ : state) {
    solver.solve(A, b, answers);
    benchmark::DoNotOptimize(answers.y.data());
  }
  state.counters["x_away"] = (answers.x - complete.x).norm() / complete.x.norm();
  state.counters["y_away"] = (answers.y - complete.y).norm() / complete.y.norm();
}

// Velocities, rows of loops and how many of these depend on others: a closed chain, the seven
// bodies of Andrews' squeezer, a planar linkage that is over-determined, a crane of many loops.
void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({6, 3, 0})->Args({7, 6, 0})->Args({12, 10, 3})->Args({40, 30, 6});
}

BENCHMARK(loop_rows<ByRankRevealingQr>)->Apply(sizes);
BENCHMARK(loop_rows<ByEigen<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>>>)->Apply(sizes);
BENCHMARK(loop_rows<ByEigen<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>>>)
    ->Apply(sizes);

}  // namespace
}  // namespace blocklift::dynamics

BENCHMARK_MAIN();
