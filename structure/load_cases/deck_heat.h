#pragma once

#include <optional>
#include <vector>

#include "structure/formulation/cell_heat.h"
#include "structure/mesh/files/deck/deck.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// What the temperatures of a deck's load cases do to a model of the deck's mesh: a column a case,
/// in their order; nothing where none of them has any.
///
/// Between a shell's corners, and the middles of a quadratic one's edges, the temperature is as
/// its shape functions have it, through the plate it is linear; along a beam it is linear, and over
/// its section; in a solid it is as its shape functions have it, at middles of edges that are no
/// nodes of the file the mean of the edge's ends.
/// @param load_cases places in Deck::load_cases. Model and deck must outlive the result.
/// @throws ModelError naming the case if a node of a cell has no temperature, a material's
///   expansion is not known or not constant, or the temperatures cannot be computed with.
std::optional<CellHeat> heat_of(const ElasticModel& model, const Deck& deck,
                                const std::vector<int>& load_cases);

}  // namespace blocklift::structure
