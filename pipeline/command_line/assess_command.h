#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// `blocklift assess CASE`: the whole way from a case to its report.
/// @param output folder of the results; none: `results/<name of the case>` in the working folder.
/// @param decks write the governing load cases as decks for other solvers, too.
/// @param expect file of figures that the lift is held to; none: it is held to its checks alone.
/// @param set keys that are to have other values, as read_asked_changes takes them.
/// @returns the exit code: 0 the lift passes, 3 it fails a check or an expected figure is off, 2
///   the output is no folder. What else goes wrong is thrown: InputError for the input, anything
///   else for the run.
int assess_case(const std::string& path, const std::optional<std::string>& output, bool decks,
                const std::optional<std::string>& expect, const std::vector<std::string>& set);

/// `blocklift report FOLDER`: makes report.html again from the results in a folder.
/// @param frames so many instants for ParaView, too.
/// @returns the exit code: 2 if there are no results that can be read.
int report_results(const std::string& folder, const std::optional<int>& frames);

}  // namespace blocklift::pipeline
