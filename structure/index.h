#pragma once

#include <cstddef>

namespace blocklift::structure {

/// Place in a standard container of what meshes and matrices count with a sign; not negative.
constexpr std::size_t at(std::ptrdiff_t i) { return static_cast<std::size_t>(i); }

}  // namespace blocklift::structure
