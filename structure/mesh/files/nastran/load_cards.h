#pragma once

#include <array>
#include <memory>
#include <vector>

#include "structure/mesh/files/deck/line_loads.h"
#include "structure/mesh/files/nastran/card_writer.h"

namespace blocklift::structure {

/// Writes what acts on all masses: GRAV and RFORCE of a load set of the deck. An axis beside the
/// origin is one through it and the acceleration of its place.
/// @throws ModelError for what Nastran has no card for: parts of the masses, edges, volumes.
void write_loads_of_masses(const LoadSet& set, long label, const UnitSystem& units,
                           CardWriter& out);

/// Writes a load along a bar: PLOAD1 for each of its components.
/// @param number of the bar. @param offsets that are written with it, m: the line that they lead to
///   bears PLOAD1, and what bears the load beside it makes moments.
/// @throws ModelError if these are not linear in place, as no PLOAD1 says.
void write_line_load(const Mesh& mesh, const BeamLoad& load, long set, long number,
                     const std::array<Vector3, 2>& offsets, const UnitSystem& units,
                     CardWriter& out);

/// Writes pressures, with the systems about a cylinder or sphere in which their directions are.
class PressureCards {
 public:
  /// Both must outlive this object.
  PressureCards(const UnitSystem& units, CardWriter& out) : units_(units), out_(out) {}

  /// @param fields of PLOAD4 before its direction.
  /// @param direction without length: along the normal.
  void write(std::vector<CardField> fields, const Vector3& direction,
             const std::shared_ptr<const LocalSystem>& system);

 private:
  long number_of(const std::shared_ptr<const LocalSystem>& system);

  const UnitSystem& units_;
  CardWriter& out_;
  std::vector<std::shared_ptr<const LocalSystem>> systems_;
};

}  // namespace blocklift::structure
