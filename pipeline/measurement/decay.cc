#include "pipeline/measurement/decay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra/decompositions.h"

namespace blocklift::pipeline {
namespace {

using DecayParameters = Eigen::Matrix<double, 5, 1>;  // mean, cosine, sine, decay rate, frequency

Eigen::MatrixXd decay_shapes(const Eigen::VectorXd& time, double rate, double frequency) {
  Eigen::MatrixXd shapes(time.size(), 3);
  const Eigen::ArrayXd envelope = (-rate * time.array()).exp();
  shapes.col(0).setOnes();
  shapes.col(1) = envelope * (frequency * time.array()).cos();
  shapes.col(2) = envelope * (frequency * time.array()).sin();
  return shapes;
}

Eigen::VectorXd decay_residual(const Eigen::VectorXd& time, const Eigen::VectorXd& values,
                               const DecayParameters& p) {
  return values - decay_shapes(time, p[3], p[4]) * p.head<3>();
}

Eigen::MatrixXd decay_jacobian(const Eigen::VectorXd& time, const DecayParameters& p) {
  const Eigen::MatrixXd shapes = decay_shapes(time, p[3], p[4]);
  Eigen::MatrixXd jacobian(time.size(), 5);
  jacobian.leftCols<3>() = shapes;
  jacobian.col(3) = -time.array() * (p[1] * shapes.col(1).array() + p[2] * shapes.col(2).array());
  jacobian.col(4) = time.array() * (p[2] * shapes.col(1).array() - p[1] * shapes.col(2).array());
  return jacobian;
}

/// What the scan looks at of a row: means of neighbours where there are more samples than it needs.
Eigen::VectorXd thinned(const Eigen::VectorXd& row) {
  constexpr Eigen::Index enough = 3000;
  const Eigen::Index stride = (row.size() + enough - 1) / enough;
  if (stride <= 1) return row;
  Eigen::VectorXd means(row.size() / stride);
  for (Eigen::Index i = 0; i < means.size(); ++i) means[i] = row.segment(i * stride, stride).mean();
  return means;
}

/// The best of a scan over frequencies, from one period in the window to four samples a period.
DecayParameters scan_of_decays(const Eigen::VectorXd& time, const Eigen::VectorXd& values) {
  const double span = time[time.size() - 1];
  const double lowest = 2 * std::numbers::pi / span;
  const double highest = std::max(1.01 * lowest, lowest * static_cast<double>(time.size() - 1) / 4);
  // A frequency is told from its neighbour by a quarter of a turn over the window, or half a one.
  const int count = std::clamp(static_cast<int>(4 * highest / lowest), 8, 1500);
  DecayParameters best = DecayParameters::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= count; ++i) {
    const double frequency = lowest + (highest - lowest) * i / count;
    for (const double damping : {0.0, 0.02, 0.1}) {
      const Eigen::MatrixXd shapes = decay_shapes(time, damping * frequency, frequency);
      const Eigen::Matrix3d normal = shapes.transpose() * shapes;
      const Eigen::Vector3d linear =
          algebra::solve_symmetric<3>(normal, shapes.transpose() * values);
      const double error = (values - shapes * linear).squaredNorm();
      if (!(error < least)) continue;
      least = error;
      best << linear, damping * frequency, frequency;
    }
  }
  return best;
}

/// Levenberg and Marquardt's iteration from a beginning near the minimum.
DecayParameters refine_decay(const Eigen::VectorXd& time, const Eigen::VectorXd& values,
                             DecayParameters p) {
  double error = decay_residual(time, values, p).squaredNorm();
  double stiffening = 1e-3;
  for (int i = 0; i < 100 && stiffening < 1e10; ++i) {
    const Eigen::MatrixXd jacobian = decay_jacobian(time, p);
    Eigen::Matrix<double, 5, 5> normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1 + stiffening;
    const DecayParameters step =
        algebra::solve_symmetric<5>(normal, jacobian.transpose() * decay_residual(time, values, p));
    const double next = decay_residual(time, values, p + step).squaredNorm();
    if (!(next < error)) {
      stiffening *= 10;
      continue;
    }
    const bool is_still = error - next < 1e-14 * error;
    p += step;
    error = next;
    stiffening /= 10;
    if (is_still) break;
  }
  return p;
}

}  // namespace

std::optional<Decay> fit_decay(const TimeSeries& series) {
  const auto size = static_cast<Eigen::Index>(series.size());
  if (size < 12) return std::nullopt;
  Eigen::VectorXd time = Eigen::Map<const Eigen::VectorXd>(series.time.data(), size);
  time.array() -= series.time.front();
  const Eigen::VectorXd raw = Eigen::Map<const Eigen::VectorXd>(series.values.data(), size);
  const double mean = raw.mean();
  const Eigen::VectorXd values = raw.array() - mean;
  const double variance = values.squaredNorm();
  if (variance <= 1e-20 * static_cast<double>(size) * mean * mean || variance <= 0)
    return std::nullopt;
  const DecayParameters p =
      refine_decay(time, values, scan_of_decays(thinned(time), thinned(values)));
  const double error = decay_residual(time, values, p).squaredNorm();
  const double frequency = p[4];
  Decay decay;
  decay.explained = 1 - error / variance;
  if (!p.allFinite() || frequency <= 0 || decay.explained < 0.5) return std::nullopt;
  decay.period = 2 * std::numbers::pi / frequency;
  if (time[size - 1] < 1.5 * decay.period) return std::nullopt;
  const double natural = std::hypot(p[3], frequency);
  decay.damping_ratio = p[3] / natural;
  decay.amplitude = std::hypot(p[1], p[2]);
  const Eigen::MatrixXd jacobian = decay_jacobian(time, p);
  const Eigen::Matrix<double, 5, 5> covariance =
      algebra::inverse_of<Eigen::Dynamic>(jacobian.transpose() * jacobian) *
      (error / static_cast<double>(size - 5));
  decay.period_deviation = decay.period / frequency * std::sqrt(covariance(4, 4));
  // The ratio's derivatives with respect to rate and frequency.
  const Eigen::Vector2d slope(frequency * frequency / std::pow(natural, 3),
                              -p[3] * frequency / std::pow(natural, 3));
  decay.damping_deviation = std::sqrt(slope.dot(covariance.bottomRightCorner<2, 2>() * slope));
  return decay;
}

}  // namespace blocklift::pipeline
