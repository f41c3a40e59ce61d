#include "dynamics/marine/green/common_poles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/QR>

#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Poles of less than this share of the lowest frequency, or more than this of the highest, cannot
/// be told from nothing by the samples.
constexpr double slowest = 0.01, fastest = 4.0;

bool is_real(Complex pole) { return pole.imag() == 0.0; }

/// The values in as few directions as they have, to a millionth of the largest: sums of squares
/// over all values are those over the directions.
MatrixXcd compress(const MatrixXcd& values) {
  MatrixXd directions = (values * values.adjoint()).real();
  const VectorXd sizes = decompose_symmetric(directions);
  Eigen::Index kept = 1;
  while (kept < sizes.size() && sizes[sizes.size() - 1 - kept] > 1e-12 * sizes[sizes.size() - 1]) {
    ++kept;
  }
  return directions.rightCols(kept).transpose() * values;
}

/// Barycentric interpolation by the set-valued AAA algorithm, support point after support point.
class Interpolation {
 public:
  Interpolation(const std::vector<double>& frequencies, const MatrixXcd& values)
      : frequencies_(frequencies), values_(values) {
    take(values.colwise().squaredNorm());
  }

  std::size_t support_count() const { return support_.size(); }
  /// Takes the sample that is missed most for the next support point.
  void refine() {
    VectorXd misses = VectorXd::Zero(values_.cols());
    for (Eigen::Index i = 0; i < values_.cols(); ++i) {
      if (!taken(i)) misses[i] = (at(frequencies_[i]) - values_.col(i)).squaredNorm();
    }
    take(misses);
  }
  /// Those of pairs with positive imaginary part, and real ones.
  std::vector<Complex> poles() const;

 private:
  bool taken(Eigen::Index i) const {
    return std::find(support_.begin(), support_.end(), i) != support_.end();
  }
  void take(const VectorXd& misses) {
    Eigen::Index worst = 0;
    misses.maxCoeff(&worst);
    support_.push_back(worst);
    find_weights();
  }
  void find_weights();
  VectorXcd at(double frequency) const;

  const std::vector<double>& frequencies_;
  const MatrixXcd& values_;
  std::vector<Eigen::Index> support_;
  std::vector<Complex> weights_;  ///< of i w; those of -i w are conjugate
};

// The least right singular vector of the Loewner matrix over the real and imaginary parts of the
// weights. Each other sample, and nothing at infinity, gives a row for each value.
void Interpolation::find_weights() {
  const auto m = static_cast<Eigen::Index>(support_.size());
  const Eigen::Index samples = values_.cols(), size = values_.rows();
  const double last = *std::max_element(frequencies_.begin(), frequencies_.end());
  MatrixXd loewner((2 * (samples - m) + 1) * size, 2 * m);
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < samples; ++i) {
    if (taken(i)) continue;
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::Index s = support_[j];
      const double w = frequencies_[i], w_j = frequencies_[s];
      const VectorXcd one = (values_.col(i) - values_.col(s)) / Complex(0.0, w - w_j);
      const VectorXcd other = (values_.col(i) - values_.col(s).conjugate()) / Complex(0.0, w + w_j);
      const VectorXcd imaginary = Complex(0.0, 1.0) * (one - other);
      loewner.col(2 * j).segment(row, size) = (one + other).real();
      loewner.col(2 * j).segment(row + size, size) = (one + other).imag();
      loewner.col(2 * j + 1).segment(row, size) = imaginary.real();
      loewner.col(2 * j + 1).segment(row + size, size) = imaginary.imag();
    }
    row += 2 * size;
  }
  for (Eigen::Index j = 0; j < m; ++j) {
    loewner.col(2 * j).tail(size) = 2.0 / last * values_.col(support_[j]).real();
    loewner.col(2 * j + 1).tail(size) = -2.0 / last * values_.col(support_[j]).imag();
  }
  const VectorXd least = decompose_singular(loewner).vectors.col(2 * m - 1);
  weights_.clear();
  for (Eigen::Index j = 0; j < m; ++j) weights_.emplace_back(least[2 * j], least[2 * j + 1]);
}

