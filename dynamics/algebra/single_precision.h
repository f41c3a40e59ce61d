#pragma once

#include <Eigen/Dense>

#include "dynamics/algebra/dense_algebra.h"

// Dense algebra in single precision: half the time and half the memory, where what follows from the
// figures is held in single precision anyway.
namespace blocklift::dynamics {

using SingleLuFactorisation = DenseLu<float>;

/// Y = A X for a symmetric A of which both halves are stored. One column reads only half of A. The
/// figures do not depend on the number of threads.
void multiply_symmetric(const Eigen::MatrixXf& A, const Eigen::MatrixXf& X, Eigen::MatrixXf& Y);

}  // namespace blocklift::dynamics
