#pragma once

#include <vector>

#include "structure/mesh/fields/plate_finder.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Edge of solids that stands on plating.
struct StandingEdge {
  /// A row of the solids' nodes through their thickness, and the place on the edge's line.
  struct Column {
    Vector3 place = Vector3::Zero();  ///< m
    std::vector<int> vertices;        ///< of quadratic solids, at least two
  };
  /// From end to end of a straight edge: corners and middles of the solids' edges in turn.
  std::vector<Column> columns;
  Vector3 through = Vector3::UnitZ();  ///< unit vector through the solids' thickness
};

/// Ties solids to the plating on which their edge stands, so that stress passes evenly.
///
/// - The motion (u, theta) of a column's foot is the mean of the plating's along the line, weighted
///   with the function that is dual to the column's quadratic shape function: the feet then move as
///   the projection of the plating's motion onto what the solids can follow, and what the solids
///   exert is spread along the line, whatever the size of the shells' cells. Quadratic motions pass
///   as they are; so do tractions that are linear along the line (Wohlmuth 2000, SIAM J. Numer.
///   Anal. 38, 989-1012, for dual functions; Lamichhane and Wohlmuth 2002 for quadratic ones).
/// - Across the thickness a column follows u + theta x arm within its cross-section and along the
///   line; along `through` the mean of its outermost nodes does, so that the solids may grow
///   thinner or thicker as Poisson's ratio has it. Even tension and bending pass without
///   disturbance, shear across the plating as forces at both surfaces.
///
/// The plating is the master: it is not stiffened by more than the solids themselves.
/// @throws ModelError naming the place if no plate lies below a part of the line.
void stand_on_plating(Mesh& mesh, const StandingEdge& edge);

}  // namespace blocklift::structure