VectorXcd Interpolation::at(double frequency) const {
  VectorXcd above = VectorXcd::Zero(values_.rows());
  Complex below = 0.0;
  for (std::size_t j = 0; j < support_.size(); ++j) {
    const double w_j = frequencies_[support_[j]];
    const Complex one = weights_[j] / Complex(0.0, frequency - w_j);
    const Complex other = std::conj(weights_[j]) / Complex(0.0, frequency + w_j);
    above += one * values_.col(support_[j]) + other * values_.col(support_[j]).conjugate();
    below += one + other;
  }
  return above / below;
}

// The denominator is c (s - S)^-1 b with S a turn for each pair of support points. Its zeros are
// the eigenvalues of S - b c S/(c b), but for one that is nothing.
std::vector<Complex> Interpolation::poles() const {
  const auto m = static_cast<Eigen::Index>(support_.size());
  MatrixXd S = MatrixXd::Zero(2 * m, 2 * m);
  VectorXd b(2 * m), c = VectorXd::Zero(2 * m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const double w_j = frequencies_[support_[j]];
    S(2 * j, 2 * j + 1) = w_j;
    S(2 * j + 1, 2 * j) = -w_j;
    b[2 * j] = 2.0 * weights_[j].real();
    b[2 * j + 1] = -2.0 * weights_[j].imag();
    c[2 * j] = 1.0;
  }
  // Where the sum of weights vanishes, a pole goes to infinity, and is left out below.
  double sum = c.dot(b);
  if (std::abs(sum) < 1e-14) sum = 1e-14;
  const MatrixXd zeros = S - b * (c.transpose() * S) / sum;
  const auto [first, last] = std::minmax_element(frequencies_.begin(), frequencies_.end());
  std::vector<Complex> poles;
  for (Complex pole : decompose_general(zeros).values) {
    if (std::abs(pole) < slowest * *first || std::abs(pole) > fastest * *last) continue;
    if (pole.imag() < 0.0) continue;
    pole.real(-std::max(std::abs(pole.real()), 1e-9 * *last));
    poles.push_back(pole);
  }
  return poles;
}

/// The functions of real numbers that residues stand for, at the samples: one of a real pole, two
/// of a pair.
struct RealBasis {
  MatrixXd columns;  ///< of length 1: real parts above imaginary ones
  VectorXd sizes;    ///< by which they were divided
  VectorXd sums;     ///< what each adds to the sum of R_k, which is nothing

  RealBasis(const VectorXcd& poles, const std::vector<double>& frequencies);
};

RealBasis::RealBasis(const VectorXcd& poles, const std::vector<double>& frequencies) {
  const auto samples = static_cast<Eigen::Index>(frequencies.size());
  const VectorXcd s =
      Complex(0.0, 1.0) * Eigen::Map<const VectorXd>(frequencies.data(), samples).cast<Complex>();
  const Eigen::Index pairs = (poles.imag().array() != 0.0).count();
  columns.resize(2 * samples, poles.size() + pairs);
  sizes.resize(columns.cols());
  sums.resize(columns.cols());
  Eigen::Index next = 0;
  const auto add = [&](const VectorXcd& function, double sum) {
    columns.col(next) << function.real(), function.imag();
    sizes[next] = columns.col(next).norm();
    columns.col(next) /= sizes[next];
    sums[next] = sum / sizes[next];
    ++next;
  };
  for (const Complex& pole : poles) {
    const VectorXcd one = (s.array() - pole).inverse();
    const VectorXcd other = (s.array() - std::conj(pole)).inverse();
    if (is_real(pole)) {
      add(one, 1.0);
    } else {
      add(one + other, 2.0);
      add(Complex(0.0, 1.0) * (one - other), 0.0);
    }
  }
}

