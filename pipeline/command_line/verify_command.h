#pragma once

#include <string>
#include <vector>

namespace blocklift::pipeline {

struct VerifyOptions {
  std::vector<std::string> only = {};  ///< patterns of cases; none: all of them
  bool json = false;                   ///< print JSON instead of a table
  bool list = false;                   ///< print the names of the cases, run none
};

/// `blocklift verify`: runs the verification suite and prints each figure beside its reference.
/// @returns the exit code: 0 all figures agree, 1 one does not, 2 a pattern matches no case.
int verify(const VerifyOptions& options);

}  // namespace blocklift::pipeline
