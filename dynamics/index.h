#pragma once

#include <cstddef>

namespace blocklift::dynamics {

/// Place in a standard container of what mechanisms count with a sign; not negative.
constexpr std::size_t index(std::ptrdiff_t i) { return static_cast<std::size_t>(i); }

}  // namespace blocklift::dynamics
