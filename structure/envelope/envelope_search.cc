#include "structure/envelope/envelope_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Dense>

#include "algebra/decompositions.h"

namespace blocklift::structure {

namespace {

/// Responses u of a point of which the norm |u| is sought, in single precision, scaled to about 1.
struct Screen {
  const float* rows;   ///< a component, each for unit coordinates
  const float* norms;  ///< |u| for each coordinate
  float margin;        ///< more than all rounding together
  int leading;         ///< coordinates after which it is seen whether the others are worth while
  float others;        ///< more than these bring to |u| at any instant
};

/// Stresses of a point.
struct PrincipalScreen {
  const float* rows;          ///< a component, each for unit coordinates
  const float* weighed_rows;  ///< <s_k, s> = sum_c weighed_rows[c][k] s[c], with q^2 = <s, s>
  const float* norms;         ///< of each coordinate's response: q, spectral norm, |p|
  float margin;
};

/// Response in the middle of a cluster, computed in double precision and scaled as the screen's,
/// and what is more than the rounding of its members' differences from it: a history that hardly
/// moves is told apart far more finely than its values in single precision are.
struct Middle {
  float response[6];
  float margin;
  float others = 0;  ///< more than the others of Screen::leading bring to a member's norm
};

/// Bounds of |u| over boxes, or of members of a cluster, and whether one reaches the floor.
using BoundNorm = bool (*)(const Screen&, int rank, const float* centres, const float* half_widths,
                           float floor, float* bounds);
using ScreenNorm = bool (*)(const Screen&, int rank, const float* differences, const Middle&,
                            float floor, float* bounds);

/// The loops in the instruction set of this machine.
struct Kernel {
  BoundNorm bound_norm_of_3;
  ScreenNorm screen_norm_of_3;
  BoundNorm bound_norm_of_5;
  ScreenNorm screen_norm_of_5;
  void (*bound_principals)(const PrincipalScreen&, int rank, const float* centres,
                           const float* half_widths, float* bounds);
  void (*screen_principals)(const PrincipalScreen&, int rank, const float* differences,
                            const Middle&, float* bounds);
  void (*multiply)(const double* A, long rows, int inner, const double* B, int width, int columns,
                   double* product);
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
constexpr int pack = LoadHistory::pack;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unit = 6e-8;     // more than the rounding to single precision, 2^-24
constexpr int most_leading = 12;  // coordinates that say where most instants of a cluster lie

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

double frobenius_of(const Eigen::Matrix<double, 6, 1>& s) {
  return std::sqrt(s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm());
}

double largest_principal(const Eigen::Matrix<double, 6, 1>& s) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return algebra::symmetric_eigenvalues(tensor)[2];
}

// Scale of a point's responses, and the margin for their rounding in single precision: products of
// numbers rounded to 2^-24, `rank` of them summed, squared and rooted: less than 2 rank + 20 units.
float margin(const LoadHistory& history, const float* norms) {
  double sum = 0;
  for (int k = 0; k < history.rank(); ++k) sum += norms[k] * history.reach()[k];
  return static_cast<float>((2 * history.rank() + 20) * unit * sum);
}

// Just below a value, in single precision.
float below(double value) { return static_cast<float>(value - 3 * unit * std::abs(value)); }

const float* of_pack(const std::vector<float>& boxes, const LoadHistory& history, int number) {
  return boxes.data() + static_cast<std::ptrdiff_t>(number) * history.rank() * pack;
}

using ConstArray = Eigen::Map<const Eigen::ArrayXd>;
using Array = Eigen::Map<Eigen::ArrayXd>;

ConstArray row_of(const double* rows, int rank, int row) {
  return {rows + static_cast<std::ptrdiff_t>(row) * rank, rank};
}

// How far norms of the responses to the coordinates from `begin` on reach from a cluster's middle.
double reach_from_middle(const SearchTables& tables, const float* norms, int cluster, int begin,
                         int end) {
  using ConstFloats = Eigen::Map<const Eigen::VectorXf>;
  const float sum = ConstFloats(norms + begin, end - begin)
                        .dot(ConstFloats(tables.half_widths(cluster) + begin, end - begin));
  return (1 + (end - begin + 2) * unit) * static_cast<double>(sum);
}

// Responses of a point in the middle of a cluster, in double precision.
template <int count>
Eigen::Matrix<double, count, 1> response_in_middle(const LoadHistory& history, const double* rows,
                                                   int cluster) {
  const Eigen::Map<const Eigen::VectorXd> y(history.middle(cluster), history.rank());
  Eigen::Matrix<double, count, 1> sum;
  for (int c = 0; c < count; ++c) sum[c] = row_of(rows, history.rank(), c).matrix().dot(y);
  return sum;
}

// The largest that a single coordinate brings to each of `count` components.
template <int count>
Eigen::Array<double, count, 1> sizes_of(const LoadHistory& history, const double* rows) {
  Eigen::Array<double, count, 1> sizes;
  for (int c = 0; c < count; ++c)
    sizes[c] = (row_of(rows, history.rank(), c).abs() * history.reach().array()).maxCoeff();
  return sizes;
}

double scale_of(double size) { return size > 0 ? 1 / size : 1; }

int largest_of(const float* values, int count) {
  return static_cast<int>(std::max_element(values, values + count) - values);
}

/// Search at one point for the largest norm |u| of what is linear in the loads, of `count`
/// components.
template <int count>
class NormSearch {
 public:
  /// @param matrix count x rank, row after row: u for unit coordinates, times `scale`.
  /// @param rounding of the exact values, times the scale, as far as it may be more than that of u.
  NormSearch(const LoadHistory& history, const double* matrix, double scale, double rounding,
             SearchWorkspace& workspace, const Found& floor)
      : history_(history),
        matrix_(matrix),
        scale_(scale),
        rounding_(static_cast<float>(2 * rounding)),
        workspace_(workspace),
        found_(floor) {
    const int rank = history.rank();
    float *rows = workspace.rows.data(), *norms = rows + static_cast<std::ptrdiff_t>(count) * rank;
    Array norm(workspace.norms.data(), rank);
    norm.setZero();
    for (int c = 0; c < count; ++c) {
      const ConstArray row = row_of(matrix, rank, c);
      norm += row.square();
      Eigen::Map<Eigen::ArrayXf>(rows + static_cast<std::ptrdiff_t>(c) * rank, rank) =
          row.cast<float>();
    }
    norm = norm.sqrt();
    Eigen::Map<Eigen::ArrayXf>(norms, rank) = norm.cast<float>();
    reach_ = norm.matrix().dot(history.reach());
    const int leading = std::min(rank, most_leading);
    const double others =
        norm.tail(rank - leading).matrix().dot(history.reach().tail(rank - leading));
    screen_ = {rows, norms, rounding_ + static_cast<float>(2 * (2 * rank + 20) * unit * reach_),
               leading, static_cast<float>((1 + 2 * unit) * others)};
  }

