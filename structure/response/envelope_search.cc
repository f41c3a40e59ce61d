#include "structure/response/envelope_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

namespace blocklift::structure {

namespace {

/// Responses of a point in single precision, scaled to about 1.
struct Screen {
  const float* rows;          ///< a component, each for unit coordinates
  const float* weighed_rows;  ///< of stress: <s_k, s> = sum_c weighed_rows[c][k] s[c]
  const float* norms;         ///< of each coordinate's response: q, spectral norm, |p|; or |u|
  float margin;               ///< more than all rounding together
};

/// The loops in the instruction set of this machine.
struct Kernel {
  void (*bound_stress)(const Screen&, const LoadHistory&, float* work, float* bounds);
  void (*screen_stress)(const Screen&, const LoadHistory&, int cluster, float* bounds);
  void (*bound_displacement)(const Screen&, const LoadHistory&, float* work, float* bounds);
  void (*screen_displacement)(const Screen&, const LoadHistory&, int cluster, float* bounds);
};

namespace portable {
#define BLOCKLIFT_TARGET
#include "structure/response/envelope_kernel.inc"
#undef BLOCKLIFT_TARGET
}  // namespace portable

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__AVX512F__)
namespace haswell {
#define BLOCKLIFT_TARGET __attribute__((target("arch=haswell")))
#include "structure/response/envelope_kernel.inc"
#undef BLOCKLIFT_TARGET
}  // namespace haswell
namespace skylake {
#define BLOCKLIFT_TARGET __attribute__((target("arch=skylake-avx512,prefer-vector-width=512")))
#include "structure/response/envelope_kernel.inc"
#undef BLOCKLIFT_TARGET
}  // namespace skylake

Kernel best_kernel() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
    return skylake::kernel;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    return haswell::kernel;
  return portable::kernel;
}
#else
Kernel best_kernel() { return portable::kernel; }
#endif

const Kernel& kernel() {
  static const Kernel best = best_kernel();
  return best;
}

constexpr int members = LoadHistory::cluster_size;

// Takes a value that is larger, or as large and earlier.
void take(Found& found, double value, int instant) {
  if (value > found.value || (value == found.value && instant < found.instant))
    found = {value, instant};
}

/// Exact response of a point to a member of a cluster.
template <int count>
Eigen::Matrix<double, count, 1> response(const LoadHistory& history, const double* rows,
                                         int cluster, int member) {
  const int rank = history.rank();
  const double* y = history.members(cluster) + member;
  Eigen::Matrix<double, count, 1> sum = Eigen::Matrix<double, count, 1>::Zero();
  for (int c = 0; c < count; ++c)
    for (int k = 0; k < rank; ++k) sum[c] += rows[c * rank + k] * y[k * members];
  return sum;
}

double von_mises_of(const Eigen::Matrix<double, 6, 1>& s) {
  const double p = s.head<3>().mean();
  return std::sqrt(
      1.5 * ((s.head<3>().array() - p).matrix().squaredNorm() + 2 * s.tail<3>().squaredNorm()));
}

double largest_principal(const Eigen::Matrix<double, 6, 1>& s) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly)
      .eigenvalues()[2];
}

// Scale of a point's responses, and the margin for their rounding in single precision: products of
// numbers rounded to 2^-24, `rank` of them summed, squared and rooted: less than 2 rank + 20 units.
float margin(const LoadHistory& history, const float* norms) {
  double sum = 0;
  for (int k = 0; k < history.rank(); ++k) sum += norms[k] * history.reach()[k];
  return static_cast<float>((2 * history.rank() + 20) * 6e-8 * sum);
}

double scale_of(const LoadHistory& history, const double* rows, int count) {
  double sum = 0;
  for (int c = 0; c < count; ++c)
    for (int k = 0; k < history.rank(); ++k)
      sum = std::max(sum, std::abs(rows[c * history.rank() + k]) * history.reach()[k]);
  return sum > 0 ? 1 / sum : 1;
}

int largest_of(const float* values, int count) {
  return static_cast<int>(std::max_element(values, values + count) - values);
}

/// Search at one point for extremes of the stress.
class StressSearch {
 public:
  StressSearch(const LoadHistory& history, const double* rows, SearchWorkspace& workspace,
               const StressFound& floor)
      : history_(history), rows_(rows), workspace_(workspace), found_(floor) {
    prepare();
  }

  StressFound run() {
    if (!reaches_at_all()) return found_;
    const int width = history_.padded_clusters(), clusters = history_.clusters();
    float* bounds = workspace_.bounds.data();
    kernel().bound_stress(screen_, history_, workspace_.work.data(), bounds);
    // The most promising clusters first; they rule out most others.
    const auto evaluate_if_worth = [&](int cluster) {
      if (reaches(bounds[cluster], bounds[width + cluster], bounds[2 * width + cluster]))
        evaluate(cluster);
    };
    for (int quantity = 0; quantity < 3; ++quantity)
      evaluate_if_worth(
          largest_of(bounds + static_cast<std::ptrdiff_t>(quantity) * width, clusters));
    for (int cluster = 0; cluster < clusters; ++cluster) evaluate_if_worth(cluster);
    return found_;
  }

