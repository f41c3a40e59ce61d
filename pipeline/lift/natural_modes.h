#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "dynamics/simulation/linearisation.h"
#include "pipeline/build/build_lift.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// The natural modes of the lift hanging at rest at one instant of the operation.
struct NaturalModes {
  std::string instant;  ///< "start", "after hoist up", "largest load of rope R3"
  dynamics::Linearisation linearisation;
  bool heading_is_held = false;  ///< as BuiltLift::held_heading says

  /// Is a mode that grows the turn of a load on one hook, which the wind begins and nothing holds?
  bool is_turned_by_wind(const dynamics::Mode& mode) const;
};

/// Natural modes at the start, at the end of each stage, and at the instant at which a rope or
/// tackle stands nearest to its breaking load at rest; drives and winches stand still there.
/// Ascending in time.
/// @param static_history the operation at rest.
/// @param q_start the equilibrium at the start (nq).
/// @param interval in which the equilibrium is followed, s.
/// @throws dynamics::SimulationError if an equilibrium is lost on the way.
std::vector<NaturalModes> find_natural_modes(const BuiltLift& model,
                                             const dynamics::History& static_history,
                                             const Eigen::VectorXd& q_start, double interval);

/// "natural periods at the start: load: pendulum along x 16.2 s, ...": the slowest three, for the
/// terminal.
std::string describe_natural_periods(const NaturalModes& modes);

/// The table "natural_periods" of summary.json (pipeline/formats/results/results_layout.h).
nlohmann::ordered_json natural_periods_json(const dynamics::Mechanism& mechanism,
                                            const std::vector<NaturalModes>& all);

/// The group /modes of results.h5.
void write_natural_modes(ResultsWriter& file, const dynamics::Mechanism& mechanism,
                         const std::vector<NaturalModes>& all);

}  // namespace blocklift::pipeline
