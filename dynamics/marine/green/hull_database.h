#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// What a computation of a database by the hulls alone came to.
struct HullDatabaseReport {
  int panels = 0, cells = 0;        ///< computed with, after symmetry
  double peak_bytes = 0.0;          ///< hull_equations_bytes()
  std::vector<double> frequencies;  ///< solved, rad/s, in this order
  double miss = 0.0;                ///< of the last frequencies, each foretold from those before
  /// Largest difference of what the retardation functions say from what was solved, over the
  /// frequencies solved between the lowest and highest asked for, as memory_error.
  double memory_error = 0.0;
  double reciprocity_error = 0.0;  ///< largest asymmetry of B + i w A before it is made symmetric
};

/// The database of a model's bodies by HullEquations: what compute_database makes, without a
/// surface mesh, a march or a beach.
///
/// The frequencies asked for are solved, and as many more, from half the lowest to twice the
/// highest (or to where three panels go into a wave), as search_common_poles needs to know
/// A + B/(i w) - A_inf between them to two thousandths of the waves' largest part. That is used
/// between the frequencies only; beyond them DampingBeyond has the damping. K is its integral, and
/// lasts until what follows is less than that at every frequency, at most ten periods of the
/// lowest: what swings on is faded over the last four. A_inf is the solution without waves, so that
/// the added mass which K gives beside it is a check of all of this. Of the settings,
/// damping_strength and what of `rankine` is not memory or threads belong to the march, and have no
/// meaning here.
/// @throws ModelError if a frequency is not positive, or its wave shorter than three panels, or the
/// retardation functions miss the solved forces by more than a tenth; SimulationError if the memory
/// does not suffice.
HydrodynamicDatabase compute_hull_database(const PanelModel& model,
                                           const DatabaseSettings& settings,
                                           HullDatabaseReport* report = nullptr);

/// Memory (bytes) that compute_hull_database takes at its peak, at most.
double hull_database_bytes(const PanelModel& model, const DatabaseSettings& settings);

}  // namespace blocklift::dynamics
