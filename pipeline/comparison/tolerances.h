#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/quantity.h"

namespace blocklift::pipeline {

/// How far figures of a name may move from one result to another.
struct Tolerance {
  std::string name;  ///< as matches_figure takes it
  std::string text;  ///< as given: "2%", "5 kN"
  Measure limit;     ///< a share where `is_share`, else a difference in SI units
  bool is_share = false;
  Mark mark;
};

/// Whether a name means a figure: its path, whole keys at the path's beginning or end
/// ("ropes.R1", "stress_increase_percent"), or a pattern of the whole path with * and ?. The unit
/// at the end of the last key may be left out ("stress_increase").
bool matches_figure(std::string_view name, std::string_view path);

/// Reads tolerances: "stress_increase=2%,ropes.R1=5 kN", or, without an equals sign, the name of a
/// YAML file with names and tolerances.
/// @throws InputError with all that is wrong.
std::vector<Tolerance> read_tolerances(const std::string& given);

}  // namespace blocklift::pipeline
