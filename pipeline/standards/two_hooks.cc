#include "pipeline/standards/two_hooks.h"

#include <algorithm>
#include <cmath>

namespace blocklift::pipeline {

namespace {

/// Level distances of the centre from the plumb lines through this hook and the other one.
struct Levers {
  double own = 0, other = 0;
};

Levers levers_of(const TwoHooks& hooks, double tilt) {
  const double s = std::sin(tilt), c = std::cos(tilt), slope = std::tan(tilt);
  const SpreadOfHook &own = hooks.spread, &other = hooks.other_spread;
  // Both plumb lines lean to the same side within the load: this hook's to the other, if it is up.
  const double towards = std::clamp(own.height * slope, -own.away, own.towards);
  const double away = std::clamp(other.height * slope, -other.towards, other.away);
  return {(hooks.along - towards) * c - hooks.height * s - hooks.level_tolerance * c -
              hooks.vertical_tolerance * s,
          (hooks.other_along + away) * c + hooks.other_height * s + hooks.level_tolerance * c +
              hooks.vertical_tolerance * s};
}

double share_of(const Levers& levers) { return levers.other / (levers.own + levers.other); }

/// Of ropes, which do not press.
double share_of_ropes(const Levers& levers) {
  if (!(levers.own > 0)) return 1;
  return levers.other > 0 ? share_of(levers) : 0;
}

}  // namespace

std::optional<double> tilt_angle(const TwoHooks& hooks, double angle,
                                 std::optional<double> height) {
  if (!height) return angle;
  if (!(*height < hooks.span())) return std::nullopt;
  return std::max(angle, std::asin(*height / hooks.span()));
}

double share_of_hook(const TwoHooks& hooks, double tilt) {
  return share_of(levers_of(hooks, tilt));
}

double tilt_factor(const TwoHooks& hooks, std::optional<double> tilt) {
  const double level = share_of_ropes(levers_of(hooks, 0));
  if (!tilt) return 1 / level;
  return std::max({1.0, share_of_ropes(levers_of(hooks, *tilt)) / level,
                   share_of_ropes(levers_of(hooks, -*tilt)) / level});
}

}  // namespace blocklift::pipeline
