#include "dynamics/marine/radiation/retardation_from_damping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// int of cos(w t) dw and of (w - a) cos(w t) dw, each from a to b.
struct CosineIntegrals {
  double constant, linear;

  CosineIntegrals(double a, double b, double t) {
    const double h = b - a;
    // (1 - cos(h t))/t^2 and sin(h t)/t by the half angle: exact for small t, too.
    const double half = 0.5 * h * t;
    const double sinc = std::abs(half) < 1e-8 ? 1.0 : std::sin(half) / half;
    const double mean = std::cos(0.5 * (a + b) * t);
    constant = h * sinc * mean;
    if (std::abs(half) < 1e-3) {
      linear = 0.5 * h * h * (std::cos(a * t) - h * t * std::sin(a * t) * 2.0 / 3.0);
    } else {
      linear = h * std::sin(b * t) / t + (std::cos(b * t) - std::cos(a * t)) / (t * t);
    }
  }
};

/// Matrices with one column for each, and back: integrals of all entries at once.
MatrixXd columns_of(const std::vector<MatrixXd>& matrices) {
  MatrixXd columns(matrices.front().size(), static_cast<Eigen::Index>(matrices.size()));
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    columns.col(static_cast<Eigen::Index>(k)) = matrices[k].reshaped();
  }
  return columns;
}

std::vector<MatrixXd> matrices_of(const MatrixXd& columns, Eigen::Index rows) {
  std::vector<MatrixXd> matrices;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    matrices.emplace_back(columns.col(k).reshaped(rows, columns.rows() / rows));
  }
  return matrices;
}

/// int of 1/(v^2 - w^2) dv and of (v - a)/(v^2 - w^2) dv, from a to b, as principal values. What is
/// infinite at an end is left out: it cancels against the neighbouring interval's.
struct PoleIntegrals {
  double constant, linear;

  PoleIntegrals(double a, double b, double w) {
    const auto logarithm = [&](double x) { return std::log(std::max(std::abs(x), 1e-30 * w)); };
    const double below = logarithm(b - w) - logarithm(a - w);
    const double above = logarithm(b + w) - logarithm(a + w);
    constant = (below - above) / (2.0 * w);
    linear = 0.5 * (below + above) - a * constant;
  }
};

/// Adds an interval's integrals to the weights of B at its two ends.
template <class Integrals>
void add_weights(const Integrals& integrals, double from, double to, double& first,
                 double& second) {
  const double end = integrals.linear / (to - from);
  first += 2.0 / std::numbers::pi * (integrals.constant - end);
  second += 2.0 / std::numbers::pi * end;
}

/// Integrals of B, linear between frequencies, a column for each of `count` of them: of B over an
/// interval times what Integrals(from, to, place(n)) knows.
template <class Integrals, class Place>
MatrixXd integrate(const std::vector<double>& frequencies, const MatrixXd& damping,
                   std::size_t count, const Place& place) {
  constexpr std::size_t at_once = 256;
  MatrixXd result(damping.rows(), static_cast<Eigen::Index>(count));
  for (std::size_t first = 0; first < count; first += at_once) {
    const std::size_t some = std::min(at_once, count - first);
    MatrixXd weights = MatrixXd::Zero(static_cast<Eigen::Index>(frequencies.size()),
                                      static_cast<Eigen::Index>(some));
    for (std::size_t n = 0; n < some; ++n) {
      const auto column = static_cast<Eigen::Index>(n);
      for (std::size_t k = 1; k < frequencies.size(); ++k) {
        const double from = frequencies[k - 1], to = frequencies[k];
        const auto row = static_cast<Eigen::Index>(k);
        add_weights(Integrals(from, to, place(first + n)), from, to, weights(row - 1, column),
                    weights(row, column));
      }
    }
    result.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(some)).noalias() =
        damping * weights;
  }
  return result;
}

}  // namespace

std::vector<MatrixXd> integrate_damping(const std::vector<double>& frequencies,
                                        const std::vector<MatrixXd>& damping, double time_step,
                                        std::size_t count) {
  const MatrixXd K =
      integrate<CosineIntegrals>(frequencies, columns_of(damping), count,
                                 [&](std::size_t n) { return time_step * static_cast<double>(n); });
  return matrices_of(K, damping.front().rows());
}

