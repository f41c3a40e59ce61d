#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace blocklift::structure {

/// The candidate that is most probably meant by a mistyped name: the nearest by the number of
/// inserted, lost, changed and swapped letters, letter case counting little. Empty if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace blocklift::structure
