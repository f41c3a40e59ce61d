#pragma once

#include <algorithm>

namespace blocklift::dynamics {

/// Positive where a one-sided element acts, negative where it does not, continuous between, N.
/// One-sided are ropes and tugger lines, which pull and never push, and pads, which push and never
/// pull.
/// @param elastic_force F, N; negative where a rope is slack or a pad is off the ground.
/// @param damping_force D, N.
inline double one_sided_indicator(double elastic_force, double damping_force) {
  return elastic_force + std::min(0.0, damping_force);
}

/// Force of a one-sided element that is known to act or not, N: F + D, or nothing.
inline double one_sided_force(double elastic_force, double damping_force, bool acts) {
  return acts ? elastic_force + damping_force : 0.0;
}

/// The one law of all of them, N: F + D where F + min(0, D) > 0, else nothing. So damping alone
/// never acts, and takes away no more than the elastic force.
inline double one_sided_force(double elastic_force, double damping_force) {
  return one_sided_force(elastic_force, damping_force,
                         one_sided_indicator(elastic_force, damping_force) > 0.0);
}

}  // namespace blocklift::dynamics
