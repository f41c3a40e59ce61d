#pragma once

#include <vector>

namespace blocklift::dynamics {

/// A point of a rope's curve of tension over strain.
struct TensionPoint {
  double strain = 0.0;   ///< elongation over unstretched length
  double tension = 0.0;  ///< N
};

/// Tension F of a rope over its strain e, where that is no straight line: fibre slings, wire rope
/// that has yet to bed in. Elastic: loading and unloading go the same way.
///
/// The curve goes through given points and is a quadratic spline with a continuous slope
/// (Schumaker 1983). With the chords' slopes d_i, the slope at a point between two chords is their
/// harmonic mean, but that of the one that lies in a line with its neighbour, and at the ends
///   s_0 = d_0^2 / s_1,   s_n = d_n-1^2 / s_n-1.
/// Each chord has a knot where the slope is the chord's own. So points whose chords grow steeper
/// make a curve whose slope nowhere falls, unless two straight parts meet, where it is made smooth;
/// and points in a line make that line, F = EA e. Below no strain and beyond the last point the
/// curve goes on straight, so that the law has no kink.
/// Source: Schumaker (1983), On shape preserving quadratic spline interpolation, SIAM J. Numer.
/// Anal. 20(4).
class TensionLaw {
 public:
  /// @throws ModelError if there are fewer than two points, the first is not (0, 0), strain or
  /// tension do not grow from one point to the next, or a chord is less steep than the one before.
  explicit TensionLaw(const std::vector<TensionPoint>& points);

  double tension(double strain) const;    ///< F, N
  double slope(double strain) const;      ///< dF/de: EA at that strain, N
  double curvature(double strain) const;  ///< d2F/de2, N
  /// int F de from no strain, per unstretched length, N.
  double strain_energy(double strain) const;
  /// e at a tension (N).
  double find_strain(double tension) const { return find_strain(tension, 0.0, 1.0); }
  /// e by which length e + compliance F(e) is the elongation: of a rope of that unstretched length
  /// (m) and a spring in series with it (m/N).
  double find_strain(double elongation, double length, double compliance) const;

 private:
  /// Quadratic from its beginning on.
  struct Piece {
    double strain = 0.0, tension = 0.0, slope = 0.0, curvature = 0.0, energy = 0.0;
  };
  const Piece& piece_at(double strain) const;
  void add_piece(double slope, double end_slope, double length);

  std::vector<Piece> pieces_;  ///< the first and the last are straight, without an end
};

}  // namespace blocklift::dynamics
