#pragma once

#include <optional>
#include <vector>

#include "structure/mesh/files/part_reader.h"
#include "structure/part/part_solution.h"

namespace blocklift::structure {

/// What the next mesh of a part shall be better at.
struct RefinementAim {
  std::optional<double> error;  ///< of the stress field in the energy norm, as a share of the norm
  std::vector<Vector3> places;  ///< where the stress itself shall be more accurate, m
};

/// Can a part be meshed again with other sizes? Geometries that are filled with tetrahedra can.
bool takes_sizes(const PartMesh& mesh);

/// Sizes of the elements with which a part meets an aim, from its solution on a coarser mesh.
///
/// Solid i of mean edge h_i and order p has the estimated error e_i in the energy norm. When its
/// edges become r_i h_i there are r_i^-3 times as many elements, of the error r_i^p e_i together.
/// The fewest elements with the error e in total are those with
///   r_i = e^(1/p) e_i^(-2/(2p+3)) (sum_j e_j^(6/(2p+3)))^(-1/(2p))   (Lagrange's multiplier),
/// here between 1/4 and 1. At each place elements get half of the edge that is there, and 0.3 times
/// the distance more around it. @throws ModelError unless takes_sizes.
SizeField find_sizes(const PartModel& model, const PartSolution& solution,
                     const RefinementAim& aim);

}  // namespace blocklift::structure
