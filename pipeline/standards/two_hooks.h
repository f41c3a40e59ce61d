#pragma once

namespace blocklift::pipeline {

/// A load on two hooks seen from the side: where its centre of mass lies against the lift points of
/// the hook at hand and of the other one, and how far off it may lie. Lengths in m.
struct TwoHooks {
  double along = 0;               ///< c: level distance of the centre from this lift point
  double height = 0;              ///< a: of this lift point above the centre
  double other_along = 0;         ///< d: level distance of the centre from the other lift point
  double other_height = 0;        ///< b: of the other lift point above the centre
  double level_tolerance = 0;     ///< x of the centre
  double vertical_tolerance = 0;  ///< z of the centre

  double span() const { return along + other_along; }
};

/// Share of the weight on this hook when the load is tilted by t (rad), this hook being the higher
/// one, from moments about the other lift point:
///   P/W = [(b + z) sin t + (d + x) cos t] / [L cos t + (b - a) sin t],  L = c + d.
/// Source: GL Noble Denton 0027/ND rev. 11.2 (2016), appendix B.1.
double share_of_hook(const TwoHooks& hooks, double tilt);

/// The larger share of both ways of a tilt over that of no tilt: 1 at least.
double tilt_factor(const TwoHooks& hooks, double tilt);

}  // namespace blocklift::pipeline
