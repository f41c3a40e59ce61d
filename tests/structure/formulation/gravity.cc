#include "tests/structure/formulation/gravity.h"

#include <stdexcept>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/system/assembly.h"
#include "structure/system/linear_solver.h"
#include "structure/system/matter.h"

namespace blocklift::structure::test {

std::array<double, 3> weigh(const Mesh& mesh, int degree, const std::array<Vector3, 3>& supports) {
  const Space space(mesh, {degree, {}});
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(space.freedoms(), 1);
  for_each_matter_point(space, [&](const MatterPoint& point) {
    add_forces(point, Vector3(0, 0, -9.81 * point.mass), load);
  });
  std::vector<FixedUnknown> fixed;
  std::array<int, 3> upright{};
  const std::array<std::vector<int>, 3> held{{{2, 1, 0}, {2, 1}, {2}}};
  for (std::size_t s = 0; s < 3; ++s) {
    const int node = examples::nearest_node(space, supports[s]);
    if ((space.nodes().col(node) - supports[s]).norm() > 1e-9)
      throw std::runtime_error("no node lies at a support");
    upright[s] = static_cast<int>(fixed.size());
    for (const int c : held[s]) {
      const Space::Term* term = space.begin_of(6 * node + c);
      if (space.end_of(6 * node + c) - term != 1)
        throw std::runtime_error("a support is no unknown of its own");
      fixed.push_back({term->unknown, 0});
    }
  }
  ConstrainedSystem system(assemble_stiffness(space), fixed);
  system.factorise();
  const Eigen::MatrixXd forces = space.reduce(load);
  const Eigen::MatrixXd reactions = system.reactions(system.solve(forces), forces);
  std::array<double, 3> upward{};
  for (std::size_t s = 0; s < 3; ++s) upward[s] = reactions(upright[s], 0);
  return upward;
}

}  // namespace blocklift::structure::test
