#include "pipeline/verification/models/shells/shell_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <Eigen/Dense>

#include "structure/formulation/shell.h"
#include "structure/index.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/joints.h"
#include "structure/system/assembly.h"
#include "structure/system/matter.h"

namespace blocklift::structure::examples {

Material plain_steel() { return {"steel", 210e9, 0.3, 7850, 355e6}; }

Mesh empty_mesh(const Material& material, double thickness) {
  Mesh mesh;
  mesh.materials = {material};
  mesh.shell_sections = {{thickness, 0, 0}};
  mesh.groups = {{"plate", 0}};
  mesh.regions = {{"plate", 0, false}};
  return mesh;
}

int vertex_at(Mesh& mesh, const Vector3& place) {
  const double close = 1e-9 * (1 + place.norm());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if ((mesh.vertices[v] - place).norm() < close) return static_cast<int>(v);
  mesh.vertices.push_back(place);
  return static_cast<int>(mesh.vertices.size()) - 1;
}

void add_sheet(Mesh& mesh, const Chart& chart, int m, int n, int order, int section) {
  std::vector<int> vertices;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i)
      vertices.push_back(
          vertex_at(mesh, chart(static_cast<double>(i) / m, static_cast<double>(j) / n)));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      Shell shell;
      const std::size_t first = at(j * (m + 1) + i), next = first + at(m + 1);
      shell.vertices = {vertices[first], vertices[first + 1], vertices[next], vertices[next + 1]};
      shell.section = section;
      shell.label = static_cast<long>(mesh.shells.size()) + 1;
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
}

Mesh sheet_mesh(const Chart& chart, int m, int n, double thickness, const Material& material,
                int order) {
  Mesh mesh = empty_mesh(material, thickness);
  add_sheet(mesh, chart, m, n, order);
  return mesh;
}

Mesh macneal_patch(double thickness, const Material& material) {
  Mesh mesh = empty_mesh(material, thickness);
  mesh.vertices = {{0, 0, 0},       {0.24, 0, 0},    {0.24, 0.12, 0}, {0, 0.12, 0},
                   {0.04, 0.02, 0}, {0.18, 0.03, 0}, {0.16, 0.08, 0}, {0.08, 0.08, 0}};
  const std::vector<std::array<int, 4>> quads = {
      {0, 1, 4, 5}, {5, 1, 6, 2}, {7, 6, 3, 2}, {0, 4, 3, 7}, {4, 5, 7, 6}};
  for (const auto& vertices : quads) {
    Shell shell;
    shell.vertices = vertices;
    shell.label = static_cast<long>(mesh.shells.size()) + 1;
    mesh.shells.push_back(shell);
  }
  return mesh;
}

void add_hexahedra(Mesh& mesh, const std::vector<double>& x, const std::vector<double>& y,
                   const std::vector<double>& z, const Selects& fills) {
  SolidEdgeMiddles middles(mesh);
  for (std::size_t k = 0; k + 1 < z.size(); ++k)
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
      for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        if (!fills(0.5 * Vector3(x[i] + x[i + 1], y[j] + y[j + 1], z[k] + z[k + 1]))) continue;
        Solid solid;
        for (const std::size_t up : {k, k + 1})
          for (const auto& [a, b] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
            solid.vertices.push_back(vertex_at(mesh, {x[a], y[b], z[up]}));
        solid.label = static_cast<long>(mesh.solids.size()) + 1;
        complete_solid(mesh, solid, middles);
        mesh.solids.push_back(std::move(solid));
      }
}

void divide_into_triangles(Mesh& mesh, bool all) {
  std::vector<Shell> shells;
  for (std::size_t s = 0; s < mesh.shells.size(); ++s) {
    const Shell& shell = mesh.shells[s];
    if (!all && s % 2 == 0) {
      shells.push_back(shell);
      continue;
    }
    const auto [a, b, c, d] = shell.vertices;
    for (const std::array<int, 4>& vertices :
         {std::array<int, 4>{a, b, d, d}, std::array<int, 4>{d, c, a, a}}) {
      shells.push_back(shell);
      shells.back().vertices = vertices;
    }
  }
  mesh.shells = shells;
}