/// Residues by least squares over all samples, their sum being nothing.
CommonPoles fit_residues(const std::vector<Complex>& poles, const std::vector<double>& frequencies,
                         const MatrixXcd& values) {
  CommonPoles fit;
  fit.poles = Eigen::Map<const VectorXcd>(poles.data(), static_cast<Eigen::Index>(poles.size()));
  fit.residues = MatrixXcd::Zero(values.rows(), fit.poles.size());
  const RealBasis basis(fit.poles, frequencies);
  const Eigen::Index count = basis.columns.cols();
  if (count < 2) return fit;
  MatrixXd right(basis.columns.rows(), values.rows());
  right << values.real().transpose(), values.imag().transpose();
  const MatrixXd turned = Eigen::HouseholderQR<MatrixXd>(basis.sums).householderQ();
  const MatrixXd free = turned.rightCols(count - 1);  // what leaves the sum alone
  MatrixXd numbers = free * Eigen::ColPivHouseholderQR<MatrixXd>(basis.columns * free).solve(right);
  numbers = basis.sizes.cwiseInverse().asDiagonal() * numbers;
  Eigen::Index next = 0;
  for (Eigen::Index k = 0; k < fit.poles.size(); ++k) {
    fit.residues.col(k).real() = numbers.row(next++).transpose();
    if (!is_real(fit.poles[k])) fit.residues.col(k).imag() = numbers.row(next++).transpose();
  }
  return fit;
}

/// Largest over the values, over their scales.
double measure(const VectorXcd& values, const VectorXd& scales) {
  return (values.cwiseAbs().array() / scales.array()).maxCoeff();
}

double largest_error(const CommonPoles& fit, const std::vector<double>& frequencies,
                     const MatrixXcd& values, const VectorXd& scales) {
  double error = 0.0;
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    error = std::max(error, measure(fit.at(frequencies[i]) - values.col(i), scales));
  }
  return error;
}

/// Those of the poles that make more than `least` of the scales at any sample.
std::vector<Complex> find_felt_poles(const CommonPoles& fit, const std::vector<double>& frequencies,
                                     const VectorXd& scales, double least) {
  std::vector<Complex> felt;
  for (Eigen::Index k = 0; k < fit.poles.size(); ++k) {
    double nearest = infinity;
    for (const double w : frequencies) {
      nearest = std::min(nearest, std::abs(Complex(0.0, w) - fit.poles[k]));
    }
    if (measure(fit.residues.col(k), scales) > least * nearest) felt.push_back(fit.poles[k]);
  }
  return felt;
}

}  // namespace

VectorXcd CommonPoles::at(double frequency) const {
  VectorXcd sum = VectorXcd::Zero(residues.rows());
  const Complex s(0.0, frequency);
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    sum += residues.col(k) / (s - poles[k]);
    if (!is_real(poles[k])) sum += residues.col(k).conjugate() / (s - std::conj(poles[k]));
  }
  return sum;
}

CommonPoles fit_common_poles(const std::vector<double>& frequencies, const MatrixXcd& values,
                             const VectorXd& scales, double tolerance, double* error) {
  const std::size_t samples = frequencies.size();
  if (samples < 4 || static_cast<std::size_t>(values.cols()) != samples || values.rows() == 0 ||
      values.rows() != scales.size() || !(scales.minCoeff() > 0.0)) {
    throw ModelError("poles cannot be found from " + std::to_string(values.rows()) + " x " +
                     std::to_string(values.cols()) + " values with " +
                     std::to_string(scales.size()) + " scales at " + std::to_string(samples) +
                     " frequencies: at least four are needed");
  }
  CommonPoles best;
  best.residues.resize(values.rows(), 0);
  double least = largest_error(best, frequencies, values, scales);
  const MatrixXcd compressed = compress(scales.cwiseInverse().asDiagonal() * values);
  Interpolation interpolation(frequencies, compressed);
  while (least > tolerance) {
    CommonPoles fit = fit_residues(interpolation.poles(), frequencies, values);
    const std::vector<Complex> felt = find_felt_poles(fit, frequencies, scales, 0.01 * tolerance);
    if (felt.size() < static_cast<std::size_t>(fit.poles.size())) {
      fit = fit_residues(felt, frequencies, values);
    }
    const double reached = largest_error(fit, frequencies, values, scales);
    if (reached < least) {
      least = reached;
      best = std::move(fit);
    }
    if (2 * (interpolation.support_count() + 1) > samples) break;
    interpolation.refine();
  }
  if (error != nullptr) *error = least;
  return best;
}

namespace {

/// Chooses the frequencies of a search.
class Choice {
 public:
  explicit Choice(const PoleSearch& search) : search_(search) {}

