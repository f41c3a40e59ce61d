#pragma once

#include <map>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Which entities of Gmsh's current model are plates and bars: places in Mesh::regions by the tags
/// of surfaces and of curves.
struct EntityRegions {
  std::map<int, int> surfaces, curves;
};

/// Adds the triangles and quadrangles of surfaces and the lines of curves, of first and second
/// order, to a deck as shells and beams without sections (-1), and the nodes that they use.
///
/// Second-order cells whose edges are straight become plain ones; a second-order line along a
/// shell's edge becomes one beam, curved as the edge is, else two. Where one ends in the middle of
/// a shell's curved edge, that middle is fastened to it. Physical groups of any dimension become
/// sets. Numbers are those of Gmsh's nodes and elements.
/// @param length of the unit of the model's coordinates, m.
/// @throws ModelError naming kinds of elements beyond these.
void collect_cells(const EntityRegions& entities, double length, Deck& deck);

}  // namespace blocklift::structure
