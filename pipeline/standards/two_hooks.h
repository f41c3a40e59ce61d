#pragma once

#include <optional>

namespace blocklift::pipeline {

/// The slings of a hook that spread along the line between both hooks: they hold the load to the
/// hook as one body, which turns about the hook until one of them is slack. Lengths in m.
struct SpreadOfHook {
  double height = 0;   ///< of the hook above the middle of its lift points
  double towards = 0;  ///< reach of its lift points from their middle to the other hook
  double away = 0;     ///< the same away from it
};

/// A load on two hooks seen from the side: where its centre of mass lies against the lift points of
/// the hook at hand and of the other one, and how far off it may lie. Lengths in m.
struct TwoHooks {
  double along = 0;               ///< c: level distance of the centre from this lift point
  double height = 0;              ///< a: of this lift point above the centre
  double other_along = 0;         ///< d: level distance of the centre from the other lift point
  double other_height = 0;        ///< b: of the other lift point above the centre
  double level_tolerance = 0;     ///< x of the centre
  double vertical_tolerance = 0;  ///< z of the centre
  SpreadOfHook spread = {}, other_spread = {};

  double span() const { return along + other_along; }
};

/// The larger of a rule's angle (rad) and of that by which hooks that differ in height tilt the
/// load, arcsin(height / L), L = c + d, both m. None where the hooks are no farther apart than that
/// height: it turns the load upright, and all of it may hang on one of them.
/// Source: GL Noble Denton 0027/ND rev. 11.2 (2016), 5.4.2 and appendix B.1.2, by which the height
/// of 1.0 m governs for L below 19.1 m.
std::optional<double> tilt_angle(const TwoHooks& hooks, double angle, std::optional<double> height);

/// Share of the weight on this hook when the load is tilted by t (rad), this hook being the higher
/// one, from moments about the other lift point:
///   P/W = [(b + z) sin t + (d + x) cos t] / [L cos t + (b - a) sin t],  L = c + d.
/// Source: GL Noble Denton 0027/ND rev. 11.2 (2016), appendix B.1. Where slings spread, h = height
/// of SpreadOfHook, the plumb line through a hook meets the line of its lift points h tan t from
/// their middle, or at the outermost of them, which then bears alone; c and d are up to there.
double share_of_hook(const TwoHooks& hooks, double tilt);

/// The larger share of both ways of a tilt over that of no tilt: 1 at least. No hook bears more
/// than all: once the centre of mass has come under it the other one is slack.
/// @param tilt none: all may hang on this hook.
double tilt_factor(const TwoHooks& hooks, std::optional<double> tilt);

}  // namespace blocklift::pipeline