 private:
  void prepare() {
    const int rank = history_.rank();
    float *rows = workspace_.rows.data(), *weighed = rows + 6L * rank, *norms = weighed + 6L * rank;
    scale_ = scale_of(history_, rows_, 6);
    for (int k = 0; k < rank; ++k) {
      Eigen::Matrix<double, 6, 1> s;
      for (int c = 0; c < 6; ++c) s[c] = rows_[c * rank + k] * scale_;
      const double p = s.head<3>().mean();
      for (int c = 0; c < 6; ++c) {
        rows[c * rank + k] = static_cast<float>(s[c]);
        weighed[c * rank + k] = static_cast<float>(c < 3 ? 1.5 * (s[c] - p) : 3 * s[c]);
      }
      const double q = von_mises_of(s);
      norms[k] = static_cast<float>(q);
      // |sigma_i| <= |p| + 2/3 q, and not above the Frobenius norm.
      const double frobenius = std::sqrt(s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm());
      norms[rank + k] = static_cast<float>(std::min(std::abs(p) + 2 * q / 3, frobenius));
      norms[2 * rank + k] = static_cast<float>(std::abs(p));
    }
    screen_ = {rows, weighed, norms,
               2 * margin(history_, norms) + 2 * margin(history_, norms + rank)};
  }

  // No coordinate goes beyond its reach, so that f(s) <= sum_k f(s_k) reach_k for the von Mises
  // stress and the spectral norm: most points of no interest are passed over by this alone.
  bool reaches_at_all() const {
    float q = screen_.margin, spectral = screen_.margin;
    for (int k = 0; k < history_.rank(); ++k) {
      const auto reach = static_cast<float>(history_.reach()[k]);
      q += screen_.norms[k] * reach;
      spectral += screen_.norms[history_.rank() + k] * reach;
    }
    return reaches(q, spectral, spectral);
  }

  bool reaches(float q, float largest, float minus_smallest) const {
    return q >= found_.von_mises.value * scale_ ||
           largest >= found_.largest_principal.value * scale_ ||
           minus_smallest >= found_.minus_smallest_principal.value * scale_;
  }

  // Members of a cluster whose screened values reach what has been found are computed exactly.
  void evaluate(int cluster) {
    float bounds[3 * members];
    kernel().screen_stress(screen_, history_, cluster, bounds);
    for (int i = 0; i < members; ++i) {
      const float q = bounds[i], largest = bounds[members + i],
                  minus_smallest = bounds[2 * members + i];
      if (!reaches(q, largest, minus_smallest)) continue;
      const int instant = history_.member_instants(cluster)[i];
      const auto stress = response<6>(history_, rows_, cluster, i);
      if (q >= found_.von_mises.value * scale_)
        take(found_.von_mises, von_mises_of(stress), instant);
      if (largest >= found_.largest_principal.value * scale_)
        take(found_.largest_principal, largest_principal(stress), instant);
      if (minus_smallest >= found_.minus_smallest_principal.value * scale_)
        take(found_.minus_smallest_principal, largest_principal(-stress), instant);
    }
  }

  const LoadHistory& history_;
  const double* rows_;
  SearchWorkspace& workspace_;
  double scale_ = 1;
  Screen screen_{};
  StressFound found_;
};

}  // namespace

SearchWorkspace::SearchWorkspace(const LoadHistory& history)
    : rows(15 * static_cast<std::size_t>(history.rank())),
      work(11 * static_cast<std::size_t>(history.padded_clusters())),
      bounds(3 * static_cast<std::size_t>(history.padded_clusters())) {}

StressFound search_stress(const LoadHistory& history, const double* rows,
                          SearchWorkspace& workspace, const StressFound& floor) {
  return StressSearch(history, rows, workspace, floor).run();
}

Found search_displacement(const LoadHistory& history, const double* rows,
                          SearchWorkspace& workspace) {
  const int rank = history.rank(), clusters = history.clusters();
  float *coarse = workspace.rows.data(), *norms = coarse + 3L * rank;
  const double scale = scale_of(history, rows, 3);
  for (int k = 0; k < rank; ++k) {
    Eigen::Vector3d u;
    for (int a = 0; a < 3; ++a) u[a] = rows[a * rank + k] * scale;
    for (int a = 0; a < 3; ++a) coarse[a * rank + k] = static_cast<float>(u[a]);
    norms[k] = static_cast<float>(u.norm());
  }
  const Screen screen{coarse, nullptr, norms, 2 * margin(history, norms)};
  float* bounds = workspace.bounds.data();
  kernel().bound_displacement(screen, history, workspace.work.data(), bounds);
  Found found;
  const auto evaluate = [&](int cluster) {
    float member_bounds[members];
    kernel().screen_displacement(screen, history, cluster, member_bounds);
    for (int i = 0; i < members; ++i)
      if (member_bounds[i] >= found.value * scale)
        take(found, response<3>(history, rows, cluster, i).norm(),
             history.member_instants(cluster)[i]);
  };
  evaluate(largest_of(bounds, clusters));
  for (int cluster = 0; cluster < clusters; ++cluster)
    if (bounds[cluster] >= found.value * scale) evaluate(cluster);
  return found;
}

}  // namespace blocklift::structure
