#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/diagnosis/diagnosis.h"
#include "structure/mesh/files/deck/deck.h"

namespace blocklift::pipeline {

/// What the supports of a deck, which a lift leaves out, have to do with a part of its block that
/// nothing else holds, as a hint beside the complaint; none where they have nothing to do with it.

/// @param finding places of vertices, beams or parts that can move.
std::vector<std::string> supports_of_what_is_loose(const structure::Deck& deck,
                                                   const structure::Finding& finding);
/// @param motion six rows, displacement and rotation, a column a vertex: how a mechanism moves
///   against most of the block, by any factor; empty: not known.
std::vector<std::string> supports_of_mechanism(
    const structure::Deck& deck, const Eigen::Ref<const Eigen::Matrix<double, 6, -1>>& motion);

}  // namespace blocklift::pipeline
