#pragma once

#include <Eigen/Core>

#include "structure/envelope/envelope.h"

namespace blocklift::structure {

/// The von Mises stress of find_von_mises_envelope where it comes to a share of the largest of all
/// points, zero elsewhere: points that come to less cost little.
/// @param share of the largest, less than 1.
/// @param known a stress that is known to occur (zero: nothing is known), Pa: the nearer it is to
///   the largest, the less is searched.
Eigen::VectorXd find_leading_von_mises(const LoadHistory& history, int points,
                                       const PointResponses& stress, double share, double known,
                                       int threads = 0);

}  // namespace blocklift::structure
