#pragma once

#include <Eigen/Core>

#include "structure/system/supernodal_factorisation.h"

namespace blocklift::structure {

/// Replaces f by y of L y = f, a column a load vector. Columns go to threads, some at a time and
/// always the same: y is the same for any number of threads.
/// @param values of L, as factorise_supernodes leaves them. @param threads 0: as many as are
/// usable.
void solve_lower(const SupernodalPattern& pattern, const double* values, Eigen::MatrixXd& loads,
                 int threads = 0);

/// Replaces y by x of L' x = y, in the same way.
void solve_upper(const SupernodalPattern& pattern, const double* values, Eigen::MatrixXd& reduced,
                 int threads = 0);

}  // namespace blocklift::structure
