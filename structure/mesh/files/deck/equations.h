#pragma once

#include <set>
#include <vector>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// One term of a deck's equation: factor times a freedom of a vertex, in the deck's units.
struct EquationTerm {
  int vertex = 0;
  int component = 0;  ///< 0 .. 2 displacement, 3 .. 5 rotation along `axes`
  double factor = 0;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns
};

/// Adds an equation between motions, whose first term follows the others, to a deck's mesh. Factors
/// are rounded in decks: what they leave of a resistance to motions of the whole is taken out.
/// @throws CardError if they resist such a motion by more than a hundredth: a lifted block is held
///   by its ropes alone.
void add_equation(Deck& deck, const std::vector<EquationTerm>& terms);

/// A term along one freedom, as a deck says it.
struct ScalarTerm {
  int vertex = 0;
  int component = 0;
  double factor = 0;
};

/// An equation's terms along the axes that each vertex has in the deck, in its units; the first is
/// the one that follows, and no two equations have one first freedom.
/// @param axes of each vertex. @param taken first freedoms (6 vertex + component) so far.
/// @throws ModelError if every freedom that could follow does so already.
std::vector<ScalarTerm> scalar_terms(const MotionEquation& equation, const UnitSystem& units,
                                     const std::vector<Eigen::Matrix3d>& axes,
                                     std::set<int>& taken);

}  // namespace blocklift::structure