  /// @param exact the value of a member of a cluster, exactly.
  template <class Exact>
  Found run(const Exact& exact) {
    // No coordinate goes beyond its reach: most points of no interest are passed over by this.
    if (reach_ + screen_.margin < found_.value * scale_) return found_;
    const int packs = history_.packs();
    if (workspace_.likely_cluster >= 0) evaluate(workspace_.likely_cluster, exact);
    if (packs == 1) {
      look_into(0, exact);
      return found_;
    }
    // The most promising pack first: it rules out most others.
    float* bounds = workspace_.bounds.data();
    bool is_any = false;
    for (int first = 0; first < packs; first += pack)
      is_any |= bound(history_.boxes_of_packs(), first / pack, bounds + first);
    if (!is_any) return found_;
    const int best = largest_of(bounds, packs);
    look_into(best, exact);
    for (int i = 0; i < packs; ++i)
      if (i != best && reaches(bounds[i])) look_into(i, exact);
    return found_;
  }

 private:
  static BoundNorm bound_norm() {
    return count == 3 ? kernel().bound_norm_of_3 : kernel().bound_norm_of_5;
  }
  static ScreenNorm screen_norm() {
    return count == 3 ? kernel().screen_norm_of_3 : kernel().screen_norm_of_5;
  }

  bool bound(const LoadBoxes& boxes, int number, float* bounds) const {
    return bound_norm()(screen_, history_.rank(), of_pack(boxes.centres, history_, number),
                        of_pack(boxes.half_widths, history_, number), below(found_.value * scale_),
                        bounds);
  }

