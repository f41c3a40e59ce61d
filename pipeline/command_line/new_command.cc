#include "pipeline/command_line/new_command.h"

#include <fmt/format.h>

#include "pipeline/processes/exit_code.h"
#include "pipeline/templates/new_case.h"

namespace blocklift::pipeline {

int write_new(const std::string& kind, const std::string& folder) {
  const std::string command = write_new_case(kind, folder);
  fmt::print("written: {}\nrun it: {}\n", folder, command);
  return exit_code::done;
}

}  // namespace blocklift::pipeline
