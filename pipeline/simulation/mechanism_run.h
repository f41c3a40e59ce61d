#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/simulation/time_integration.h"
#include "pipeline/simulation/mechanism_outputs.h"

namespace blocklift::pipeline {

/// The motion of a mechanism file.
struct MechanismRun {
  Eigen::VectorXd time;  ///< s
  std::vector<OutputSeries> outputs;
  dynamics::IntegrationStatistics statistics;
  std::vector<std::string> findings;  ///< on loops: what repeats, what stands in a dead point
  double elapsed = 0;                 ///< wall-clock time, s
};

/// Simulates a mechanism file over its duration.
/// @param progress called with the fraction done and the time; may be empty.
/// @throws dynamics::ModelError, dynamics::SimulationError as the build, equilibrium and integration do.
MechanismRun run_mechanism(const MechanismFile& file,
                           const std::function<void(double, double)>& progress);

/// Writes results.h5 into a folder (made if missing) and, if asked, results.csv: columns of time and
/// outputs, units in the header. Each file appears whole or not at all.
/// @throws ResultsError, std::runtime_error if they cannot be written.
void write_mechanism_results(const MechanismFile& file, const MechanismRun& run,
                             const std::filesystem::path& folder, bool with_csv);

/// Text of a CSV file: header "time [s],tip.x [m],...", then a line a sample, numbers with all digits.
std::string csv_text(const Eigen::VectorXd& time, const std::vector<OutputSeries>& outputs);

/// A table of the smallest and largest value of each column with their times, for the terminal.
std::string extremes_table(const Eigen::VectorXd& time, const std::vector<OutputSeries>& outputs);

/// Attributes of the group /statistics: what an integration cost.
void write_statistics(ResultsWriter& file, const dynamics::IntegrationStatistics& statistics);

}  // namespace blocklift::pipeline