  bool reaches(float bound) const { return bound >= found_.value * scale_; }

  // The clusters of a pack, the most promising first.
  template <class Exact>
  void look_into(int number, const Exact& exact) {
    float bounds[pack];
    if (!bound(history_.boxes_of_clusters(), number, bounds)) return;
    const int first = number * pack, clusters = std::min(pack, history_.clusters() - first);
    const int best = largest_of(bounds, clusters);
    evaluate(first + best, exact);
    for (int i = 0; i < clusters; ++i)
      if (i != best && reaches(bounds[i])) evaluate(first + i, exact);
  }

  // Members of a cluster whose screened values reach what has been found are computed exactly, the
  // most promising first: they rule out most others.
  template <class Exact>
  void evaluate(int cluster, const Exact& exact) {
    float bounds[members];
    if (!screen_norm()(screen_, history_.rank(), history_.coarse_members(cluster),
                       middle_of(cluster), below(found_.value * scale_), bounds))
      return;
    const int best = largest_of(bounds, members);
    const auto evaluate_member = [&](int i) {
      if (!reaches(bounds[i])) return;
      const double before = found_.value;
      take(found_, exact(cluster, i), history_.member_instants(cluster)[i]);
      if (!(found_.value > before)) return;
      workspace_.likely_cluster = cluster;
      workspace_.likely_member = i;
    };
    evaluate_member(best);
    for (int i = 0; i < members; ++i)
      if (i != best) evaluate_member(i);
  }

  // Differences are sums of `rank` products rounded as in margin(); u itself, its squares and the
  // root take less than 16 units of its size.
  Middle middle_of(int cluster) const {
    Middle middle{};
    const Eigen::Matrix<double, count, 1> u = response_in_middle<count>(history_, matrix_, cluster);
    for (int c = 0; c < count; ++c) middle.response[c] = static_cast<float>(u[c]);
    const int rank = history_.rank(), leading = screen_.leading;
    const double others =
        reach_from_middle(workspace_.tables, screen_.norms, cluster, leading, rank);
    middle.others = static_cast<float>((1 + 4 * unit) * others);
    const double spread =
        reach_from_middle(workspace_.tables, screen_.norms, cluster, 0, leading) + others;
    middle.margin = rounding_ + static_cast<float>((2 * rank + 20) * unit * spread +
                                                   16 * unit * (u.norm() + spread));
    return middle;
  }

  const LoadHistory& history_;
  const double* matrix_;
  double scale_;
  float rounding_;
  SearchWorkspace& workspace_;
  Found found_;
  double reach_ = 0;
  Screen screen_{};
};

/// Search at one point for extremes of the principal stresses.
class PrincipalSearch {
 public:
  PrincipalSearch(const LoadHistory& history, const double* rows, SearchWorkspace& workspace,
                  const Found& largest, const Found& minus_smallest)
      : history_(history),
        rows_(rows),
        workspace_(workspace),
        largest_(largest),
        minus_smallest_(minus_smallest) {
    prepare();
  }

  void run() {
    if (!reaches_at_all()) return;
    const int width = history_.packs() * pack, clusters = history_.clusters();
    float* bounds = workspace_.bounds.data();
    float of_pack_bounds[2 * pack];
    const LoadBoxes& boxes = history_.boxes_of_clusters();
    for (int first = 0; first < width; first += pack) {
      kernel().bound_principals(screen_, history_.rank(),
                                of_pack(boxes.centres, history_, first / pack),
                                of_pack(boxes.half_widths, history_, first / pack), of_pack_bounds);
      std::copy_n(of_pack_bounds, pack, bounds + first);
      std::copy_n(of_pack_bounds + pack, pack, bounds + width + first);
    }
    // The most promising clusters first; they rule out most others.
    const auto evaluate_if_worth = [&](int cluster) {
      if (reaches(bounds[cluster], bounds[width + cluster])) evaluate(cluster);
    };
    evaluate_if_worth(largest_of(bounds, clusters));
    evaluate_if_worth(largest_of(bounds + width, clusters));
    for (int cluster = 0; cluster < clusters; ++cluster) evaluate_if_worth(cluster);
  }

