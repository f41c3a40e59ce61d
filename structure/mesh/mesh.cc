#include "structure/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Lagrange polynomials through `count` equally spaced points of [0, 1].
Eigen::VectorXd lagrange(int count, double x) {
  Eigen::VectorXd values = Eigen::VectorXd::Ones(count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      if (j != i) values[i] *= (x * (count - 1) - j) / (i - j);
  return values;
}

class Forest {
 public:
  explicit Forest(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

/// All sets of vertices that something joins.
template <typename Visit>
void for_each_joint(const Mesh& mesh, const Visit& visit) {
  for (const Shell& shell : mesh.shells)
    visit(std::vector<int>(shell.vertices.begin(), shell.vertices.end()));
  for (const Beam& beam : mesh.beams)
    visit(std::vector<int>(beam.vertices.begin(), beam.vertices.end()));
  for (const Solid& solid : mesh.solids) visit(solid.vertices);
  for_each_link(mesh, [&](const std::vector<int>& all, long) { visit(all); });
  for (const SurfacePoint& point : mesh.surface_points) {
    std::vector<int> all{mesh.shells[point.shell].vertices[0], point.vertex};
    for (const SurfaceStretch& stretch : point.line)
      all.push_back(mesh.shells[stretch.shell].vertices[0]);
    visit(all);
  }
  for (const Spring& spring : mesh.springs) {
    std::vector<int> all;
    for (const int vertex : spring.vertices)
      if (vertex >= 0) all.push_back(vertex);
    visit(all);
  }
}

/// Bars take E and G apart: Poisson's ratio, which is but what they stand for, may be any. True of
/// a material with a ratio that no plate or solid can have, where none has it.
bool is_of_bars_alone(const Mesh& mesh, int material) {
  const Material& own = mesh.materials[material];
  if (own.poisson_ratio > -1 && own.poisson_ratio < 0.5) return false;
  const bool is_of_bars =
      std::any_of(mesh.beam_sections.begin(), mesh.beam_sections.end(),
                  [&](const BeamSection& section) { return section.material == material; });
  return is_of_bars && own.youngs_modulus > 0 && own.shear_modulus() > 0 && own.density >= 0 &&
         own.yield_stress > 0 &&
         std::none_of(mesh.shell_sections.begin(), mesh.shell_sections.end(),
                      [&](const ShellSection& section) { return section.material == material; }) &&
         std::none_of(mesh.solids.begin(), mesh.solids.end(),
                      [&](const Solid& solid) { return solid.material == material; });
}

}  // namespace

std::vector<int> vertices_of(const RigidLink& link) {
  std::vector<int> all{link.master};
  all.insert(all.end(), link.slaves.begin(), link.slaves.end());
  return all;
}

std::vector<int> vertices_of(const DistributingLink& link) {
  std::vector<int> all{link.reference};
  all.insert(all.end(), link.vertices.begin(), link.vertices.end());
  return all;
}

std::vector<int> vertices_of(const MotionEquation& equation) {
  std::vector<int> all;
  for (const MotionEquation::Term& term : equation.terms) all.push_back(term.vertex);
  return all;
}

double balance(const Mesh& mesh, MotionEquation& equation) {
  const Vector3 origin = mesh.vertices[equation.terms.front().vertex];
  // Rotations count over a length, so that all coefficients are of one kind. Places that differ by
  // rounding are one.
  constexpr double rounding = 1e-10;
  double size = 0, largest = 0, reach = 0;
  for (const MotionEquation::Term& term : equation.terms) {
    size = std::max(size, (mesh.vertices[term.vertex] - origin).norm());
    reach = std::max(reach, mesh.vertices[term.vertex].norm());
  }
  if (!(size > rounding * reach)) size = 1;
  for (const MotionEquation::Term& term : equation.terms)
    largest = std::max({largest, term.of_displacement.cwiseAbs().maxCoeff(),
                        term.of_rotation.cwiseAbs().maxCoeff() / size});
  // Resultant of a change of the coefficients that may change: those of the terms but the first
  // that are not nil.
  std::vector<double*> free;
  std::vector<Eigen::Matrix<double, 6, 1>> columns;
  Eigen::Matrix<double, 6, 1> resultant = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t t = 0; t < equation.terms.size(); ++t) {
    MotionEquation::Term& term = equation.terms[t];
    const Vector3 arm = (mesh.vertices[term.vertex] - origin) / size;
    for (int i = 0; i < 6; ++i) {
      Eigen::Matrix<double, 6, 1> column = Eigen::Matrix<double, 6, 1>::Zero();
      if (i < 3)
        column << Vector3::Unit(i), arm.cross(Vector3::Unit(i));
      else
        column.tail<3>() = Vector3::Unit(i - 3) / size;
      double& value = i < 3 ? term.of_displacement[i] : term.of_rotation[i - 3];
      resultant += value * column;
      if (t == 0 || value == 0) continue;
      free.push_back(&value);
      columns.push_back(i < 3 ? column : size * column);
    }
  }
  const auto count = static_cast<Eigen::Index>(free.size());
  if (count == 0) return resultant.isZero(0) ? 0 : std::numeric_limits<double>::infinity();
  Eigen::MatrixXd effect(6, count);
  for (Eigen::Index i = 0; i < count; ++i) effect.col(i) = columns[i];
  const Eigen::VectorXd change = algebra::least_squares(effect, -resultant);
  if ((effect * change + resultant).norm() > 1e-9 * largest)
    return std::numeric_limits<double>::infinity();
  double most = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool is_rotation = columns[i].head<3>().isZero();
    *free[i] += (is_rotation ? size : 1) * change[i];
    most = std::max(most, std::abs(change[i]) / largest);
  }
  return most;
}

