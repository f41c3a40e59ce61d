#include "pipeline/verification/models/rectangular_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "algebra/factors.h"

namespace blocklift::dynamics::examples {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

/// Roots alpha of -alpha tan(alpha h) = number: i times the wave's number, then what stays. Those
/// of the real part first, from there by Newton's method.
std::vector<Complex> find_roots(double depth, Complex number, double wave_number, int terms) {
  std::vector<Complex> roots{Complex(0.0, wave_number)};
  const auto miss = [&](auto x) {
    return x * std::sin(x * depth) + number.real() * std::cos(x * depth);
  };
  for (int m = 1; m <= terms; ++m) {
    double low = (m - 0.5) * pi / depth, high = m * pi / depth;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((miss(middle) > 0.0) == (miss(low) > 0.0) ? low : high) = middle;
    }
    roots.emplace_back(low);
  }
  for (Complex& x : roots) {
    for (int k = 0; k < 20 && number.imag() != 0.0; ++k) {
      const Complex tangent = std::tan(x * depth);
      x -= (x * tangent + number) / (tangent + x * depth * (1.0 + tangent * tangent));
    }
  }
  return roots;
}

/// Beneath the box: cosines over the height, and the solution with its motion.
class WaterBeneath {
 public:
  WaterBeneath(const RectangularSection& section, DegreeOfFreedom mode)
      : half_(0.5 * section.breadth), height_(section.depth - section.draught), mode_(mode) {}

  double height() const { return height_; }
  double number(int n) const { return n * pi / height_; }
  static double sign(int n) { return n % 2 == 0 ? 1.0 : -1.0; }
  double norm(int n) const { return n == 0 ? height_ : 0.5 * height_; }

  /// Slope of f_n, 1 at its own side and 0 at the other, at either; outwards.
  double own_slope(int n) const {
    return n == 0 ? 0.5 / half_ : number(n) / std::tanh(2.0 * number(n) * half_);
  }
  double other_slope(int n) const {
    return n == 0 ? 0.5 / half_ : number(n) / std::sinh(std::min(600.0, 2.0 * number(n) * half_));
  }
  /// Integral of f_n times the bottom's velocity, f_n of the side x = half.
  double push(int n) const {
    if (mode_ == sway) return 0.0;
    const double q = number(n), b = half_;
    if (mode_ == heave) return n == 0 ? b : std::tanh(q * b) / q;
    return n == 0 ? b * b / 3.0 : b / (q * std::tanh(q * b)) - 1.0 / (q * q);
  }
  /// Of phi_p.
  double particular_push() const {
    const double b = half_, d = height_;
    if (mode_ == sway) return 0.0;
    if (mode_ == heave) return b * d - b * b * b / (3.0 * d);
    return b * b * b * (d / 3.0 - b * b / (15.0 * d));
  }
  /// Integral of phi_p cos(n pi s/d) at the side x = +-half.
  double particular(double side, int n) const {
    const double b = half_, d = height_;
    if (mode_ == sway) return 0.0;
    if (mode_ == heave) {
      return n == 0 ? d * d / 6.0 - 0.5 * b * b : sign(n) / std::pow(number(n), 2);
    }
    return side * b * (n == 0 ? (d * d - b * b) / 6.0 : sign(n) / std::pow(number(n), 2));
  }
  /// Integral of dphi_p/dx cos(alpha s) at the side x = +-half.
  Complex particular_slope(double side, Complex alpha) const {
    const double b = half_, d = height_;
    const Complex sine = std::sin(alpha * d), cosine = std::cos(alpha * d);
    if (mode_ == sway) return 0.0;
    if (mode_ == heave) return -side * b / d * sine / alpha;
    const Complex square =
        d * d * sine / alpha + 2.0 * d * cosine / (alpha * alpha) - 2.0 * sine / std::pow(alpha, 3);
    return (square - b * b * sine / alpha) / (2.0 * d);
  }

 private:
  double half_, height_;
  DegreeOfFreedom mode_;
};

/// The water on one side, +1 right, -1 left, as Galerkin's method sees it from beneath.
struct WaterBeside {
  MatrixXcd overlap;      ///< of cosines (rows) and Z
  VectorXcd admittance;   ///< amplitude of Z for a velocity towards +x
  VectorXcd velocity;     ///< of the box and of phi_p, on each Z
  VectorXcd on_the_side;  ///< integral of Z times the side's velocity
};

