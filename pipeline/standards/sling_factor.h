#pragma once

#include <optional>
#include <string>

#include "pipeline/files/standard/standard_rules.h"

namespace blocklift::pipeline {

/// What the safety factor of a sling depends on.
struct SlingChoice {
  std::string material, wear, termination;  ///< as the rules name them
  std::optional<double> diameter_ratio;     ///< D/d of the sharpest bend; none: it is not bent
  /// E/T, the environment's share of the load by a detailed analysis; 0 without.
  double environment_share = 0;
};

/// Safety factor of a sling with its parts. Source: GL Noble Denton 0027/ND rev. 11.2 (2016), 7.3.
struct SlingFactor {
  double load = 1, consequence = 1, bending = 1, termination = 1, wear = 1, material = 1;
  double floor = 1;      ///< that stands for load x consequence x material at least
  double reduction = 1;  ///< the larger of bending and termination
  double by_parts = 1;   ///< load x consequence x reduction x wear x material
  double by_floor = 1;   ///< floor x reduction x wear
  double factor = 1;     ///< the larger of both
  bool is_by_floor() const { return by_floor >= by_parts; }
};

/// @throws std::out_of_range if the rules do not have a name that the choice makes.
SlingFactor sling_factor(const SlingRules& rules, const SlingChoice& choice);

/// 1 / (1 - half / sqrt(D/d)).
double bending_factor(double half, double diameter_ratio);

/// What a bend round D leaves of the breaking load of a wire rope of the diameter d (m),
/// 1 - 0.5 / sqrt(D/d). Source: GL Noble Denton 0027/ND rev. 11.2 (2016), 7.8.1, after IMCA M 179.
double bend_efficiency(double bend_diameter, double diameter);

}  // namespace blocklift::pipeline