void add_beams(Mesh& mesh, const Vector3& a, const Vector3& b, int section, const Vector3& axis_2,
               const Vector3& offset) {
  const Vector3 way = b - a;
  std::vector<std::pair<double, int>> stops;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double share = (mesh.vertices[v] - a).dot(way) / way.squaredNorm();
    const double off = (mesh.vertices[v] - a - share * way).norm();
    if (off < 1e-9 * way.norm() && share > -1e-9 && share < 1 + 1e-9)
      stops.emplace_back(share, static_cast<int>(v));
  }
  std::sort(stops.begin(), stops.end());
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    Beam beam;
    beam.vertices = {stops[i].second, stops[i + 1].second};
    beam.section = section;
    beam.axis_2 = axis_2;
    beam.offset = {offset, offset};
    beam.label = static_cast<long>(mesh.beams.size()) + 1;
    mesh.beams.push_back(beam);
  }
}

void hold_at(const Space& space, const Selects& selects, const Motion& motion,
             const std::vector<int>& components, std::vector<FixedUnknown>& fixed) {
  std::vector<char> held(at(space.unknowns()), 0);
  for (const FixedUnknown& known : fixed) held[known.unknown] = 1;
  for (int node = 0; node < space.node_count(); ++node) {
    if (!selects(space.nodes().col(node))) continue;
    const Eigen::Matrix<double, 6, 1> wanted = motion(space.nodes().col(node));
    for (const int c : components) {
      const Space::Term *begin = space.begin_of(6 * node + c), *end = space.end_of(6 * node + c);
      if (end - begin == 1 && begin->weight == 1 && held[begin->unknown]++ == 0)
        fixed.push_back({begin->unknown, wanted[c]});
    }
  }
}

void hold(const Space& space, const Selects& selects, const std::vector<int>& components,
          std::vector<FixedUnknown>& fixed) {
  hold_at(
      space, selects,
      [](const Vector3&) -> Eigen::Matrix<double, 6, 1> {
        return Eigen::Matrix<double, 6, 1>::Zero();
      },
      components, fixed);
}

Eigen::VectorXd solve(const Space& space, const Eigen::VectorXd& load,
                      const std::vector<FixedUnknown>& fixed) {
  ConstrainedSystem system(assemble_stiffness(space), fixed);
  system.factorise();
  return space.expand(system.solve(space.reduce(load)));
}

Eigen::VectorXd area_load(const Space& space, const ForceField& force_per_area) {
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(space.freedoms(), 1);
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
    const Shell& shell = space.mesh().shells[space.shells()[cell].shell];
    const double thickness = space.mesh().section_of(shell).thickness;
    for_each_shell_point(space, {cell}, [&](const MatterPoint& p) {
      const Eigen::Matrix<double, 3, 1> force =
          p.volume / thickness * force_per_area(p.place - p.arm);
      add_forces(p, force, load);
    });
  }
  return load.col(0);
}

Eigen::VectorXd weight_load(const Space& space, double gravity) {
  // The body force of a field is -rho a.
  return inertia_loads(space, find_mass_properties(space, nullptr, nullptr)).col(2) * gravity;
}

namespace {

// Gauss points and weights of [0, 1].
Eigen::Matrix2Xd line_rule(int count) {
  const Eigen::Matrix3Xd square = square_rule(count);
  Eigen::Matrix2Xd line(2, count);
  for (int q = 0; q < count; ++q) {
    double weight = 0;
    for (int r = 0; r < count; ++r) weight += square(2, q + r * count);
    line.col(q) << square(0, q), weight;
  }
  return line;
}

std::vector<double> lagrange_slopes_by_difference(int degree, double x) {
  // Central difference of a polynomial of degree <= 4 by Richardson's rule is exact up to rounding.
  const double h = 0.25;
  std::vector<double> slopes(at(degree) + 1);
  const auto a = lagrange_values(degree, x - h), b = lagrange_values(degree, x + h),
             c = lagrange_values(degree, x - 2 * h), d = lagrange_values(degree, x + 2 * h);
  for (std::size_t i = 0; i < slopes.size(); ++i)
    slopes[i] = (8 * (b[i] - a[i]) - (d[i] - c[i])) / (12 * h);
  return slopes;
}

}  // namespace

