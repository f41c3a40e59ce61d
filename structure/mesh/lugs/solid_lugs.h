#pragma once

#include <array>
#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Line on plating along which a lug of solids stands (padeye/padeye_in_block.h).
struct SolidLugBase {
  int region = 0;                                        ///< the lug's, place in Mesh::regions
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< its ends, on the plating, m
  std::array<int, 2> ends{};                             ///< vertices there that follow the plating
};

/// The bases of all lugs of solids of a mesh: where rigid links join solids of a lug's region with
/// places on shells. Solids that a deck ties to plates are no lugs.
std::vector<SolidLugBase> find_solid_lug_bases(const Mesh& mesh);

/// Of each group: 1 if a lug of solids belongs to it.
///
/// The pin's force is spread over all of the bore there, and the elements are few: the largest
/// stress of such solids is no measure of the lug, which is checked as a padeye by itself.
std::vector<char> groups_of_solid_lugs(const Mesh& mesh);

}  // namespace blocklift::structure
