#pragma once

#include <Eigen/Core>

namespace blocklift::structure::test {

/// Factors of unit loads (count x instants) as a lift has them: each swings about a value that
/// drifts, with three periods that all share and phases of its own.
Eigen::MatrixXd lift_like_history(int count, int instants, unsigned seed);

/// Factors without any relation to one another: the worst that an envelope can meet.
Eigen::MatrixXd noise_history(int count, int instants, unsigned seed);

/// Unit stresses (6 points x count) as noise, some components small.
Eigen::MatrixXd random_responses(int rows, int count, unsigned seed);

}  // namespace blocklift::structure::test
