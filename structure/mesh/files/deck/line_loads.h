#pragma once

#include <array>
#include <vector>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Force and moment of a load along a beam, per m of the line that bears it or, at one place,
/// whole.
struct LoadAtPlace {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
};

/// A load at a share of its span, the moment about a line beside the one that bears it.
/// @param arm from that line to the one that bears it, at the beam's ends, m.
LoadAtPlace load_at(const BeamLoad& load, const std::array<Vector3, 2>& arm, double share_of_span);

/// What a load along a beam is at its two vertices if a linear element bears it: as much force, and
/// as much moment about any place, as the load has.
std::array<PointLoad, 2> loads_at_ends(const Mesh& mesh, const BeamLoad& load);

/// Is it an even force on all of the line between the beam's vertices?
bool is_even_between_vertices(const BeamLoad& load);

/// Forces and moments of a load case at vertices, one a vertex: its own, and those of loads along
/// beams that are not even ones between the vertices (loads_at_ends).
std::vector<PointLoad> loads_at_vertices(const Deck& deck, const DeckLoadCase& load_case);

/// Does a load act along a motion that the beam's released ends leave to themselves? They would
/// move under it alone, which the recovery of stress does not follow.
bool acts_on_released_ends(const Mesh& mesh, const BeamLoad& load);

}  // namespace blocklift::structure
