#include "pipeline/verification/models/rectangular_section.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/LU>

namespace blocklift::dynamics::testing {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

/// By Simpson's rule.
template <class Function>
double integrate(double from, double to, const Function& f) {
  constexpr int cells = 2000;
  const double step = (to - from) / cells;
  double sum = f(from) + f(to);
  for (int k = 1; k < cells; ++k) sum += (k % 2 == 0 ? 2.0 : 4.0) * f(from + k * step);
  return sum * step / 3.0;
}

/// alpha_m: the wave sent out (m = 0), and what stays, kappa tan(kappa h) = -w^2/g.
std::vector<Complex> find_decays(double depth, double wave_number, double deep_number, int terms) {
  std::vector<Complex> decays{Complex(0.0, wave_number)};
  const auto miss = [&](double x) { return x * std::sin(x) + deep_number * depth * std::cos(x); };
  for (int m = 1; m <= terms; ++m) {
    double low = (m - 0.5) * pi, high = m * pi;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((miss(middle) > 0.0) == (miss(low) > 0.0) ? low : high) = middle;
    }
    decays.emplace_back(low / depth);
  }
  return decays;
}

/// One motion of the section, its potential beneath and beside.
class SectionInWaves {
 public:
  SectionInWaves(const RectangularSection& section, DegreeOfFreedom mode, double wave_number,
                 double deep_number, int terms)
      : half_(0.5 * section.breadth),
        depth_(section.depth),
        gap_(section.depth - section.draught),
        mode_(mode),
        terms_(terms),
        decays_(find_decays(section.depth, wave_number, deep_number, terms)) {}

  Complex force() const;

 private:
  double cosine(int n, double s) const { return std::cos(n * pi * s / gap_); }
  /// Z_m, for the wave cosh(k s)/cosh(k h).
  double beside(int m, double s) const {
    if (m > 0) return std::cos(decays_[static_cast<std::size_t>(m)].real() * s);
    const double k = decays_[0].imag();
    return (std::exp(k * (s - depth_)) + std::exp(-k * (s + depth_))) /
           (1.0 + std::exp(-2.0 * k * depth_));
  }
  bool is_odd() const { return mode_ != heave; }
  /// f_n, 1 at x = b, and its slope there.
  double beneath(int n, double x) const {
    if (n == 0) return is_odd() ? x / half_ : 1.0;
    const double q = n * pi / gap_, sign = is_odd() ? -1.0 : 1.0;
    return std::exp(q * (x - half_)) * (1.0 + sign * std::exp(-2.0 * q * x)) /
           (1.0 + sign * std::exp(-2.0 * q * half_));
  }
  double slope(int n) const {
    if (n == 0) return is_odd() ? 1.0 / half_ : 0.0;
    const double q = n * pi / gap_;
    return is_odd() ? q / std::tanh(q * half_) : q * std::tanh(q * half_);
  }
  /// phi_p, with the motion of the box at its bottom, and its slope along x.
  double particular(double x, double s) const {
    if (mode_ == sway) return 0.0;
    if (mode_ == heave) return (s * s - x * x) / (2.0 * gap_);
    return x * (s * s - x * x / 3.0) / (2.0 * gap_);
  }
  double particular_slope(double x, double s) const {
    if (mode_ == sway) return 0.0;
    return mode_ == heave ? -x / gap_ : (s * s - x * x) / (2.0 * gap_);
  }
  /// Velocity of the box at its side and at its bottom.
  double side_velocity(double s) const {
    return mode_ == heave ? 0.0 : (mode_ == sway ? 1.0 : depth_ - s);
  }
  double bottom_velocity(double x) const {
    return mode_ == sway ? 0.0 : (mode_ == heave ? 1.0 : x);
  }
  void solve(VectorXcd& c, VectorXcd& a) const;

  double half_, depth_, gap_;
  DegreeOfFreedom mode_;
  int terms_;
  std::vector<Complex> decays_;
};

void SectionInWaves::solve(VectorXcd& c, VectorXcd& a) const {
  const int count = terms_ + 1;
  Eigen::MatrixXd overlap(count, count);
  VectorXd pressures(count), velocities(count), slopes(count);
  VectorXcd impedances(count);
  for (int m = 0; m < count; ++m) {
    const auto Z = [&](double s) { return beside(m, s); };
    for (int n = 0; n < count; ++n) {
      overlap(n, m) = integrate(0.0, gap_, [&](double s) { return cosine(n, s) * Z(s); });
    }
    velocities[m] =
        integrate(0.0, gap_, [&](double s) { return particular_slope(half_, s) * Z(s); }) +
        integrate(gap_, depth_, [&](double s) { return side_velocity(s) * Z(s); });
    const double norm = integrate(0.0, depth_, [&](double s) { return Z(s) * Z(s); });
    impedances[m] = -1.0 / (decays_[static_cast<std::size_t>(m)] * norm);
    pressures[m] =
        integrate(0.0, gap_, [&](double s) { return particular(half_, s) * cosine(m, s); });
    slopes[m] = slope(m);
  }
  // a from the velocities, a_m = impedance (velocities + sum_n overlap slope c); then c.
  const Eigen::MatrixXcd from_velocities = overlap * impedances.asDiagonal();
  Eigen::MatrixXcd matrix =
      -(from_velocities * overlap.transpose().cast<Complex>()) * slopes.asDiagonal();
  for (int n = 0; n < count; ++n) matrix(n, n) += n == 0 ? gap_ : 0.5 * gap_;
  c = matrix.partialPivLu().solve(from_velocities * velocities - pressures.cast<Complex>());
  a = impedances.cwiseProduct(overlap.transpose() * slopes.cast<Complex>().cwiseProduct(c) +
                              velocities.cast<Complex>());
}

/// -phi over the box, both halves: what its motion pushes out pushes back.
Complex SectionInWaves::force() const {
  VectorXcd c, a;
  solve(c, a);
  Complex sum =
      -integrate(0.0, half_, [&](double x) { return particular(x, gap_) * bottom_velocity(x); });
  for (int n = 0; n <= terms_; ++n) {
    sum -= c[n] * cosine(n, gap_) *
           integrate(0.0, half_, [&](double x) { return beneath(n, x) * bottom_velocity(x); });
    sum +=
        a[n] * integrate(gap_, depth_, [&](double s) { return beside(n, s) * side_velocity(s); });
  }
  return -2.0 * sum;
}

}  // namespace

Complex calc_section_force(const RectangularSection& section, DegreeOfFreedom mode,
                           double frequency, double gravity, int terms) {
  const double wave_number =
      calc_wave_number(frequency, {.gravity = gravity, .depth = section.depth});
  return SectionInWaves(section, mode, wave_number, frequency * frequency / gravity, terms).force();
}

}  // namespace blocklift::dynamics::testing
