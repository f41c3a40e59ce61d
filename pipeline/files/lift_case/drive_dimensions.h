#pragma once

#include "pipeline/declaration/quantity.h"

namespace blocklift::pipeline {

/// Dimension of the speed of what travels by a length or an angle.
inline Dimension speed_of(Dimension travel) {
  return travel == Dimension::angle ? Dimension::angular_speed : Dimension::speed;
}

/// Dimension of the acceleration.
inline Dimension acceleration_of(Dimension travel) {
  return travel == Dimension::angle ? Dimension::angular_acceleration : Dimension::acceleration;
}

}  // namespace blocklift::pipeline
