#pragma once

#include <cmath>

#include "dynamics/marine/green/patched_polynomials.h"

namespace blocklift::dynamics {

/// The one integral of two variables that waves over deep water ask for,
///
///   I(X, Y) = PV int from 0 to infinity of exp(-t Y) J0(t X)/(t - 1) dt,    X, Y >= 0,
///
/// X being the level distance and Y that below the surface's image, both times the wave number.
/// With rho = sqrt(X^2 + Y^2)
///
///   I = -pi exp(-Y) Y0(X) - W,  W = int from 0 to infinity of exp(-u)/sqrt(X^2 + (Y - u)^2) du,
///   dI/dY = -I - 1/rho,
///
/// and I + exp(-Y) J0(X) ln rho is analytic in rho and Y/rho, up to the origin. Polynomials on
/// patches take that up to rho = 19, and rho W beyond; the error is below 2e-8 of 1/rho or 1.
/// Sources: Havelock (1955) for the finite integral; Newman (1985), J. Engineering Mathematics 19,
/// and Telste and Noblesse (1986), J. Ship Research 30, for the idea of regions.
class DeepWaterIntegral {
 public:
  /// The tables, made once for the process.
  static const DeepWaterIntegral& tables();

  /// Up to there a point needs no Bessel functions of the second kind.
  static constexpr double near = 19.0;
  /// Below it exp(-Y) is nothing, and so are the waves.
  static constexpr double no_waves = 18.0;

  struct Value {
    double value, along_X;
  };
  /// @param decay exp(-Y).
  /// @param J0, J1 of X.
  [[gnu::always_inline]] inline Value at_near(double X, double Y, double rho, double decay,
                                              double J0, double J1) const {
    const double c = Y / rho, s = X / rho, logarithm = std::log(rho);
    const PatchedSurface::Value even = near_.at(rho, c);
    return {even.value - decay * J0 * logarithm,
            s * (even.along_x - c / rho * even.along_y) + decay * (J1 * logarithm - J0 * s / rho)};
  }
  /// W and dW/dX for rho beyond `near`.
  [[gnu::always_inline]] inline Value at_far(double X, double Y, double rho) const {
    const double c = Y / rho, s = X / rho, inverse = 1.0 / rho;
    const PatchedSurface::Value w = far_.at(near * inverse, c);
    return {w.value * inverse,
            -s * inverse * inverse * (w.value + near * inverse * w.along_x + c * w.along_y)};
  }

 private:
  DeepWaterIntegral();
  PatchedSurface near_;  ///< I + exp(-Y) J0(X) ln rho over rho and Y/rho
  PatchedSurface far_;   ///< rho W over near/rho and Y/rho
};

}  // namespace blocklift::dynamics