/// @param even_over half the width over which the water goes on as its own image; infinite: open.
WaterBeside make_water(const RectangularSection& section, DegreeOfFreedom mode, double side,
                       const std::vector<Complex>& roots, double even_over) {
  const WaterBeneath beneath(section, mode);
  const double h = section.depth, d = beneath.height();
  const auto count = static_cast<Eigen::Index>(roots.size());
  WaterBeside water{MatrixXcd(count, count), VectorXcd(count), VectorXcd(count), VectorXcd(count)};
  for (Eigen::Index m = 0; m < count; ++m) {
    const Complex alpha = roots[m];
    const Complex scale = m == 0 ? std::cos(alpha * h) : 1.0;
    const Complex above = mode == sway
                              ? (std::sin(alpha * h) - std::sin(alpha * d)) / alpha
                              : (std::cos(alpha * d) - std::cos(alpha * h)) / (alpha * alpha) -
                                    (h - d) * std::sin(alpha * d) / alpha;
    water.on_the_side[m] = mode == heave ? 0.0 : above / scale;
    water.velocity[m] = water.on_the_side[m] + beneath.particular_slope(side, alpha) / scale;
    const Complex norm = (0.5 * h + std::sin(2.0 * alpha * h) / (4.0 * alpha)) / (scale * scale);
    const Complex way = alpha * even_over;
    const Complex image = way.real() > 20.0 ? 1.0 : std::tanh(way);
    water.admittance[m] = -side / (norm * alpha * (std::isinf(even_over) ? 1.0 : image));
    for (Eigen::Index n = 0; n < count; ++n) {
      const double q = beneath.number(static_cast<int>(n));
      water.overlap(n, m) = WaterBeneath::sign(static_cast<int>(n)) * alpha * std::sin(alpha * d) /
                            ((alpha * alpha - q * q) * scale);
    }
  }
  return water;
}

/// What stands beneath the box, for each cosine.
struct SeriesBeneath {
  SeriesBeneath(const RectangularSection& section, DegreeOfFreedom mode, int terms)
      : own(terms + 1),
        other(terms + 1),
        norm(terms + 1),
        push(terms + 1),
        at_left(terms + 1),
        at_right(terms + 1) {
    const WaterBeneath beneath(section, mode);
    for (int n = 0; n <= terms; ++n) {
      own[n] = beneath.own_slope(n);
      other[n] = beneath.other_slope(n);
      norm[n] = beneath.norm(n);
      push[n] = WaterBeneath::sign(n) * beneath.push(n);
      at_left[n] = beneath.particular(-1.0, n);
      at_right[n] = beneath.particular(1.0, n);
    }
  }

  VectorXcd own, other;  ///< slopes of f_n at its side and at the other
  VectorXd norm;
  VectorXcd push;               ///< of f_n on the bottom
  VectorXcd at_left, at_right;  ///< phi_p
};

/// Values of phi - phi_p at both sides beneath the box.
struct SideValues {
  VectorXcd left, right;
};

// Beneath, velocities towards +x follow from the values; with the waters' amplitudes they give the
// values back.
SideValues solve(const SeriesBeneath& beneath, const WaterBeside& left, const WaterBeside& right) {
  const MatrixXcd from_left = left.overlap * left.admittance.asDiagonal();
  const MatrixXcd from_right = right.overlap * right.admittance.asDiagonal();
  const MatrixXcd to_left = from_left * left.overlap.transpose();
  const MatrixXcd to_right = from_right * right.overlap.transpose();
  const Eigen::Index count = beneath.norm.size();
  MatrixXcd matrix(2 * count, 2 * count);
  matrix << to_left * beneath.own.asDiagonal(), -(to_left * beneath.other.asDiagonal()),
      to_right * beneath.other.asDiagonal(), -(to_right * beneath.own.asDiagonal());
  matrix.diagonal().head(count) += beneath.norm;
  matrix.diagonal().tail(count) += beneath.norm;
  VectorXcd known(2 * count);
  known << from_left * left.velocity - beneath.at_left,
      from_right * right.velocity - beneath.at_right;
  const VectorXcd values = algebra::LuFactors<Complex>(matrix).solve(known);
  return {values.head(count), values.tail(count)};
}

/// Integral of phi times the side's velocity, given the slopes beneath towards +x.
Complex push_on_side(const WaterBeside& water, const VectorXcd& slopes) {
  const VectorXcd velocity = water.overlap.transpose() * slopes + water.velocity;
  return water.on_the_side.cwiseProduct(water.admittance.cwiseProduct(velocity)).sum();
}

}  // namespace

Complex calc_section_force(const RectangularSection& section, DegreeOfFreedom mode,
                           double frequency, double gravity, int terms) {
  const double wave_number =
      calc_wave_number(frequency, {.gravity = gravity, .depth = section.depth});
  const auto roots_at = [&](double rate) {
    return find_roots(section.depth, std::pow(Complex(frequency, -rate), 2) / gravity, wave_number,
                      terms);
  };
  const WaterBeside left =
      make_water(section, mode, -1.0, roots_at(section.lid_rate), 0.5 * section.gap);
  const WaterBeside right =
      make_water(section, mode, 1.0, roots_at(0.0), std::numeric_limits<double>::infinity());
  const SeriesBeneath beneath(section, mode, terms);
  const SideValues value = solve(beneath, left, right);
  // In roll the bottom's velocity is odd.
  const double odd = mode == roll ? -1.0 : 1.0;
  const Complex bottom = WaterBeneath(section, mode).particular_push() +
                         beneath.push.cwiseProduct(value.right + odd * value.left).sum();
  const VectorXcd left_slopes =
      beneath.other.cwiseProduct(value.right) - beneath.own.cwiseProduct(value.left);
  const VectorXcd right_slopes =
      beneath.own.cwiseProduct(value.right) - beneath.other.cwiseProduct(value.left);
  return bottom + push_on_side(left, left_slopes) - push_on_side(right, right_slopes);
}

}  // namespace blocklift::dynamics::examples
