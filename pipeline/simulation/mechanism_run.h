#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/simulation/time_integration.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/lift/natural_modes.h"
#include "pipeline/simulation/mechanism_outputs.h"

namespace blocklift::pipeline {

/// A mechanism file and its motion.
struct MechanismRun {
  BuiltMechanism mechanism;
  dynamics::IntegrationResult result;
  std::vector<OutputSeries> outputs;
  std::vector<NaturalModes> natural_modes;  ///< at the start, where that is an equilibrium
  std::vector<std::string> findings;        ///< on loops: what repeats, what stands in a dead point
  std::vector<std::string> doubts;          ///< about what was computed of the vessels' water
  double elapsed = 0;                       ///< wall-clock time, s

  const Eigen::VectorXd& time() const { return result.history.time; }  ///< of the samples, s
};

/// Simulates a mechanism file over its duration.
/// @param progress called with the fraction done and the time; may be empty.
/// @param cache of what is computed of the vessels' water.
/// @throws dynamics::ModelError, dynamics::SimulationError as the build, equilibrium and
/// integration do.
MechanismRun run_mechanism(const MechanismFile& file,
                           const std::function<void(double, double)>& progress,
                           const std::filesystem::path& cache = cache_folder());

/// Text of a CSV file: header "time [s],tip.x [m],...", then a line a sample, numbers with all
/// digits.
std::string csv_text(const Eigen::VectorXd& time, const std::vector<OutputSeries>& outputs);

/// A table of the smallest and largest value of each column with their times, for the terminal.
std::string extremes_table(const Eigen::VectorXd& time, const std::vector<OutputSeries>& outputs);

}  // namespace blocklift::pipeline
