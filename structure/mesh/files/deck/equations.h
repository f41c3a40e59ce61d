#pragma once

#include <set>
#include <string>
#include <vector>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// A freedom of a vertex, as a deck names it.
struct DeckFreedom {
  int vertex = 0;
  int component = 0;                                   ///< 0 .. 2 displacement, 3 .. 5 rotation
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: along which it counts
};

/// One term of a deck's equation: factor times a freedom, in the deck's units.
struct EquationTerm {
  DeckFreedom freedom;
  double factor = 0;
};

/// Adds an equation between motions, whose first term follows the others, to a deck's mesh. Factors
/// are rounded in decks: what they leave of a resistance to motions of the whole is taken out. One
/// that resists such a motion by more than a hundredth becomes one of the deck's holding equations.
/// @param place of the equation, file:line
/// @throws CardError if the factor of the first freedom is nil.
void add_equation(Deck& deck, const std::vector<EquationTerm>& terms, const std::string& place);

/// Makes freedoms follow the rigid motion that six others determine.
/// @throws CardError if the six do not determine one, or no freedom follows.
void add_rigid_equations(Deck& deck, const std::vector<DeckFreedom>& independent,
                         const std::vector<DeckFreedom>& dependent);

/// A freedom that counts in a mean motion, with its weight.
struct CountedFreedom {
  DeckFreedom freedom;
  double weight = 1;
};

/// Makes freedoms of a vertex follow the rigid motion that fits others' best by least squares, each
/// with its weight; rotations count over the mean distance of the others' vertices from it. Source:
/// MSC Nastran Quick Reference Guide, RBE3.
/// @throws CardError if the others determine no such motion.
void add_mean_equations(Deck& deck, const std::vector<DeckFreedom>& reference,
                        const std::vector<CountedFreedom>& counted);

/// Keeps the distance of two vertices as it is: `first` follows. @throws CardError for none.
void add_rigid_rod(Deck& deck, int first, int second);

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