std::vector<MatrixXd> integrate_added_mass(const std::vector<double>& frequencies,
                                           const std::vector<MatrixXd>& damping,
                                           const std::vector<double>& at) {
  const MatrixXd mass = integrate<PoleIntegrals>(frequencies, columns_of(damping), at.size(),
                                                 [&](std::size_t n) { return at[n]; });
  return matrices_of(mass, damping.front().rows());
}

void add_retardation(HydrodynamicDatabase& database) {
  const std::vector<double>& w = database.frequencies;
  if (w.size() < 3) {
    throw ModelError("retardation functions cannot follow from the damping at " +
                     std::to_string(w.size()) + " frequencies: at least three are needed");
  }
  double gap = w.front();
  for (std::size_t k = 1; k < w.size(); ++k) gap = std::max(gap, w[k] - w[k - 1]);
  database.time_step = 0.25 / w.back();
  const auto count =
      static_cast<std::size_t>(std::ceil(std::numbers::pi / (gap * database.time_step))) + 1;
  std::vector<double> frequencies = {0.0};
  std::vector<MatrixXd> damping = {MatrixXd::Zero(database.mode_count(), database.mode_count())};
  frequencies.insert(frequencies.end(), w.begin(), w.end());
  damping.insert(damping.end(), database.damping.begin(), database.damping.end());
  database.retardation = integrate_damping(frequencies, damping, database.time_step, count);
}

void add_infinite_added_mass(HydrodynamicDatabase& database) {
  const Eigen::Index modes = database.mode_count();
  database.infinite_added_mass = MatrixXd::Zero(modes, modes);
  MatrixXd sum = MatrixXd::Zero(modes, modes), mass, damping;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    calc_added_mass_and_damping(database, database.frequencies[k], mass, damping);
    sum += database.added_mass[k] - mass;
  }
  database.infinite_added_mass = sum / static_cast<double>(database.frequencies.size());
}

MatrixXd calc_wave_scales(const std::vector<MatrixXcd>& shares,
                          const MatrixXd& infinite_added_mass) {
  constexpr double share_of_mass = 0.05, share_of_largest = 1e-3;
  Eigen::VectorXd peaks = share_of_mass * infinite_added_mass.diagonal().cwiseAbs();
  for (const MatrixXcd& share : shares) peaks = peaks.cwiseMax(share.diagonal().cwiseAbs());
  std::array<double, 2> largest{};
  const auto kind = [](Eigen::Index m) { return m % modes_per_body < 3 ? 0U : 1U; };
  for (Eigen::Index m = 0; m < peaks.size(); ++m) {
    largest[kind(m)] = std::max(largest[kind(m)], peaks[m]);
  }
  for (Eigen::Index m = 0; m < peaks.size(); ++m) {
    peaks[m] = std::max(
        {peaks[m], share_of_largest * largest[kind(m)], std::numeric_limits<double>::min()});
  }
  const Eigen::VectorXd roots = peaks.cwiseSqrt();
  return roots * roots.transpose();
}

double calc_memory_error(const HydrodynamicDatabase& database,
                         const std::vector<double>& frequencies,
                         const std::vector<MatrixXcd>& forces) {
  std::vector<MatrixXcd> shares, misses;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    const std::complex<double> rate(0.0, frequencies[k]);
    MatrixXd mass, damping;
    calc_added_mass_and_damping(database, frequencies[k], mass, damping);
    misses.emplace_back(mass + damping / rate - forces[k] / rate);
    shares.emplace_back(forces[k] / rate - database.infinite_added_mass);
  }
  const MatrixXd scales = calc_wave_scales(shares, database.infinite_added_mass);
  double error = 0.0;
  for (const MatrixXcd& miss : misses) {
    error = std::max(error, (miss.cwiseAbs().array() / scales.array()).maxCoeff());
  }
  return error;
}

double calc_memory_error(const HydrodynamicDatabase& database) {
  std::vector<MatrixXcd> forces;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const std::complex<double> rate(0.0, database.frequencies[k]);
    forces.emplace_back(database.damping[k] + rate * database.added_mass[k]);
  }
  return calc_memory_error(database, database.frequencies, forces);
}

}  // namespace blocklift::dynamics
