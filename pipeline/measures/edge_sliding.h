#pragma once

#include <cstddef>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Where friction would hold a rope on an edge sideways, at each sample of a history; not numbers
/// where it does not press.
struct SidewaysHold {
  Eigen::VectorXd place;  ///< middle of the touch from the edge's begin, m
  /// What the rope there pulls along the edge over what it presses against it; above the friction
  /// it slides.
  Eigen::VectorXd pull;
  Eigen::VectorXd slid;  ///< of the computed place, which friction does not hold, from `place`, m
};

/// The motion lets ropes slide sideways without friction, to where their path is shortest. Here the
/// rope lies where it came to the edge, at the computed places of its neighbours and tensions of
/// its spans T_1 and T_2. Its force on the edge, F = T_2 u_2 - T_1 u_1, has a part along the axis
/// and one across it. While |F_along| <= mu |F_across| it stays there; else it is dragged along the
/// edge until that holds (Coulomb, quasi-static, by samples).
SidewaysHold hold_sideways(const dynamics::Rope& rope, const dynamics::History& history,
                           std::size_t rope_index, std::size_t edge);

}  // namespace blocklift::pipeline