namespace {

/// Between two sections of one shape their points, and what their stress has for arms: J of_torsion
/// and A of_force. Sections of different walls have no points in common: none.
/// @param here the figures at the place.
std::vector<SectionPoint> shear_points_between(const BeamSection& from, const BeamSection& to,
                                               const BeamSection& here, double share) {
  if (from.shear_points.size() != to.shear_points.size()) return {};
  std::vector<SectionPoint> points;
  for (std::size_t p = 0; p < from.shear_points.size(); ++p) {
    const SectionPoint &a = from.shear_points[p], &b = to.shear_points[p];
    SectionPoint& point = points.emplace_back();
    point.place = (1 - share) * a.place + share * b.place;
    if (here.torsion > 0)
      point.of_torsion =
          ((1 - share) * from.torsion * a.of_torsion + share * to.torsion * b.of_torsion) /
          here.torsion;
    if (here.area > 0)
      point.of_force =
          ((1 - share) * from.area * a.of_force + share * to.area * b.of_force) / here.area;
  }
  return points;
}

}  // namespace

BeamSection section_at(const Mesh& mesh, const Beam& beam, double share) {
  BeamSection section = mesh.section_of(beam);
  // A rod bears no shear that would go through a point of its own.
  if (beam.is_rod) section.twists_about_centroid = true;
  if (beam.end_section < 0) return section;
  const BeamSection& end = mesh.beam_sections[beam.end_section];
  const auto between = [share](double& value, double of_end) {
    // Infinite shear areas, of sections that shear does not deform, stay so.
    if (std::isfinite(value) && std::isfinite(of_end))
      value += share * (of_end - value);
    else
      value = std::numeric_limits<double>::infinity();
  };
  for (double BeamSection::*figure :
       {&BeamSection::area, &BeamSection::second_moment_2, &BeamSection::second_moment_3,
        &BeamSection::product_23, &BeamSection::torsion, &BeamSection::mass_per_length,
        &BeamSection::shear_area_2, &BeamSection::shear_area_3})
    between(section.*figure, end.*figure);
  for (std::size_t p = 0; p < section.stress_points.size(); ++p)
    section.stress_points[p] += share * (end.stress_points[p] - section.stress_points[p]);
  section.shear_points = shear_points_between(mesh.section_of(beam), end, section, share);
  section.shear_centre += share * (end.shear_centre - section.shear_centre);
  return section;
}

