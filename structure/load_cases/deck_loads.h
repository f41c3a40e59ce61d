#pragma once

#include <Eigen/Core>

#include "structure/mesh/files/deck/deck.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Load vector (six rows a node, N and N m) of a deck's load case on a model of the deck's mesh:
/// forces and moments at vertices, pressures on plates and solids and loads along beams spread as
/// the elements move, weight and turning of all mass. What heat does is told apart (heat_of).
/// @throws ModelError if something acts at a vertex that nothing uses.
Eigen::VectorXd load_of(const ElasticModel& model, const Deck& deck, const DeckLoadCase& load_case);

}  // namespace blocklift::structure
