#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace blocklift::pipeline {

/// Checks of one kind, the most utilised first; what is not met stands before what is.
struct CheckGroup {
  std::string name;
  std::vector<const nlohmann::ordered_json*> checks;  ///< at least one, of the list they came from
};

/// Checks of summary.json by the kind of what is checked: the first word of a check's name (rope,
/// hoist, lug, ...), apart for those by a standard, whose name stands before it with a colon.
/// Groups are sorted by what leads in them.
///
/// @param checks an array, which must outlive the groups.
/// @param standard the name of the standard of the summary; empty without.
std::vector<CheckGroup> group_checks(const nlohmann::ordered_json& checks,
                                     const std::string& standard);

/// The check that leads: one that is not met before those that are, then the most utilised.
/// Null if there is none.
const nlohmann::ordered_json* governing_check(const nlohmann::ordered_json& checks);

}  // namespace blocklift::pipeline
