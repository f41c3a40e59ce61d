#pragma once

#include <Eigen/SparseCore>

namespace blocklift::structure {

/// Lower triangle of a symmetric sparse matrix, with 64-bit indices as CHOLMOD wants them for
/// large factors.
using SparseLower = Eigen::SparseMatrix<double, Eigen::ColMajor, long>;

}  // namespace blocklift::structure
