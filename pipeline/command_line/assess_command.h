#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `blocklift assess CASE` is asked for.
struct AssessOptions {
  std::string path;                   ///< case file, or a folder of one
  std::optional<std::string> output;  ///< folder; results/<name of the case> if none
  bool decks = false;  ///< write the governing load cases as decks for other solvers, too
  /// File of figures that the lift is held to; none: it is held to its checks alone.
  std::optional<std::string> expect;
  std::vector<std::string> set = {};  ///< keys with other values, as read_asked_changes takes them
  bool anew = false;                  ///< nothing is taken from the cache or put there
};

/// `blocklift assess CASE`: the whole way from a case to its report.
/// @returns the exit code: 0 the lift passes, 3 it fails a check or an expected figure is off, 2
///   the output is no folder. What else goes wrong is thrown: InputError for the input, anything
///   else for the run.
int assess_case(const AssessOptions& options);

/// `blocklift report FOLDER`: makes report.html again from the results in a folder.
/// @param frames so many instants for ParaView, too.
/// @returns the exit code: 2 if there are no results that can be read.
int report_results(const std::string& folder, const std::optional<int>& frames);

}  // namespace blocklift::pipeline
