#pragma once

#include <string>

#include "tests/pipeline/run_program.h"

namespace blocklift::pipeline::test {

/// Runs the program in the working directory, with arguments as the shell reads them.
inline Outcome run_blocklift(const std::string& arguments) {
  return run_program(BLOCKLIFT_EXECUTABLE, arguments);
}

}  // namespace blocklift::pipeline::test
