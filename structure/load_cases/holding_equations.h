#pragma once

#include <vector>

#include "structure/load_cases/deck_solution.h"
#include "structure/system/held_sums.h"

namespace blocklift::structure {

/// Equations of a deck that hold one vertex in a direction, as supports there: rollers on a slope.
std::vector<Support> supports_of_equations(const Deck& deck);

/// The other equations that hold the whole, between motions of several vertices, as sums of a
/// space's unknowns that are nil, each over the largest of its coefficients. They hold what is at
/// these vertices; nodes of finer elements between them are as free as their elements leave them.
/// @throws ModelError if an equation has a vertex that nothing is joined to.
std::vector<HeldSum> sums_of_equations(const Space& space, const Deck& deck);

/// What the equations of sums_of_equations exert at their vertices.
/// @param forces along the sums, N: one an equation, in their order
std::vector<SupportReaction> reactions_of_equations(
    const Deck& deck, const Eigen::Ref<const Eigen::VectorXd>& forces);

}  // namespace blocklift::structure
