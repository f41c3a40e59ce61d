#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace blocklift::dynamics {

/// The waves that bodies send out, far away: in the direction theta, at the distance R from the
/// origin, the surface's elevation is
///
///   eta = Re a H(theta) exp(i (w t - k R)) / sqrt(R),
///
/// a being the amplitude of a mode's motion (m, rad) or of the wave that is scattered (m). The
/// Kochin function, scaled as an elevation. Source: Newman (1967), J. Ship Research 11.
struct FarField {
  std::vector<double> directions;  ///< theta, rad, evenly round a whole turn from 0
  /// For each frequency: directions x 6N, of unit motion; m^(1/2), m^(3/2) for rotations.
  std::vector<Eigen::MatrixXcd> radiated;
  /// For each frequency: directions x headings, bodies held in a wave of unit amplitude; m^(1/2).
  std::vector<Eigen::MatrixXcd> scattered;

  bool empty() const { return directions.empty(); }
};

/// The far field of one frequency as a Fourier series over the direction,
///   H(theta) = sum over m of a_m exp(-i m theta).
class DirectionalWaves {
 public:
  /// @param values H at even directions round a whole turn from 0, an odd number of them.
  explicit DirectionalWaves(const Eigen::VectorXcd& values);

  std::complex<double> at(double direction) const;
  std::complex<double> slope(double direction) const;  ///< dH/dtheta
  /// Integrals over the directions of |H|^2, |H|^2 cos, |H|^2 sin, m.
  struct Moments {
    double whole, along_x, along_y;
  };
  Moments integrate() const;
  /// Integral of i conj(H) dH/dtheta: of the waves' angular momentum, m.
  double integrate_turning() const;

 private:
  int order_;                      ///< m runs from -order to order
  Eigen::VectorXcd coefficients_;  ///< a_m
};

/// How many directions a far field needs: twice the harmonics that bodies within `reach` (m) of the
/// origin send out in waves of this number (rad/m), and one.
int direction_count(double reach, double wave_number);

}  // namespace blocklift::dynamics
