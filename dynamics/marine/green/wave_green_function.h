#pragma once

#include <complex>
#include <span>

#include "dynamics/marine/green/patched_polynomials.h"
#include "dynamics/marine/waves/waves.h"

namespace blocklift::dynamics {

/// The waves of a pulsating source of unit strength, Re(G exp(i w t)), in water of any depth h.
///
/// With R the level distance of field point and source, z and zeta their heights, r, r1 and r2 the
/// distances from the source, its image in z = 0 and its image in the bottom z = -h,
///
///   G = 1/r + 1/r1 + 1/r2 + g        (without 1/r2 in deep water),
///
/// G satisfies dG/dz = w^2/g G in z = 0, dG/dz = 0 at the bottom, and goes outwards far away. The
/// three distances are panels' (add_panel_potentials); g is what this class knows. Since cosh a
/// cosh b = (cosh(a + b) + cosh(a - b))/2, the defining integral is the sum of one function of two
/// variables at two places,
///
///   L(R, v) = PV int of (m + K) exp(-m h) cosh(m v)/(m sinh(m h) - K cosh(m h)) J0(m R) dm,
///   1/r1 + g = L(R, 2 h + z + zeta) + L(R, z - zeta) - 2 pi i N f(z) f(zeta) J0(k R),
///
/// K = w^2/g = k tanh(k h), f(z) = cosh(k (z + h))/cosh(k h), N = k^2/((k^2 - K^2) h + K). The
/// first is 1/r1 and 2 K times DeepWaterIntegral, but for a remainder that is as smooth as the
/// water is deep. Remainder and second are tabulated by polynomials on patches, for each frequency,
/// from quadratures in m that give all places by one product of matrices. Errors are below 1e-6 of
/// the larger of K, 1/h and 1/r1. Source: Wehausen and Laitone (1960), equations 13.17 and 13.18.
class WaveGreenFunction {
 public:
  /// @param frequency rad/s; infinite: the limit, in which g + 2/r1 is returned for g.
  /// @param reach largest level distance, m. @param deepest lowest point of all, m below z = 0.
  /// @throws ModelError if a number is not positive, or the lowest point is below the bottom.
  WaveGreenFunction(const Water& water, double frequency, double reach, double deepest);

  double wave_number() const { return k_; }       ///< rad/m
  double deep_wave_number() const { return K_; }  ///< w^2/g, rad/m

  /// A height, with what depends on it alone.
  struct Level {
    double z = 0.0;        ///< m
    double decay = 1.0;    ///< exp(K z)
    double profile = 1.0;  ///< f(z)
    double slope = 0.0;    ///< df/dz, 1/m
  };
  Level level(double z) const;

  /// Field point against source. All but g are 1/m2.
  struct Value {
    std::complex<double> g;        ///< 1/m
    std::complex<double> along_R;  ///< dg/dR
    /// dg/dz and dg/dzeta, in both of which 2 K/r1 is left out, which is a panel's to integrate.
    std::complex<double> along_z, along_zeta;
  };
  Value at(double R, const Level& field, const Level& source) const;
  /// At many places, values[k] of distances[k], fields[k] and one source.
  void at(std::span<const double> distances, std::span<const Level> fields, const Level& source,
          std::span<Value> values) const;

 private:
  void make_tables(double reach, double deepest);

  double depth_;
  double K_ = not_a_number, k_ = not_a_number;
  double strength_ = 0.0;  ///< 2 pi N, rad/m
  bool deep_ = false, infinite_ = false;
  PatchedCurve J0_, Y0_;
  PatchedSurface remainder_;   ///< over R and -(z + zeta)
  PatchedSurface difference_;  ///< L over R and |z - zeta|
};

}  // namespace blocklift::dynamics
