#pragma once

#include <vector>

#include "structure/system/cholesky_factor.h"

namespace blocklift::structure {

/// Deals the columns of a factor out to processes so that they can be eliminated side by side.
///
/// Subtrees of the elimination tree do not depend on each other. From the roots downwards the
/// heaviest is taken apart again and again, its topmost columns going to the interface, which is
/// eliminated when all subtrees are; taken is what has the least work on the longest way. Source:
/// George, Heath, Liu and Ng (1989), Solution of sparse positive definite systems on a hypercube
/// (subtrees to processors).
/// @param supernodes of all columns, as they follow each other.
/// @returns the process of each column; -1 where it is in the interface.
std::vector<int> deal_out_subtrees(const std::vector<Supernode>& supernodes, int processes);

/// Multiplications and additions that a factorisation spends on a supernode's columns.
double elimination_work(const Supernode& supernode);

/// The largest subtrees of the elimination tree none of which has more than a share of all work;
/// they do not depend on each other.
/// @param supernodes of all columns, as they follow each other.
/// @returns the subtree of each supernode, the one with the most work being 0; -1 where it is above
///   them.
std::vector<int> independent_subtrees(const std::vector<Supernode>& supernodes, double share);

}  // namespace blocklift::structure
