#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

/// A natural mode under a name that it keeps when the lift changes a little.
struct LastingMode {
  std::string name;  ///< "load: roll about x", "load: roll about x, no. 2"
  const nlohmann::ordered_json* row = nullptr;  ///< of the summary's list
  /// More than half of the energy is that of loads, spreaders and vessels.
  bool is_leading = false;
};

/// The modes of one instant that a load, a spreader or a vessel leads. Their full names also tell
/// which hooks of cranes go along: of two that go equally far either one, by the slightest
/// difference. Here a mode is named by its leading body (of such as lead equally, the first in the
/// alphabet) and its motion alone; an axis between x and y is "aslant". Modes of one name are
/// numbered by their periods, the slowest first, which change steadily where the lift does.
///
/// Hooks and hoists alone swing so fast that they carry nothing along, and take one another's
/// names: they have none here.
/// @param list an array of the summary; one of other things than modes has none.
std::vector<LastingMode> lasting_modes(const nlohmann::ordered_json& list);

}  // namespace blocklift::pipeline