  const Found& largest() const { return largest_; }
  const Found& minus_smallest() const { return minus_smallest_; }

 private:
  void prepare() {
    const int rank = history_.rank();
    float *rows = workspace_.rows.data(), *weighed = rows + 6L * rank, *norms = weighed + 6L * rank;
    scale_ = scale_of(sizes_of<6>(history_, rows_).maxCoeff());
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
      norms[rank + k] = static_cast<float>(std::min(std::abs(p) + 2 * q / 3, frobenius_of(s)));
      norms[2 * rank + k] = static_cast<float>(std::abs(p));
    }
    screen_ = {rows, weighed, norms,
               2 * margin(history_, norms) + 2 * margin(history_, norms + rank)};
  }

  // No coordinate goes beyond its reach, so that |sigma_i| <= sum_k |s_k| reach_k.
  bool reaches_at_all() const {
    float spectral = screen_.margin;
    for (int k = 0; k < history_.rank(); ++k)
      spectral += screen_.norms[history_.rank() + k] * static_cast<float>(history_.reach()[k]);
    return reaches(spectral, spectral);
  }

  bool reaches(float largest, float minus_smallest) const {
    return largest >= largest_.value * scale_ || minus_smallest >= minus_smallest_.value * scale_;
  }

  // As NormSearch does.
  void evaluate(int cluster) {
    float bounds[2 * members];
    kernel().screen_principals(screen_, history_.rank(), history_.coarse_members(cluster),
                               middle_of(cluster), bounds);
    evaluate(cluster, largest_of(bounds, members), bounds);
    evaluate(cluster, largest_of(bounds + members, members), bounds);
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
    const int rank = history_.rank();
    const double spread =
        2 * (reach_from_middle(workspace_.tables, screen_.norms, cluster, 0, rank) +
             reach_from_middle(workspace_.tables, screen_.norms + 2L * rank, cluster, 0, rank));
    const double size = frobenius_of(s) + spread;
    middle.margin = static_cast<float>((2 * rank + 20) * unit * spread + 128 * unit * size);
    return middle;
  }

  // One member, which is not looked at again.
  void evaluate(int cluster, int member, float* bounds) {
    float &largest = bounds[member], &minus_smallest = bounds[members + member];
    if (!reaches(largest, minus_smallest)) return;
    const int instant = history_.member_instants(cluster)[member];
    const auto stress = response<6>(history_, rows_, cluster, member);
    if (largest >= largest_.value * scale_) take(largest_, largest_principal(stress), instant);
    if (minus_smallest >= minus_smallest_.value * scale_)
      take(minus_smallest_, largest_principal(-stress), instant);
    largest = minus_smallest = -std::numeric_limits<float>::infinity();
  }

  const LoadHistory& history_;
  const double* rows_;
  SearchWorkspace& workspace_;
  double scale_ = 1;
  PrincipalScreen screen_{};
  Found largest_, minus_smallest_;
};

double von_mises_at(const LoadHistory& history, const double* rows, int cluster, int member) {
  return von_mises_of(response<6>(history, rows, cluster, member));
}

// Coordinates in which the von Mises stress is the norm:
// q^2 = a^2 + b^2 + 3 (xy^2 + yz^2 + zx^2), a = (xx + yy) / 2 - zz, b = sqrt(3) / 2 (xx - yy).
// The last two are left out where there is no such shear.
template <int count>
Found search_von_mises_of(const LoadHistory& history, const double* rows, double scale,
                          SearchWorkspace& workspace, const Found& floor) {
  const int rank = history.rank();
  const auto component = [&](int c) { return row_of(rows, rank, c); };
  const auto coordinate = [&](int c) {
    return Array(workspace.matrix.data() + static_cast<std::ptrdiff_t>(c) * rank, rank);
  };
  const double of_shear = scale * std::sqrt(3.0);
  coordinate(0) = scale * ((component(0) + component(1)) / 2 - component(2));
  coordinate(1) = of_shear / 2 * (component(0) - component(1));
  for (int c = 2; c < count; ++c) coordinate(c) = of_shear * component(c + 1);
  // Of a large pressure more is rounded than of what it adds to the von Mises stress. Scaled, no
  // coordinate brings more than 1 to a component.
  const double rounding = (2 * rank + 32) * std::numeric_limits<double>::epsilon() * 3 * rank;
  return NormSearch<count>(history, workspace.matrix.data(), scale, rounding, workspace, floor)
      .run([&](int cluster, int member) { return von_mises_at(history, rows, cluster, member); });
}

}  // namespace

