#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `blocklift measured` is told.
struct MeasuredOptions {
  std::string result;                              ///< folder of results, or a case
  std::vector<std::string> records;                ///< CSV files
  std::vector<double> shifts;                      ///< s, one for all records or one for each
  std::optional<std::string> window, decay, rest;  ///< "FROM:TO", s of the lift
  std::string accuracy = "1 %";                    ///< of a load cell
  std::optional<std::string> page;                 ///< an HTML page to write
  bool json = false;
};

/// `blocklift measured RESULT RECORD ...`: records of load cells, inclinometers, anemometers and
/// waves beside a computed lift. @returns the exit code. @throws InputError.
int show_measured(const MeasuredOptions& options);

}  // namespace blocklift::pipeline
