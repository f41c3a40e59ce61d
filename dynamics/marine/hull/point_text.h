#pragma once

#include <string>

#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// A point for messages, "(x, y, z) m".
std::string text_of_point(const Vector3& p);

}  // namespace blocklift::dynamics