  /// Where two fits differ most, no nearer to one that is computed than a quarter of an even share.
  double of_difference(const std::vector<double>& computed, const CommonPoles& now,
                       const CommonPoles& before, const VectorXd& scales) const {
    const double span = search_.highest - search_.lowest;
    const double apart = 0.25 * span / static_cast<double>(computed.size());
    constexpr int candidates = 600;
    double chosen = middle_of_widest_gap(computed), most = 0.0;
    for (int i = 0; i <= candidates; ++i) {
      const double w = search_.lowest + span * i / candidates;
      const bool near = std::any_of(computed.begin(), computed.end(),
                                    [&](double known) { return std::abs(known - w) < apart; });
      if (near) continue;
      const double difference = measure(now.at(w) - before.at(w), scales);
      if (difference > most) {
        most = difference;
        chosen = w;
      }
    }
    return chosen;
  }
  double middle_of_widest_gap(std::vector<double> computed) const {
    computed.push_back(search_.lowest);
    computed.push_back(search_.highest);
    std::sort(computed.begin(), computed.end());
    double widest = 0.0, middle = search_.lowest;
    for (std::size_t k = 1; k < computed.size(); ++k) {
      if (computed[k] - computed[k - 1] <= widest) continue;
      widest = computed[k] - computed[k - 1];
      middle = 0.5 * (computed[k] + computed[k - 1]);
    }
    return middle;
  }

 private:
  const PoleSearch& search_;
};

/// Where a search starts: at what it is given, and at six frequencies that lie closer at the ends.
std::vector<double> first_frequencies(const PoleSearch& search) {
  std::vector<double> first = search.first;
  constexpr int count = 6;
  const double span = search.highest - search.lowest;
  if (first.size() >= count) return first;
  for (int i = 0; i < count; ++i) {
    const double w =
        search.lowest + 0.5 * span * (1.0 - std::cos(std::numbers::pi * i / (count - 1.0)));
    const bool near = std::any_of(first.begin(), first.end(),
                                  [&](double known) { return std::abs(known - w) < 0.02 * span; });
    if (!near) first.push_back(w);
  }
  return first;
}

void check(const PoleSearch& search) {
  bool sound = search.lowest > 0.0 && search.highest > search.lowest;
  for (const double w : search.first) sound = sound && w >= search.lowest && w <= search.highest;
  if (sound) return;
  throw ModelError("poles cannot be sought from " + std::to_string(search.lowest) + " to " +
                   std::to_string(search.highest) +
                   " rad/s: frequencies must ascend, and those that are given lie within");
}

}  // namespace

FoundPoles search_common_poles(const std::function<VectorXcd(double)>& compute,
                               const PoleSearch& search) {
  check(search);
  FoundPoles found;
  const auto add = [&](double frequency) {
    const VectorXcd value = compute(frequency);
    found.frequencies.push_back(frequency);
    found.values.conservativeResize(value.size(),
                                    static_cast<Eigen::Index>(found.values.cols()) + 1);
    found.values.rightCols(1) = value;
  };
  for (const double w : first_frequencies(search)) add(w);
  const auto find_scales = [&]() -> VectorXd {
    if (search.scales) return search.scales(found.values);
    return found.values.cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-300);
  };
  // What is fitted is to miss less than what is foretold may.
  const auto fit = [&](const VectorXd& scales) {
    return fit_common_poles(found.frequencies, found.values, scales, 0.3 * search.tolerance);
  };
  const Choice choice(search);
  VectorXd scales = find_scales();
  found.function = fit(scales);
  CommonPoles before = found.function;
  std::vector<double> misses;
  const auto settled = [&] {
    if (misses.size() < 3) return false;
    found.miss = *std::max_element(misses.end() - 3, misses.end());
    return found.miss <= search.tolerance;
  };
  while (!settled() && static_cast<int>(found.frequencies.size()) < search.most) {
    const bool by_gap = misses.size() % 3 == 0;
    const double w = by_gap
                         ? choice.middle_of_widest_gap(found.frequencies)
                         : choice.of_difference(found.frequencies, found.function, before, scales);
    add(w);
    scales = find_scales();
    misses.push_back(measure(found.values.rightCols(1) - found.function.at(w), scales));
    before = std::move(found.function);
    found.function = fit(scales);
  }
  return found;
}

}  // namespace blocklift::dynamics
