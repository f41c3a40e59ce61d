#pragma once

#include <string_view>

namespace blocklift::dynamics {

/// Index of a body within its mechanism; 0 is the world. Parents have smaller indices than
/// children.
using BodyIndex = int;
inline constexpr BodyIndex world_index = 0;
inline constexpr std::string_view world_name = "world";

}  // namespace blocklift::dynamics
