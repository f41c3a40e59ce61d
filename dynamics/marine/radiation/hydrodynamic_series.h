#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "dynamics/marine/radiation/memory_state_space.h"

namespace blocklift::dynamics {

/// Databases of the same bodies while one of them lies at several draughts: for a ship that is
/// lowered into the water. One database, whatever its draught, is the usual case.
struct HydrodynamicSeries {
  int lowered_body = 0;          ///< whose draught the next is
  std::vector<double> draughts;  ///< m, ascending; one for each database; 0 if not known, or dry
  std::vector<HydrodynamicDatabase> databases;
  /// Their memories, fitted before; empty: RadiatedWater fits them.
  std::vector<MemoryStateSpace> memories = {};

  /// The database at a draught (m), linear in it between those that were computed. A series of one
  /// is the same at every draught. Otherwise it is that of the greatest draught beyond it; and
  /// between the least one and zero (a dry body) what belongs to the lowered body dwindles linearly
  /// to nothing, the other bodies keeping what they have there, unless the first database is that
  /// of the dry body itself.
  HydrodynamicDatabase at(double draught) const;
};

/// Brings the retardation functions of all databases to the finest step and the longest duration
/// among them (cubic polynomials between the samples, zero behind the end), so that at() can mix
/// them. A first draught of zero stands for with_dry_body().
/// @throws ModelError if the databases differ in bodies, water, frequencies or headings, there is
/// none, several draughts do not ascend or one database is unsound (require_sound): which, and what
/// is wrong.
HydrodynamicSeries make_series(int lowered_body, std::vector<double> draughts,
                               std::vector<HydrodynamicDatabase> databases);

/// The bodies of `wet` with one of them out of the water: flow of the others alone, nothing of it.
/// @param others the other bodies in their order, computed for the same water, frequencies and
///   headings; null: there are none.
/// @throws ModelError if `others` holds other bodies.
HydrodynamicDatabase with_dry_body(const HydrodynamicDatabase& wet, int body,
                                   const HydrodynamicDatabase* others);

}  // namespace blocklift::dynamics
