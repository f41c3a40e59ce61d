#pragma once

#include <functional>

#include <Eigen/Core>

#include "structure/space/space.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// Symmetric matrix of one element, its freedoms as in Space::element_freedoms.
using ElementMatrix = std::function<const Eigen::MatrixXd&(int element)>;

/// Sums element matrices over the unknowns of a space, in its order of elimination.
/// @param make_worker called once a thread; what it returns is called by that thread alone.
/// @param threads 0: as many as the machine has.
SparseLower assemble(const Space& space, const std::function<ElementMatrix()>& make_worker,
                     int threads = 0);

/// Stiffness of shells, beams and springs, N/m. Unknowns that nothing stiffens have 1 on the
/// diagonal, and rotations of a truss' joints about axes that nothing stiffens a stiffness of their
/// own: they stay at rest.
/// @throws ModelError if it would not fit into the memory that is free; the message has the
/// figures.
SparseLower assemble_stiffness(const Space& space, int threads = 0);

}  // namespace blocklift::structure
