#include "structure/elasticity/natural_modes.h"

#include <vector>

#include "structure/elasticity/mass_matrix.h"
#include "structure/elasticity/rigid_freedom.h"

namespace blocklift::structure {

namespace {

// The mass of the unknowns 3 n + a: that of the nodes for each axis a.
SparseLower along_axes(const NodalMass& mass) {
  std::vector<Eigen::Triplet<double, long>> entries;
  entries.reserve(3 * static_cast<std::size_t>(mass.nonZeros()));
  for (long column = 0; column < mass.cols(); ++column)
    for (NodalMass::InnerIterator entry(mass, column); entry; ++entry)
      for (int a = 0; a < 3; ++a)
        entries.emplace_back(3 * entry.row() + a, 3 * column + a, entry.value());
  SparseLower whole(3 * mass.rows(), 3 * mass.cols());
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

}  // namespace

NaturalModes find_part_modes(const PartModel& model, int count) {
  check_part_mesh(model.mesh);
  std::vector<int> support_of;
  const std::vector<FixedUnknown> held = part_supports(model, support_of);
  const int rigid = find_rigid_freedom(model, held).count;
  const std::vector<FixedUnknown> fixed = with_idle_nodes(model, held);
  Eigen::MatrixXd trial = trial_shapes(model.mesh.nodes, 3);
  const SparseLower mass = along_axes(part_mass_matrix(model));
  for (long k = 0; k < mass.cols(); ++k)  // points of no solid
    if (!(mass.coeff(k, k) > 0)) trial.row(k).setZero();
  return find_natural_modes(assemble_part_stiffness(model), mass, trial, fixed, rigid, count,
                            EliminationOrder::found);
}

}  // namespace blocklift::structure
