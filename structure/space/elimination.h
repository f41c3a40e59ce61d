#pragma once

#include <vector>

namespace blocklift::structure {

/// Unknowns that belong to exactly the same elements, numbered one after another. The stiffness
/// couples whole groups, so ordering, pattern and assembly work on them instead of on single
/// unknowns.
struct UnknownGroup {
  int first = 0;
  int count = 0;
  std::vector<int> elements;
};

/// An order of elimination with little fill.
struct Elimination {
  std::vector<int> place;            ///< new number of each unknown; -1 for one of no element
  int count = 0;                     ///< unknowns that some element has
  std::vector<UnknownGroup> groups;  ///< in order
  std::vector<std::vector<int>> groups_of_elements;  ///< ascending
};

/// Orders the unknowns 0 .. unknowns - 1 of symmetric element matrices by nested dissection (METIS)
/// of the graph of their groups, in postorder of the elimination tree, so that the factorisation
/// finds its dense blocks without permuting the matrix again. The same elements have the same
/// order, whatever other threads order meanwhile. Source: Karypis and Kumar (1998); Liu (1990), The
/// role of elimination trees in sparse factorization.
/// @param elements unknowns of each element, in any order, repetitions allowed.
/// @throws ModelError if METIS fails.
Elimination find_elimination(int unknowns, const std::vector<std::vector<int>>& elements);

}  // namespace blocklift::structure
