#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/comparison/expected_figures.h"

namespace blocklift::pipeline {

/// What `blocklift expect` is told.
struct ExpectOptions {
  std::string result;               ///< a folder of results, or a case
  std::optional<std::string> file;  ///< of the figures; none: standard output
  bool renew = false;               ///< the file is there; take new values where it is off
};

/// `blocklift expect RESULT`: writes the figures of a lift with usual tolerances.
/// @returns the exit code: 2 if the file is there and is not to be renewed. @throws InputError.
int expect(const ExpectOptions& options);

/// Prints which expected figures a summary does not hold, or that it holds all.
/// @returns whether it holds all.
bool figures_are_held(const std::vector<ExpectedFigure>& figures,
                      const nlohmann::ordered_json& summary);

}  // namespace blocklift::pipeline
