#pragma once

#include <Eigen/Core>

#include "structure/envelope/load_history.h"
#include "structure/response/unit_responses.h"

namespace blocklift::structure {

/// Motions of a block for unit coordinates of a history of its loads, freedoms x rank: the motions
/// of the unit loads times LoadHistory::modes(). What is linear in the motions of nodes is then
/// found once a coordinate, and not at many points a unit load.
Eigen::MatrixXd motions_in_coordinates(const UnitResponses& responses, const LoadHistory& history);

}  // namespace blocklift::structure
