#include "tests/structure/formulation/shell_samples.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "structure/index.h"
#include "structure/system/assembly.h"
#include "structure/system/matter.h"

namespace blocklift::structure::samples {

Mesh mesh_of(const Chart& chart, int m, int n, double thickness, const Material& material,
             int order) {
  Mesh mesh;
  mesh.materials = {material};
  mesh.shell_sections = {{thickness, 0, 0}};
  mesh.groups = {{"plate", 0}};
  mesh.regions = {{"plate", 0, false}};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i)
      mesh.vertices.push_back(chart(static_cast<double>(i) / m, static_cast<double>(j) / n));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      Shell shell;
      const int first = j * (m + 1) + i;
      shell.vertices = {first, first + 1, first + m + 1, first + m + 2};
      shell.label = j * m + i + 1;
      if (order > 1) {
        shell.curvature = static_cast<int>(mesh.curved_shells.size());
        Eigen::Matrix3Xd points(3, (order + 1) * (order + 1));
        for (int b = 0; b <= order; ++b)
          for (int a = 0; a <= order; ++a)
            points.col(b * (order + 1) + a) = chart((i + static_cast<double>(a) / order) / m,
                                                    (j + static_cast<double>(b) / order) / n);
        mesh.curved_shells.push_back(points);
      }
      mesh.shells.push_back(shell);
    }
  return mesh;
}

Material steel() { return {"steel", 210e9, 0.3, 7850, 355e6}; }

void hold(const Space& space, const std::function<bool(const Vector3&)>& selects,
          const std::vector<int>& components, std::vector<FixedUnknown>& fixed) {
  std::vector<char> held(at(space.unknowns()), 0);
  for (const FixedUnknown& known : fixed) held[at(known.unknown)] = 1;
  for (int node = 0; node < space.node_count(); ++node) {
    if (!selects(space.nodes().col(node))) continue;
    for (const int c : components) {
      const Space::Term *begin = space.begin_of(6 * node + c), *end = space.end_of(6 * node + c);
      if (end - begin == 1 && held[at(begin->unknown)]++ == 0)
        fixed.push_back({begin->unknown, 0});
    }
  }
}

Eigen::VectorXd solve(const Space& space, const Eigen::VectorXd& load,
                      const std::vector<FixedUnknown>& fixed) {
  ConstrainedSystem system(assemble_stiffness(space), fixed);
  system.factorise();
  return space.expand(system.solve(space.reduce(load)));
}

Eigen::VectorXd area_load(const Space& space,
                          const std::function<Vector3(const Vector3&)>& force_per_area) {
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(space.freedoms(), 1);
  std::vector<int> cells(space.shells().size());
  std::iota(cells.begin(), cells.end(), 0);
  const double thickness = space.mesh().shell_sections[0].thickness;
  for_each_shell_point(space, cells, [&](const MatterPoint& p) {
    const Eigen::Matrix<double, 3, 1> force =
        p.volume / thickness * force_per_area(p.place - p.arm);
    add_forces(p, force, load);
  });
  return load.col(0);
}

int nearest_node(const Space& space, const Vector3& place) {
  Eigen::Index node = 0;
  (space.nodes().colwise() - place).colwise().squaredNorm().minCoeff(&node);
  return static_cast<int>(node);
}

}  // namespace blocklift::structure::samples