Vector3 position(const Mesh& mesh, const Shell& shell, const Eigen::Vector2d& xi) {
  if (shell.curvature >= 0) {
    const Eigen::Matrix3Xd& points = mesh.curved_shells[shell.curvature];
    const int count = static_cast<int>(std::lround(std::sqrt(static_cast<double>(points.cols()))));
    const Eigen::VectorXd along_xi = lagrange(count, xi.x()), along_eta = lagrange(count, xi.y());
    Vector3 place = Vector3::Zero();
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i)
        place += along_xi[i] * along_eta[j] * points.col(j * count + i);
    return place;
  }
  const auto vertex = [&](std::size_t i) { return mesh.vertices[shell.vertices[i]]; };
  return (1 - xi.y()) * ((1 - xi.x()) * vertex(0) + xi.x() * vertex(1)) +
         xi.y() * ((1 - xi.x()) * vertex(2) + xi.x() * vertex(3));
}

double thickness_at(const Mesh& mesh, const Shell& shell, const Eigen::Vector2d& xi) {
  if (shell.taper < 0) return mesh.section_of(shell).thickness;
  const std::array<double, 4>& corners = mesh.shell_tapers[shell.taper];
  return (1 - xi.y()) * ((1 - xi.x()) * corners[0] + xi.x() * corners[1]) +
         xi.y() * ((1 - xi.x()) * corners[2] + xi.x() * corners[3]);
}

double longest_edge(const Mesh& mesh, const Shell& shell) {
  const auto length = [&](std::size_t a, std::size_t b) {
    return (mesh.vertices[shell.vertices[a]] - mesh.vertices[shell.vertices[b]]).norm();
  };
  return std::max({length(0, 1), length(2, 3), length(0, 2), length(1, 3)});
}

std::vector<int> connected_parts(const Mesh& mesh) {
  Forest forest(mesh.vertices.size());
  std::vector<char> used(mesh.vertices.size(), 0);
  for_each_joint(mesh, [&](const std::vector<int>& joined) {
    for (const int vertex : joined) {
      used[vertex] = 1;
      forest.join(vertex, joined.front());
    }
  });
  std::vector<int> part(mesh.vertices.size(), -1), number(mesh.vertices.size(), -1);
  int next = 0;
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (used[v] == 0) continue;
    int& of_root = number[forest.root(static_cast<int>(v))];
    if (of_root < 0) of_root = next++;
    part[v] = of_root;
  }
  return part;
}

