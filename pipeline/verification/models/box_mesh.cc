#include "pipeline/verification/models/box_mesh.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "structure/elasticity/stiffness.h"

namespace blocklift::structure::testing {

BlockMesh box_mesh(const std::array<int, 3>& counts, const Vector3& size, const Material& material,
                   const std::function<Vector3(const Vector3&)>& place) {
  BlockMesh mesh;
  mesh.materials = {material};
  mesh.groups = {{"box", 0}};
  mesh.sheet_names = {"box"};
  const auto vertex = [&](int i, int j, int k) {
    return (k * (counts[1] + 1) + j) * (counts[0] + 1) + i;
  };
  for (int k = 0; k <= counts[2]; ++k)
    for (int j = 0; j <= counts[1]; ++j)
      for (int i = 0; i <= counts[0]; ++i) {
        const Vector3 x(size.x() * i / counts[0], size.y() * j / counts[1],
                        size.z() * k / counts[2]);
        mesh.vertices.push_back(place ? place(x) : x);
      }
  for (int k = 0; k < counts[2]; ++k)
    for (int j = 0; j < counts[1]; ++j)
      for (int i = 0; i < counts[0]; ++i) {
        std::array<int, 8> cell{};
        for (int v = 0; v < 8; ++v)
          cell[static_cast<std::size_t>(v)] =
              vertex(i + (v & 1), j + ((v >> 1) & 1), k + ((v >> 2) & 1));
        mesh.cells.push_back(cell);
      }
  mesh.cell_group.assign(mesh.cells.size(), 0);
  mesh.cell_sheet.assign(mesh.cells.size(), 0);
  mesh.cell_normal.assign(mesh.cells.size(), 2);
  return mesh;
}

void turn_cells(HexMesh& mesh) {
  // Rotations as (axis permutation, flips) with positive determinant.
  std::vector<std::pair<std::array<int, 3>, int>> rotations;
  std::array<int, 3> axes{0, 1, 2};
  do {
    const bool even = (axes[1] == (axes[0] + 1) % 3);
    for (int flips = 0; flips < 8; ++flips) {
      const int count = (flips & 1) + ((flips >> 1) & 1) + ((flips >> 2) & 1);
      if ((count % 2 == 0) == even) rotations.emplace_back(axes, flips);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& [axis, flips] = rotations[(c * 7 + 3) % rotations.size()];
    std::array<int, 8> turned{};
    for (std::size_t v = 0; v < 8; ++v) {
      std::size_t from = 0;
      for (int a = 0; a < 3; ++a)
        if (((v >> a) & 1U) != ((static_cast<unsigned>(flips) >> a) & 1U))
          from |= std::size_t{1} << axis[static_cast<std::size_t>(a)];
      turned[v] = mesh.cells[c][from];
    }
    mesh.cells[c] = turned;
  }
}

void hold(const Discretisation& space, const std::function<bool(const Vector3&)>& selects,
          const std::function<Vector3(const Vector3&)>& displacement,
          const std::array<bool, 3>& axes, std::vector<FixedUnknown>& fixed) {
  std::vector<char> held(static_cast<std::size_t>(space.unknowns()), 0);
  for (const FixedUnknown& known : fixed) held[static_cast<std::size_t>(known.unknown)] = 1;
  for (int n = 0; n < space.node_count(); ++n) {
    const Vector3 x = space.nodes.col(n);
    if (!selects(x)) continue;
    const Vector3 value = displacement(x);
    for (int a = 0; a < 3; ++a) {
      const int unknown = 3 * n + a;
      if (axes[static_cast<std::size_t>(a)] && !held[static_cast<std::size_t>(unknown)])
        fixed.push_back({unknown, value[a]});
    }
  }
}

Eigen::VectorXd solve(const HexMesh& mesh, const Discretisation& space,
                      const std::vector<FixedUnknown>& fixed, const Eigen::VectorXd& load) {
  SparseLower stiffness = assemble_stiffness(mesh, space, 2);
  ConstrainedSystem system(std::move(stiffness), fixed);
  system.factorise();
  return system.solve(load);
}

}  // namespace blocklift::structure::testing
