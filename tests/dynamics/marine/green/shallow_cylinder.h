#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

namespace blocklift::dynamics::test {

/// A truncated vertical cylinder in water of a depth, by matched eigenfunctions (Yeung 1981,
/// Applied Ocean Research 3): surge, heave, and pitch about the water line, A - i B/w over rho, in
/// m3 and m5.
///
/// With zeta the height over the bottom and s the water under the cylinder, of unit velocities:
/// beneath it a_0/2 R_0 + sum a_n R_n(r) cos(n pi zeta/s), in heave (zeta^2 - r^2/2)/(2 s) and in
/// pitch (r^3/4 - zeta^2 r)/(2 s) besides; around it sum b_k S_k(r) Z_k(zeta), Z_0 of the
/// travelling wave, Z_k of those that decay, of which the mean square over the depth is 1.
/// Potential and radial velocity are the same at the radius.
class ShallowCylinder {
 public:
  /// @param radius, draught, depth m. @param gravity m/s2.
  ShallowCylinder(double radius, double draught, double depth, double gravity)
      : a_(radius), h_(depth), s_(depth - draught), gravity_(gravity) {}

  std::complex<double> surge(double w) const { return solve(w, Motion::surge); }
  std::complex<double> heave(double w) const { return solve(w, Motion::heave); }
  std::complex<double> pitch(double w) const { return solve(w, Motion::pitch); }
  /// Of the travelling wave, rad/m.
  double wave_number(double w) const {
    const auto excess = [&](double k) { return gravity_ * k * std::tanh(k * h_) - w * w; };
    double low = 0.0, high = w * w / gravity_ + w / std::sqrt(gravity_ * h_);
    return bisect(excess, low, high);
  }

 private:
  using Complex = std::complex<double>;
  static constexpr int beneath = 40;
  enum class Motion { surge, heave, pitch };

  template <class Function>
  static double bisect(const Function& f, double low, double high) {
    for (int step = 0; step < 200; ++step) {
      const double middle = 0.5 * (low + high);
      (f(low) * f(middle) <= 0.0 ? high : low) = middle;
    }
    return 0.5 * (low + high);
  }

  /// What one vertical function of the water around is.
  struct Outer {
    Complex ratio;            ///< S_k over its slope at the radius, m
    Eigen::VectorXd overlap;  ///< integral of Z_k cos(n pi zeta/s) over the gap, m
    double side;              ///< integral of Z_k over the side, m
    double square;            ///< integral of zeta^2 Z_k over the gap, m3
    double arm;               ///< integral of (zeta - h) Z_k over the side, m2
  };

  Outer travelling(double w, bool heaves) const {
    const double m = wave_number(w), x = m * a_;
    const double norm = std::sqrt(0.5 * (1.0 + std::sinh(2.0 * m * h_) / (2.0 * m * h_)));
    const auto H = [&](double n) {
      return Complex(std::cyl_bessel_j(n, x), -std::cyl_neumann(n, x));
    };
    Outer outer{
        heaves ? -H(0) / (m * H(1)) : H(1) / (m * (H(0) - H(1) / x)), Eigen::VectorXd(beneath),
        (std::sinh(m * h_) - std::sinh(m * s_)) / (m * norm),
        ((s_ * s_ / m + 2.0 / (m * m * m)) * std::sinh(m * s_) -
         2.0 * s_ / (m * m) * std::cosh(m * s_)) /
            norm,
        ((h_ - s_) * std::sinh(m * s_) - (std::cosh(m * h_) - std::cosh(m * s_)) / m) / (m * norm)};
    for (int n = 0; n < beneath; ++n)
      outer.overlap[n] = sign(n) * m * std::sinh(m * s_) / (m * m + lambda(n) * lambda(n)) / norm;
    return outer;
  }
  Outer decaying(double w, int k, bool heaves) const {
    constexpr double pi = std::numbers::pi;
    const double m =
        bisect([&](double q) { return gravity_ * q * std::sin(q * h_) + w * w * std::cos(q * h_); },
               (k - 0.5) * pi / h_, k * pi / h_);
    const double x = m * a_;
    const double norm = std::sqrt(0.5 * (1.0 + std::sin(2.0 * m * h_) / (2.0 * m * h_)));
    const double K0 = std::cyl_bessel_k(0.0, x), K1 = std::cyl_bessel_k(1.0, x);
    Outer outer{
        heaves ? -K0 / (m * K1) : -K1 / (m * (K0 + K1 / x)), Eigen::VectorXd(beneath),
        (std::sin(m * h_) - std::sin(m * s_)) / (m * norm),
        ((s_ * s_ / m - 2.0 / (m * m * m)) * std::sin(m * s_) +
         2.0 * s_ / (m * m) * std::cos(m * s_)) /
            norm,
        ((h_ - s_) * std::sin(m * s_) + (std::cos(m * h_) - std::cos(m * s_)) / m) / (m * norm)};
    for (int n = 0; n < beneath; ++n)
      outer.overlap[n] = sign(n) * m * std::sin(m * s_) / (m * m - lambda(n) * lambda(n)) / norm;
    return outer;
  }

