#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "structure/space/space.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// A symmetric matrix of an element by the unknowns that it couples, ascending.
struct ElementEntries {
  std::vector<int> unknowns;
  Eigen::MatrixXd matrix;
};

/// Takes an element's matrix whose rows belong to unknowns in any order; what comes twice is added.
void take_entries(const std::vector<int>& unknowns, const Eigen::MatrixXd& matrix,
                  ElementEntries& entries);

/// Finds an element's entries.
using FindEntries = std::function<void(int element, ElementEntries& entries)>;

/// Sums the matrices of all elements that an order of elimination was found for.
/// @param make_worker called once a thread; what it returns is called by that thread alone.
/// @param threads 0: as many as the machine has.
/// @throws ModelError if it would not fit into the memory that is free; the message has the
/// figures.
SparseLower assemble(const Elimination& elimination,
                     const std::function<FindEntries()>& make_worker, int threads = 0);

/// Symmetric matrix of one element, its freedoms as in Space::element_freedoms.
using ElementMatrix = std::function<const Eigen::MatrixXd&(int element)>;

/// Sums element matrices over the unknowns of a space, in its order of elimination.
SparseLower assemble(const Space& space, const std::function<ElementMatrix()>& make_worker,
                     int threads = 0);

/// Stiffness of shells, beams, springs and solids, N/m. Unknowns that nothing stiffens have 1 on
/// the diagonal, and rotations of a truss' joints about axes that nothing stiffens a stiffness of
/// their own: they stay at rest.
/// @throws ModelError if it would not fit into the memory that is free; the message has the
/// figures.
SparseLower assemble_stiffness(const Space& space, int threads = 0);

}  // namespace blocklift::structure
