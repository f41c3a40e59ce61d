#pragma once

#include <string>
#include <vector>

namespace blocklift::pipeline {

/// A value of an input file: where it stands ("cranes.C1.start.gantry", lists counted from 1) and
/// what stands there, as it was written.
struct InputValue {
  std::string key;
  std::string value;
};

/// All values of a YAML text in its order. Lists of plain values are one value, "[a, b]". A text
/// that is not YAML has none.
std::vector<InputValue> list_input_values(const std::string& yaml);

}  // namespace blocklift::pipeline
