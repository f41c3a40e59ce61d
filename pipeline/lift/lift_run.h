#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/simulation/time_integration.h"
#include "pipeline/build/build_lift.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/lift/natural_modes.h"

namespace blocklift::pipeline {

/// Called with the stage of the run, the fraction of it that is done, and a word about where it is.
using Progress = std::function<void(const std::string&, double, const std::string&)>;

/// How far a lug gives way within the block, against the block's mean rigid motion.
struct LugDisplacement {
  std::string lug;
  double size = 0;  ///< m
  double time = 0;  ///< s
};

/// The dynamics of a lift: the operation at rest and in motion.
struct LiftRun {
  BuiltLift model;
  dynamics::History static_history;
  dynamics::IntegrationResult dynamic_result;
  double static_s = 0;   ///< wall-clock time of the static sweep and the natural modes
  double dynamic_s = 0;  ///< wall-clock time of the time integration
  std::vector<NaturalModes> natural_modes = {};
  /// The largest at the samples of the motion; none if the block is rigid.
  std::optional<LugDisplacement> elastic_displacement = {};
  /// Of the load at each sample at rest, m: dynamics::calc_righting_height.
  Eigen::VectorXd righting_height = {};

  const dynamics::History& dynamic_history() const { return dynamic_result.history; }
  /// Was the operation swept at rest? If not, the history at rest has no samples.
  bool is_swept() const { return static_history.sample_count() > 0; }
  double simulated_s() const { return model.system.operation().duration(); }
};

/// What a run finds besides the motion and the ropes' tensions, each at a cost of its own. What it
/// finds is the same bit for bit, whatever else is left out.
struct RunExtent {
  /// The operation's equilibria. Left out: the history at rest has no samples.
  bool at_rest = true;
  /// With those at rest alone. They cost as much as the sweep.
  bool natural_modes = true;
  /// Energies at each sample, and works of drives, winches and surroundings at every step, as much
  /// as a third of the motion. Left out: a summary has no `energy`.
  bool energy = true;
  /// With those at rest alone. Left out: not a number at each sample.
  bool righting_height = true;
  /// The rest of dynamics::Recording, in both histories.
  bool motion = true, rope_forces = true, accelerations = true;

  dynamics::Recording recording() const { return {motion, rope_forces, accelerations, energy}; }
  /// The motion and the ropes' tensions alone.
  static RunExtent tensions() { return {false, false, false, false, false, false, false}; }
  /// What loads a block at rest and in motion: BlockLoads.
  static RunExtent block_loads() { return {true, false, false, false, true, true, true}; }
  /// What either finds.
  friend RunExtent operator|(const RunExtent& a, const RunExtent& b);
};

/// Sweeps the operation at rest, finds the natural modes on the way, then integrates it in time
/// from the first equilibrium.
/// @throws std::invalid_argument if the extent has natural modes or righting heights without the
///   sweep that they are found on.
/// @throws dynamics::SimulationError when an equilibrium or the integration fails.
LiftRun run_lift(const LiftCase& lift_case, BuiltLift model, const Progress& progress,
                 const RunExtent& extent = {});

/// Builds the dynamics of a case: the radiation of its vessels, from the cache or computed, and the
/// rest. Where stages end by a condition, or drives are steered after what is seen, the lift is run
/// up to the end of each of them first, so that all of the operation is known; then the worst
/// instant of a fault is sought where a case asks for it (find_worst_instant).
/// @throws dynamics::SimulationError also if a condition does not come about in its time.
/// @throws InputError, dynamics::ModelError, dynamics::SimulationError as find_radiation and
/// build_lift.
/// @param flexibility of the load; null: it is rigid.
/// @param cache of what is computed of the vessels' water.
BuiltLift prepare_lift(const LiftCase& lift_case, const LoadMass& load, const Progress& progress,
                       const LoadFlexibility* flexibility = nullptr,
                       const std::filesystem::path& cache = cache_folder());

/// Sum of the tackle tensions of a crane's hoists at each sample, N.
Eigen::VectorXd crane_load(const BuiltLift& model, const dynamics::History& history,
                           std::size_t crane);

}  // namespace blocklift::pipeline