SearchTables::SearchTables(const LoadHistory& history)
    : history_(history),
      modes_(Rows::Zero(history.modes().rows(), (history.rank() + 7) / 8 * 8)),
      half_widths_(static_cast<std::size_t>(history.clusters()) *
                   static_cast<std::size_t>(history.rank())) {
  modes_.leftCols(history.rank()) = history.modes();
  auto to = half_widths_.begin();
  for (int cluster = 0; cluster < history.clusters(); ++cluster) {
    const float* of_box =
        of_pack(history.boxes_of_clusters().half_widths, history, cluster / pack) + cluster % pack;
    for (int k = 0; k < history.rank(); ++k, ++to) *to = of_box[k * pack];
  }
}

SearchTables::Rows SearchTables::in_coordinates(const Eigen::MatrixXd& units) const {
  Rows rows(units.rows(), history_.rank());
  kernel().multiply(units.data(), units.rows(), static_cast<int>(units.cols()), modes_.data(),
                    static_cast<int>(modes_.cols()), history_.rank(), rows.data());
  return rows;
}

SearchWorkspace::SearchWorkspace(const SearchTables& of_history)
    : tables(of_history),
      matrix(5 * static_cast<std::size_t>(tables.history().rank())),
      norms(static_cast<std::size_t>(tables.history().rank())),
      rows(15 * static_cast<std::size_t>(tables.history().rank())),
      bounds(2 * static_cast<std::size_t>(tables.history().packs()) * pack) {}

Found search_von_mises(const double* rows, SearchWorkspace& workspace, const Found& floor) {
  const LoadHistory& history = workspace.tables.history();
  const Eigen::Array<double, 6, 1> sizes = sizes_of<6>(history, rows);
  const double size = sizes.maxCoeff();
  if (!(size > 0)) {  // nothing at all instants
    Found found = floor;
    take(found, 0, 0);
    return found;
  }
  return sizes[4] > 0 || sizes[5] > 0
             ? search_von_mises_of<5>(history, rows, 1 / size, workspace, floor)
             : search_von_mises_of<3>(history, rows, 1 / size, workspace, floor);
}

double likely_von_mises(const double* rows, const SearchWorkspace& workspace) {
  if (workspace.likely_cluster < 0) return -infinity;
  return von_mises_at(workspace.tables.history(), rows, workspace.likely_cluster,
                      workspace.likely_member);
}

StressFound search_stress(const double* rows, SearchWorkspace& workspace,
                          const StressFound& floor) {
  const Found von_mises = search_von_mises(rows, workspace, floor.von_mises);
  PrincipalSearch search(workspace.tables.history(), rows, workspace, floor.largest_principal,
                         floor.minus_smallest_principal);
  search.run();
  return {von_mises, search.largest(), search.minus_smallest()};
}

Found search_displacement(const double* rows, SearchWorkspace& workspace, const Found& floor) {
  const LoadHistory& history = workspace.tables.history();
  const double scale = scale_of(sizes_of<3>(history, rows).maxCoeff());
  double* matrix = workspace.matrix.data();
  for (int i = 0; i < 3 * history.rank(); ++i) matrix[i] = rows[i] * scale;
  return NormSearch<3>(history, matrix, scale, 0, workspace, floor)
      .run([&](int cluster, int member) {
        return response<3>(history, rows, cluster, member).norm();
      });
}

}  // namespace blocklift::structure
