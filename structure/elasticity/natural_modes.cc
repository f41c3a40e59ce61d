#include "structure/elasticity/natural_modes.h"

#include <vector>

#include "structure/elasticity/part_unknowns.h"
#include "structure/elasticity/rigid_freedom.h"

namespace blocklift::structure {

NaturalModes find_part_modes(const PartModel& model, int count) {
  check_part_mesh(model.mesh);
  std::vector<int> support_of;
  const std::vector<FixedUnknown> held = part_supports(model, support_of);
  const int rigid = find_rigid_freedom(model, held).count;
  const PartUnknowns unknowns(model.mesh, model.joints.ties);
  NaturalModes modes = find_natural_modes(assemble_part_stiffness(model, unknowns),
                                          assemble_part_mass(model, unknowns),
                                          unknowns.to_unknowns(trial_shapes(model.mesh.nodes, 3)),
                                          unknowns.to_unknowns(held), rigid, count);
  modes.shapes = unknowns.to_freedoms(modes.shapes);
  return modes;
}

}  // namespace blocklift::structure
