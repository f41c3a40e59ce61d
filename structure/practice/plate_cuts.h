#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "structure/mesh/fields/fields.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/mesh.h"
#include "structure/practice/buckling_fields.h"

namespace blocklift::structure {

/// How a plate falls into pieces at one or two re-entrant corners of its outline.
struct PlateCut {
  int pieces = 0;
  std::vector<int> piece_of_shell;      ///< in the order of the field's shells
  std::set<EdgeKey> edges;              ///< of shells, between pieces
  std::map<int, Vector3> straightened;  ///< vertices along the cut, moved onto its line
  double whole_length = 0;              ///< longer side of the rectangle about all of it, m
};

/// The cut after which the rectangles about the pieces are smallest together, of several such cuts
/// (within half a percent, which is the grain of meshes) that which leaves the largest piece, then
/// the shortest; none where the outline fills 0.85 of the rectangle about it, where no corner is
/// re-entrant, or where no cut makes them 7 % smaller.
/// @param known vertices that former cuts moved.
std::optional<PlateCut> find_plate_cut(const Mesh& mesh, const PlateField& field,
                                       const FieldAxes& axes, const BucklingFields& known);

}  // namespace blocklift::structure
