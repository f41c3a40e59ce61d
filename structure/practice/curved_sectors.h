#pragma once

#include <optional>
#include <vector>

#include "structure/mesh/fields/fields.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// How curved plating turns.
struct PlateTurn {
  Vector3 axis = Vector3::Zero();  ///< that it turns about, unit
  double angle = 0;                ///< from end to end, rad; 2 pi of a pipe
  /// Length round the axis over which it buckles under compression round it, m: its developed
  /// length, and at most pi R / sqrt(3), over which a wide column bears what a long pipe does,
  /// 3 D / R^2 (Timoshenko and Gere, 1961, chapter 7).
  double arc = 0;
};

/// Sectors of curved plating, cut along its generators.
struct CurvedSectors {
  PlateTurn turn;
  int count = 0;
  std::vector<int> of_shell;  ///< in the order of the field's shells
};

/// Of plating that turns by 45 degrees or more, sectors of about 30 degrees. A shell is not
/// divided: one that turns farther is a sector itself. Other plating, and a single shell, has none.
std::optional<CurvedSectors> find_curved_sectors(const Mesh& mesh, const PlateField& field);

}  // namespace blocklift::structure