  Complex solve(double w, Motion motion) const {
    const bool heaves = motion == Motion::heave, pitches = motion == Motion::pitch;
    std::vector<Outer> around{travelling(w, heaves)};
    const int decaying_count = static_cast<int>(std::ceil(beneath * h_ / s_));
    for (int k = 1; k <= decaying_count; ++k) around.push_back(decaying(w, k, heaves));
    // Of each function beneath: radial velocity at the radius, and what of it presses the bottom.
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(beneath), flux = slope, own = slope;
    slope[0] = heaves ? 0.0 : 0.5 / a_;
    flux[0] = heaves ? 0.25 * a_ * a_ : a_ * a_ * a_ / 8.0;
    own[0] = heaves ? s_ * s_ / 6.0 - a_ * a_ / 4.0 : a_ * (a_ * a_ / 8.0 - s_ * s_ / 6.0);
    for (int n = 1; n < beneath; ++n) {
      const double l = lambda(n), x = l * a_;
      const double ratio = std::cyl_bessel_i(1.0, x) / std::cyl_bessel_i(0.0, x);
      slope[n] = heaves ? l * ratio : l * (1.0 / ratio - 1.0 / x);
      // I_2 = I_0 - 2 I_1/x.
      flux[n] = sign(n) * a_ / l * (heaves ? ratio : a_ * (1.0 / ratio - 2.0 / x));
      own[n] = sign(n) / (l * l) * (heaves ? 1.0 : -a_);
    }
    if (motion == Motion::surge) own.setZero();
    // What the hull's side, and beneath it the function that moves with the bottom, give.
    const auto given = [&](const Outer& outer) {
      if (heaves) return -a_ / (2.0 * s_) * outer.overlap[0];
      if (!pitches) return outer.side;
      return outer.arm + (0.75 * a_ * a_ * outer.overlap[0] - outer.square) / (2.0 * s_);
    };
    // a_n = 2/s (sum b_k S_k overlap_kn - own_n), b_k = (given_k + sum overlap_kn slope_n a_n)/h.
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Identity(beneath, beneath);
    Eigen::VectorXcd right = -2.0 / s_ * own.cast<Complex>();
    for (const Outer& outer : around) {
      const Eigen::VectorXcd lifted = 2.0 / (s_ * h_) * outer.ratio * outer.overlap.cast<Complex>();
      matrix -= lifted * outer.overlap.cwiseProduct(slope).transpose().cast<Complex>();
      right += lifted * given(outer);
    }
    const Eigen::VectorXcd inner = matrix.partialPivLu().solve(right);
    const Complex through_bottom = (flux.cast<Complex>().transpose() * inner)(0);
    if (heaves) {
      const double even = (s_ * s_ * a_ * a_ / 2.0 - std::pow(a_, 4) / 8.0) / (2.0 * s_);
      return 2.0 * std::numbers::pi * (even + through_bottom);
    }
    Complex pressed = 0.0;
    for (const Outer& outer : around) {
      const Complex along =
          (outer.overlap.cwiseProduct(slope).cast<Complex>().transpose() * inner)(0);
      pressed -= outer.ratio * (pitches ? outer.arm : outer.side) * (given(outer) + along) / h_;
    }
    if (!pitches) return std::numbers::pi * a_ * pressed;
    const double even = (s_ * s_ * std::pow(a_, 4) / 4.0 - std::pow(a_, 6) / 24.0) / (2.0 * s_);
    return std::numbers::pi * (a_ * pressed + even - through_bottom);
  }

  static double sign(int n) { return n % 2 == 0 ? 1.0 : -1.0; }
  double lambda(int n) const { return n * std::numbers::pi / s_; }

  double a_, h_, s_, gravity_;
};

}  // namespace blocklift::dynamics::test
