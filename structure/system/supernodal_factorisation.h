#pragma once

#include <vector>

#include "structure/system/cholesky_factor.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// Where the entries of a supernodal factor stand, as CHOLMOD has them: the columns of supernode s
/// follow each other from values[value_starts[s]] on, with an entry for each of its rows.
struct SupernodalPattern {
  std::vector<Supernode> supernodes;
  const long* row_starts = nullptr;    ///< of each supernode in `rows`
  const long* value_starts = nullptr;  ///< of each supernode in the values
  const long* rows = nullptr;          ///< of each supernode, ascending; its own columns come first
};

/// L of K = L L', entries above its diagonal left as they come. Subtrees of the elimination tree go
/// side by side to threads, and what is above them goes by tiles. Each tile is summed in one order
/// by one thread: L is the same, to the last bit, for any number of threads. Source: Ng and Peyton
/// (1993), Block sparse Cholesky algorithms on advanced uniprocessor computers: a supernode takes
/// what those before it leave.
/// @param values of L, of the pattern's size; what they hold does not matter.
/// @param threads 0: as many as are usable.
/// @returns the first column whose pivot is not positive; as many as there are if all are positive.
long factorise_supernodes(const SupernodalPattern& pattern, const SparseLower& matrix,
                          double* values, int threads = 0);

}  // namespace blocklift::structure
