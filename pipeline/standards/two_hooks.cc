#include "pipeline/standards/two_hooks.h"

#include <algorithm>
#include <cmath>

namespace blocklift::pipeline {

double share_of_hook(const TwoHooks& hooks, double tilt) {
  const double s = std::sin(tilt), c = std::cos(tilt);
  return ((hooks.other_height + hooks.vertical_tolerance) * s +
          (hooks.other_along + hooks.level_tolerance) * c) /
         (hooks.span() * c + (hooks.other_height - hooks.height) * s);
}

double tilt_factor(const TwoHooks& hooks, double tilt) {
  const double level = share_of_hook(hooks, 0);
  return std::max({1.0, share_of_hook(hooks, tilt) / level, share_of_hook(hooks, -tilt) / level});
}

}  // namespace blocklift::pipeline