Eigen::VectorXd edge_load(const Space& space, const Selects& selects,
                          const ForceField& force_per_length) {
  const int p = space.degree();
  const Eigen::Matrix2Xd rule = line_rule(p + 2);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell)
    for (const auto& [first, step] :
         {std::pair{0, 1}, std::pair{p * (p + 1), 1}, std::pair{0, p + 1}, std::pair{p, p + 1}}) {
      std::vector<int> nodes;
      for (int i = 0; i <= p; ++i) nodes.push_back(space.shell_nodes(cell)[first + i * step]);
      if (!std::all_of(nodes.begin(), nodes.end(),
                       [&](int n) { return selects(space.nodes().col(n)); }))
        continue;
      for (Eigen::Index q = 0; q < rule.cols(); ++q) {
        const auto values = lagrange_values(p, rule(0, q));
        const auto slopes = lagrange_slopes_by_difference(p, rule(0, q));
        Vector3 place = Vector3::Zero(), tangent = Vector3::Zero();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          place += values[i] * space.nodes().col(nodes[i]);
          tangent += slopes[i] * space.nodes().col(nodes[i]);
        }
        const Vector3 force = rule(1, q) * tangent.norm() * force_per_length(place);
        for (std::size_t i = 0; i < nodes.size(); ++i)
          load.segment<3>(6 * nodes[i]) += values[i] * force;
      }
    }
  return load;
}

int nearest_node(const Space& space, const Vector3& place) {
  Eigen::Index node = 0;
  (space.nodes().colwise() - place).colwise().squaredNorm().minCoeff(&node);
  return static_cast<int>(node);
}

Vector3 displacement_at(const Space& space, const Eigen::VectorXd& motion, const Vector3& place) {
  return motion.segment<3>(6 * nearest_node(space, place));
}

namespace {

Eigen::VectorXd motion_of_cell(const Space& space, int cell, const Eigen::VectorXd& motion) {
  Eigen::VectorXd own(6 * space.nodes_per_shell());
  for (int i = 0; i < space.nodes_per_shell(); ++i)
    own.segment<6>(6 * i) = motion.segment<6>(6 * space.shell_nodes(cell)[i]);
  return own;
}

}  // namespace

Eigen::Matrix3d shell_stress(const Space& space, int cell, const Eigen::Vector2d& xi, double z,
                             const Eigen::VectorXd& motion) {
  ShellOperator strains(space, xi);
  strains.reinit(cell);
  const ShellPoint& point = strains.points().front();
  const Eigen::Matrix<double, shell_strains, 1> strain =
      point.strain * motion_of_cell(space, cell, motion);
  const Shell& shell = space.mesh().shells[space.shells()[cell].shell];
  const Eigen::Matrix3d plane =
      shell_stiffness_law(space.mesh().material_of(shell), 1).block<3, 3>(0, 0);
  const Vector3 s = plane * (strain.segment<3>(membrane_11) + z * strain.segment<3>(curvature_11));
  return s[0] * point.e_1 * point.e_1.transpose() + s[1] * point.e_2 * point.e_2.transpose() +
         s[2] * (point.e_1 * point.e_2.transpose() + point.e_2 * point.e_1.transpose());
}

Eigen::Matrix3d stress_at(const Space& space, const Eigen::VectorXd& motion, const Vector3& place,
                          double z) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  int count = 0;
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell)
    for (const double x : {0.0, 1.0})
      for (const double y : {0.0, 1.0})
        if ((space.place(cell, {x, y}) - place).norm() < 1e-6 * (1 + place.norm())) {
          sum += shell_stress(space, cell, {x, y}, z, motion);
          ++count;
        }
  if (count == 0) throw std::runtime_error("no cell has a corner where the stress is wanted");
  return sum / count;
}

}  // namespace blocklift::structure::examples
