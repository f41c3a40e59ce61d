#include "structure/mesh/files/surfaces/fragments.h"

#include <algorithm>
#include <string>

#include <gmsh.h>

#include "structure/error.h"

namespace blocklift::structure {

std::map<Entity, std::vector<int>> cut_at_joints(const std::map<Entity, int>& owners,
                                                 double tolerance) {
  std::map<Entity, std::vector<int>> pieces;
  gmsh::vectorpair inputs;
  for (const auto& [entity, owner] : owners) inputs.push_back(entity);
  if (inputs.size() < 2) {
    for (const auto& [entity, owner] : owners) pieces[entity] = {owner};
    gmsh::model::occ::synchronize();
    return pieces;
  }
  gmsh::option::setNumber("Geometry.ToleranceBoolean", tolerance);
  gmsh::vectorpair all;
  std::vector<gmsh::vectorpair> of_input;
  try {
    gmsh::model::occ::fragment({inputs.front()}, {inputs.begin() + 1, inputs.end()}, all, of_input);
  } catch (const std::string& error) {
    throw ModelError("the surfaces cannot be cut at their joints: " + error);
  }
  gmsh::model::occ::synchronize();
  for (std::size_t i = 0; i < inputs.size() && i < of_input.size(); ++i) {
    const int owner = owners.at(inputs[i]);
    for (const Entity& piece : of_input[i]) {
      if (piece.first != inputs[i].first) continue;
      std::vector<int>& known = pieces[piece];
      const auto next = std::lower_bound(known.begin(), known.end(), owner);
      if (next == known.end() || *next != owner) known.insert(next, owner);
    }
  }
  return pieces;
}

}  // namespace blocklift::structure