void check_mesh(const Mesh& mesh) {
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  const auto require = [](bool holds, const char* what, long label, const char* wrong) {
    if (!holds) throw ModelError(fmt::format("{} {} {}", what, label, wrong));
  };
  const auto exists = [&](int vertex) { return vertex >= 0 && vertex < count(mesh.vertices); };
  for (std::size_t m = 0; m < mesh.materials.size(); ++m)
    if (!is_of_bars_alone(mesh, static_cast<int>(m))) check_material(mesh.materials[m]);
  for (const ShellSection& section : mesh.shell_sections) {
    if (!(section.thickness > 0))
      throw ModelError(
          fmt::format("a plate's thickness is {:g} m; it must be positive", section.thickness));
    if (section.material < 0 || section.material >= count(mesh.materials))
      throw ModelError("a plate's section names no material");
  }
  for (const Shell& shell : mesh.shells) {
    require(std::all_of(shell.vertices.begin(), shell.vertices.end(), exists), "shell", shell.label,
            "names a vertex that is not there");
    require(shell.section >= 0 && shell.section < count(mesh.shell_sections), "shell", shell.label,
            "has no thickness");
    require(shell.region >= 0 && shell.region < count(mesh.regions), "shell", shell.label,
            "belongs to no region");
    require(shell.taper < count(mesh.shell_tapers), "shell", shell.label,
            "has thicknesses at its corners that are not there");
    if (shell.taper >= 0) {
      const std::array<double, 4>& corners = mesh.shell_tapers[shell.taper];
      require(*std::min_element(corners.begin(), corners.end()) > 0, "shell", shell.label,
              "has no positive thickness at a corner");
      require(mesh.section_of(shell).laminate < 0, "shell", shell.label,
              "is of layers, whose thickness is even");
    }
    const auto vertex = [&](std::size_t i) { return mesh.vertices[shell.vertices[i]]; };
    const double area = 0.5 * ((vertex(3) - vertex(0)).cross(vertex(2) - vertex(1))).norm();
    const double size = longest_edge(mesh, shell);
    require(area > 1e-8 * size * size, "shell", shell.label,
            "has no area, or its corners are not in turn about it");
  }
  for (const Beam& beam : mesh.beams) {
    require(exists(beam.vertices[0]) && exists(beam.vertices[1]), "beam", beam.label,
            "names a vertex that is not there");
    require(beam.section >= 0 && beam.section < count(mesh.beam_sections), "beam", beam.label,
            "has no section");
    if (beam.end_section >= 0) {
      require(beam.end_section < count(mesh.beam_sections), "beam", beam.label,
              "has no section at its end");
      const BeamSection &first = mesh.section_of(beam),
                        &last = mesh.beam_sections[beam.end_section];
      require(first.material == last.material &&
                  first.stress_points.size() == last.stress_points.size(),
              "beam", beam.label, "has sections at its ends of two kinds");
    }
    const Vector3 along = mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]];
    require(along.norm() > 0, "beam", beam.label, "has no length");
    require(along.cross(beam.axis_2).norm() > 1e-6 * along.norm() * beam.axis_2.norm(), "beam",
            beam.label, "runs along the direction that is to tell its second axis");
  }
  for (const Solid& solid : mesh.solids) {
    require(std::all_of(solid.vertices.begin(), solid.vertices.end(), exists), "solid", solid.label,
            "names a vertex that is not there");
    require(static_cast<int>(solid.vertices.size()) == topology_of(solid.shape).nodes(), "solid",
            solid.label, "has another number of nodes than its shape");
    require(solid.material >= 0 && solid.material < count(mesh.materials), "solid", solid.label,
            "has no material");
    require(solid.elasticity < count(mesh.elasticities), "solid", solid.label, "has no elasticity");
    require(least_jacobian_ratio(mesh, solid) > 0, "solid", solid.label,
            "is folded or has no volume");
  }
  for (const PointMass& mass : mesh.masses)
    require(exists(mass.vertex) && mass.mass >= 0, "mass", mass.label,
            "is negative or at a vertex that is not there");
  for (const RigidLink& link : mesh.rigid_links)
    require(exists(link.master) && std::all_of(link.slaves.begin(), link.slaves.end(), exists),
            "rigid link", link.label, "names a vertex that is not there");
  for (const DistributingLink& link : mesh.distributing_links)
    require(exists(link.reference) && link.weights.size() == link.vertices.size() &&
                !link.vertices.empty() &&
                std::all_of(link.vertices.begin(), link.vertices.end(), exists),
            "distributing link", link.label, "names a vertex that is not there");
  for (const MotionEquation& equation : mesh.equations) {
    const std::vector<int> vertices = vertices_of(equation);
    require(!vertices.empty() && std::all_of(vertices.begin(), vertices.end(), exists), "equation",
            equation.label, "names a vertex that is not there");
    MotionEquation balanced = equation;
    require(balance(mesh, balanced) < 1e-6, "equation", equation.label,
            "resists motions of the whole");
  }
}

}  // namespace blocklift::structure
