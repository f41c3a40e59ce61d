#include "structure/envelope/envelope_search.h"

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

/// Response in the middle of a cluster, computed in double precision and scaled as the screen's,
/// and what is more than the rounding of its members' differences from it: a history that hardly
/// moves is told apart far more finely than its values in single precision are.
struct Middle {
  float response[6];
  float margin;
  float margin_of_principals;
};

/// The loops in the instruction set of this machine.
struct Kernel {
  void (*bound_stress)(const Screen&, const LoadHistory&, float* work, float* bounds);
  void (*screen_stress)(const Screen&, const LoadHistory&, int cluster, const Middle&,
                        float* bounds);
  void (*bound_displacement)(const Screen&, const LoadHistory&, float* work, float* bounds);
  void (*screen_displacement)(const Screen&, const LoadHistory&, int cluster, const Middle&,
                              float* bounds);
};

namespace portable {
#define BLOCKLIFT_TARGET
#include "structure/envelope/envelope_kernel.inc"
#undef BLOCKLIFT_TARGET
}  // namespace portable

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__AVX512F__)
namespace haswell {
#define BLOCKLIFT_TARGET __attribute__((target("arch=haswell")))
#include "structure/envelope/envelope_kernel.inc"
#undef BLOCKLIFT_TARGET
}  // namespace haswell
namespace skylake {
#define BLOCKLIFT_TARGET __attribute__((target("arch=skylake-avx512,prefer-vector-width=512")))
#include "structure/envelope/envelope_kernel.inc"
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
constexpr double unit = 6e-8;  // more than the rounding to single precision, 2^-24

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
  return static_cast<float>((2 * history.rank() + 20) * unit * sum);
}

// How far norms of the responses reach from a cluster's middle.
double reach_from_middle(const LoadHistory& history, const float* norms, int cluster) {
  double sum = 0;
  for (int k = 0; k < history.rank(); ++k)
    sum += norms[k] * history.half_widths()[k * history.padded_clusters() + cluster];
  return sum;
}

// Responses of a point in the middle of a cluster, in double precision.
template <int count>
Eigen::Matrix<double, count, 1> response_in_middle(const LoadHistory& history, const double* rows,
                                                   int cluster) {
  const int rank = history.rank();
  const double* y = history.middle(cluster);
  Eigen::Matrix<double, count, 1> sum = Eigen::Matrix<double, count, 1>::Zero();
  for (int c = 0; c < count; ++c)
    for (int k = 0; k < rank; ++k) sum[c] += rows[c * rank + k] * y[k];
  return sum;
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

  // Members of a cluster whose screened values reach what has been found are computed exactly, the
  // most promising first: they rule out most others.
  void evaluate(int cluster) {
    float bounds[3 * members];
    kernel().screen_stress(screen_, history_, cluster, middle_of(cluster), bounds);
    for (int quantity = 0; quantity < 3; ++quantity)
      evaluate(cluster,
               largest_of(bounds + static_cast<std::ptrdiff_t>(quantity) * members, members),
               bounds);
    for (int i = 0; i < members; ++i) evaluate(cluster, i, bounds);
  }

  // With F = sqrt(s:s) <= sqrt(3) |p| + sqrt(2/3) q, and q and sigma_i no more than sqrt(3/2) F:
  // differences are sums of `rank` products rounded as in margin(); the stress itself, its mean and
  // deviator and the root of their squares take less than 32 units of F, and the cubic for the
  // principal stresses less than four times as many.
  Middle middle_of(int cluster) const {
    Middle middle{};
    const Eigen::Matrix<double, 6, 1> s = scale_ * response_in_middle<6>(history_, rows_, cluster);
    for (int c = 0; c < 6; ++c) middle.response[c] = static_cast<float>(s[c]);
    const double spread =
        2 * (reach_from_middle(history_, screen_.norms, cluster) +
             reach_from_middle(history_, screen_.norms + 2L * history_.rank(), cluster));
    const double size =
        std::sqrt(s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm()) + spread;
    const double of_differences = (2 * history_.rank() + 20) * unit * spread;
    middle.margin = static_cast<float>(of_differences + 32 * unit * size);
    middle.margin_of_principals = static_cast<float>(of_differences + 128 * unit * size);
    return middle;
  }

  // One member, which is not looked at again.
  void evaluate(int cluster, int member, float* bounds) {
    float &q = bounds[member], &largest = bounds[members + member],
          &minus_smallest = bounds[2 * members + member];
    if (!reaches(q, largest, minus_smallest)) return;
    const int instant = history_.member_instants(cluster)[member];
    const auto stress = response<6>(history_, rows_, cluster, member);
    if (q >= found_.von_mises.value * scale_) take(found_.von_mises, von_mises_of(stress), instant);
    if (largest >= found_.largest_principal.value * scale_)
      take(found_.largest_principal, largest_principal(stress), instant);
    if (minus_smallest >= found_.minus_smallest_principal.value * scale_)
      take(found_.minus_smallest_principal, largest_principal(-stress), instant);
    q = largest = minus_smallest = -std::numeric_limits<float>::infinity();
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
                          SearchWorkspace& workspace, const Found& floor) {
  const int rank = history.rank(), clusters = history.clusters();
  float *coarse = workspace.rows.data(), *norms = coarse + 3L * rank;
  const double scale = scale_of(history, rows, 3);
  double reach = 0;  // no coordinate goes beyond its own
  for (int k = 0; k < rank; ++k) {
    Eigen::Vector3d u;
    for (int a = 0; a < 3; ++a) u[a] = rows[a * rank + k] * scale;
    for (int a = 0; a < 3; ++a) coarse[a * rank + k] = static_cast<float>(u[a]);
    norms[k] = static_cast<float>(u.norm());
    reach += norms[k] * history.reach()[k];
  }
  const Screen screen{coarse, nullptr, norms, 2 * margin(history, norms)};
  Found found = floor;
  if (reach + screen.margin < found.value * scale) return found;
  float* bounds = workspace.bounds.data();
  kernel().bound_displacement(screen, history, workspace.work.data(), bounds);
  const auto evaluate = [&](int cluster) {
    Middle middle{};
    const Eigen::Vector3d u = scale * response_in_middle<3>(history, rows, cluster);
    for (int a = 0; a < 3; ++a) middle.response[a] = static_cast<float>(u[a]);
    const double spread = reach_from_middle(history, norms, cluster);
    middle.margin =
        static_cast<float>((2 * rank + 20) * unit * spread + 16 * unit * (u.norm() + spread));
    float member_bounds[members];
    kernel().screen_displacement(screen, history, cluster, middle, member_bounds);
    const auto evaluate_member = [&](int i) {
      if (member_bounds[i] < found.value * scale) return;
      take(found, response<3>(history, rows, cluster, i).norm(),
           history.member_instants(cluster)[i]);
      member_bounds[i] = -std::numeric_limits<float>::infinity();  // not looked at again
    };
    evaluate_member(largest_of(member_bounds, members));
    for (int i = 0; i < members; ++i) evaluate_member(i);
  };
  evaluate(largest_of(bounds, clusters));
  for (int cluster = 0; cluster < clusters; ++cluster)
    if (bounds[cluster] >= found.value * scale) evaluate(cluster);
  return found;
}

}  // namespace blocklift::structure
