#pragma once

#include <filesystem>

#include "pipeline/simulation/mechanism_run.h"

namespace blocklift::pipeline {

/// Writes results.h5, summary.json and report.html into a folder (made if missing) and, if asked,
/// results.csv: columns of time and outputs, units in the header. Each file appears whole or not at
/// all.
/// @throws ResultsError, std::runtime_error if they cannot be written.
void write_mechanism_results(const MechanismFile& file, const MechanismRun& run,
                             const std::filesystem::path& folder, bool with_csv);

/// Attributes of the group /statistics: what an integration cost.
void write_statistics(ResultsWriter& file, const dynamics::IntegrationStatistics& statistics);

}  // namespace blocklift::pipeline
