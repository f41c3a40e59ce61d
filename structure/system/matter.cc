#include "structure/system/matter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include "algebra/decompositions.h"
#include "parallel/threads.h"
#include "structure/error.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/shell.h"
#include "structure/formulation/solid.h"
#include "structure/index.h"
#include "structure/large_pages.h"
#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/joints.h"
#include "structure/space/space_implementation.h"

namespace blocklift::structure {

namespace {

Eigen::Matrix3d cross_matrix(const Vector3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// @param part none: all
void visit_beams(const Space& space, const MeshPart* part, const VisitMatter& visit) {
  const Mesh& mesh = space.mesh();
  for (int cell = 0; cell < static_cast<int>(space.beams().size()); ++cell) {
    const BeamCell& located = space.beams()[cell];
    if (part != nullptr && !MeshPart::has(part->beams, located.beam)) continue;
    const Beam& beam = mesh.beams[located.beam];
    const Eigen::Matrix3d axes = beam_axes(mesh, beam);
    const dealii::QGauss<1> rule(static_cast<unsigned>(located.degree) + 1);
    for (unsigned q = 0; q < rule.size(); ++q) {
      const double xi = rule.point(q)[0], share = located.origin + located.size * xi;
      const BeamSection section = section_at(mesh, beam, share);
      // I_23 is left out: the sections' own moments matter little beside those of where they stand.
      // What the section bears beyond its own mass is spread over it as its own is. Without an area
      // it hangs on the centroid.
      const double per_area = section.area > 0 ? 2 / section.area : 0;
      const double reach_2 = std::sqrt(per_area * section.second_moment_3);
      const double reach_3 = std::sqrt(per_area * section.second_moment_2);
      const std::array<Vector3, 4> reaches{reach_2 * axes.row(1), -reach_2 * axes.row(1),
                                           reach_3 * axes.row(2), -reach_3 * axes.row(2)};
      const BeamPoint strained = beam_point(space, cell, xi);
      const std::vector<double> values = lagrange_values(located.degree, xi);
      const Vector3 arm = (1 - share) * beam.offset[0] + share * beam.offset[1];
      MatterPoint point;
      point.nodes = located.nodes.data();
      point.values = values.data();
      point.node_count = located.degree + 1;
      const double length = 0.25 * rule.weight(q) * strained.weight;  // of each of the four points
      point.volume = length * section.area;
      point.mass = length * mass_per_length(mesh, section);
      for (const Vector3& reach : reaches) {
        point.arm = arm + reach;
        point.place = strained.place + reach;
        visit(point);
      }
    }
  }
}

void visit_solids(const Space& space, const MeshPart* part, const VisitMatter& visit) {
  const Mesh& mesh = space.mesh();
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    if (part != nullptr && !MeshPart::has(part->solids, static_cast<int>(s))) continue;
    const Solid& solid = mesh.solids[s];
    for (const SolidPoint& integrated : solid_points(mesh, solid)) {
      MatterPoint point;
      point.nodes = space.solid_nodes(static_cast<int>(s));
      point.values = integrated.values.data();
      point.node_count = static_cast<int>(solid.vertices.size());
      point.place = integrated.place;
      point.volume = integrated.weight;
      point.mass = integrated.weight * mesh.materials[solid.material].density;
      visit(point);
    }
  }
}

void visit_masses(const Space& space, const MeshPart* part, const VisitMatter& visit) {
  const std::vector<PointMass>& masses = space.mesh().masses;
  for (std::size_t m = 0; m < masses.size(); ++m) {
    const PointMass& mass = masses[m];
    if (!(mass.mass > 0)) continue;
    if (part != nullptr && !MeshPart::has(part->masses, static_cast<int>(m))) continue;
    const int node = space.node_of_vertex(mass.vertex);
    const double one = 1;
    MatterPoint point;
    point.nodes = &node;
    point.values = &one;
    point.node_count = 1;
    point.mass = mass.mass / 6;
    // Second moments int x x' along principal axes; the inertia is their trace less them.
    const auto axes = algebra::symmetric_eigensystem<3>(
        0.5 * mass.inertia.trace() * Eigen::Matrix3d::Identity() - mass.inertia);
    for (int i = 0; i < 3; ++i)
      for (const double side : {-1.0, 1.0}) {
        const double reach = std::sqrt(3 * std::max(0.0, axes.values[i]) / mass.mass);
        point.arm = mass.offset + side * reach * axes.vectors.col(i);
        point.place = space.nodes().col(node) + point.arm;
        visit(point);
      }
  }
}

/// F_k(x) of the twelve inertia fields for one kilogram at x: 3 x 12.
Eigen::Matrix<double, 3, 12> inertia_forces(const Vector3& x) {
  Eigen::Matrix<double, 3, 12> forces;
  forces.leftCols<3>() = -Eigen::Matrix3d::Identity();
  forces.middleCols<3>(3) = cross_matrix(x);  // -alpha x r = r x alpha
  // -(W r - tr(W) r)
  forces.col(6) << 0, x.y(), x.z();
  forces.col(7) << x.x(), 0, x.z();
  forces.col(8) << x.x(), x.y(), 0;
  forces.col(9) << -x.y(), -x.x(), 0;
  forces.col(10) << 0, -x.z(), -x.y();
  forces.col(11) << -x.z(), 0, -x.x();
  return forces;
}

}  // namespace

namespace {

/// Shape functions and geometry at the Gauss points of shell cells.
class ShellRule {
 public:
  explicit ShellRule(const Space& space)
      : space_(space),
        rule_(static_cast<unsigned>(space.degree()) + 1),
        values_(*space.implementation().shell_mapping, space.implementation().shell_element, rule_,
                dealii::update_quadrature_points | dealii::update_JxW_values |
                    dealii::update_normal_vectors) {}

  std::vector<Eigen::VectorXd> shapes() const {
    std::vector<Eigen::VectorXd> shapes;
    for (const auto& xi : rule_.get_points()) shapes.push_back(space_.shell_values({xi[0], xi[1]}));
    return shapes;
  }
  std::size_t size() const { return rule_.size(); }
  void find(int cell, ShellGaussPoint* points) {
    values_.reinit(space_.implementation().shell_cells[cell]);
    const ShellCell& located = space_.shells()[cell];
    const Shell& shell = space_.mesh().shells[located.shell];
    for (unsigned q = 0; q < rule_.size(); ++q) {
      const auto& x = values_.quadrature_point(q);
      const auto& n = values_.normal_vector(q);
      const auto& xi = rule_.point(q);
      const double thickness = thickness_at(
          space_.mesh(), shell, located.origin + located.size * Eigen::Vector2d(xi[0], xi[1]));
      points[q] = {
          {x[0], x[1], x[2]}, {n[0], n[1], n[2]}, 0.5 * values_.JxW(q) * thickness, thickness};
    }
  }

 private:
  const Space& space_;
  dealii::QGauss<2> rule_;
  dealii::FEValues<2, 3> values_;
};

/// Both heights of each Gauss point of a cell.
template <typename Visit>
void visit_cell(const Space& space, int cell, const std::vector<Eigen::VectorXd>& shapes,
                const ShellGaussPoint* points, const Visit& visit) {
  const Shell& shell = space.mesh().shells[space.shells()[cell].shell];
  const ShellSection& section = space.mesh().section_of(shell);
  MatterPoint point;
  point.nodes = space.shell_nodes(cell);
  point.node_count = space.nodes_per_shell();
  for (std::size_t q = 0; q < shapes.size(); ++q) {
    point.values = shapes[q].data();
    point.volume = points[q].volume;
    const double area = point.volume / points[q].thickness;  // of half the thickness: half of it
    point.mass = area * mass_per_area(space.mesh(), shell, points[q].thickness);
    for (const double side : {-1.0, 1.0}) {
      point.arm =
          (section.offset + side * points[q].thickness / std::sqrt(12.0)) * points[q].normal;
      point.place = points[q].place + point.arm;
      visit(point);
    }
  }
}

}  // namespace

void for_each_shell_point(const Space& space, const std::vector<int>& cells,
                          const VisitMatter& visit) {
  if (cells.empty()) return;
  ShellRule rule(space);
  const std::vector<Eigen::VectorXd> shapes = rule.shapes();
  std::vector<ShellGaussPoint> points(rule.size());
  for (const int cell : cells) {
    rule.find(cell, points.data());
    visit_cell(space, cell, shapes, points.data(), visit);
  }
}

void for_each_matter_point(const Space& space, const VisitMatter& visit) {
  Matter(space, 1).visit(visit);
}

Matter::Matter(const Space& space, int threads) : space_(space) {
  const int cells = static_cast<int>(space.shells().size());
  if (cells == 0) return;
  shapes_ = ShellRule(space).shapes();
  points_.resize(at(cells) * shapes_.size());
  parallel::in_batches(cells, 256, threads, [&](int first, int count) {
    ShellRule rule(space);
    for (int cell = first; cell < first + count; ++cell)
      rule.find(cell, points_.data() + at(cell) * shapes_.size());
  });
}

void Matter::visit(const VisitMatter& visit) const {
  for (int cell = 0; cell < static_cast<int>(space_.shells().size()); ++cell)
    visit_shell(cell, visit);
  visit_others(visit);
}

void Matter::visit_shell(int cell, const VisitMatter& visit) const {
  visit_cell(space_, cell, shapes_, points_.data() + at(cell) * shapes_.size(), visit);
}

void Matter::visit_others(const VisitMatter& visit) const {
  visit_beams(space_, nullptr, visit);
  visit_solids(space_, nullptr, visit);
  visit_masses(space_, nullptr, visit);
}

Wrench resultant(const Space& space, const Eigen::Ref<const Eigen::VectorXd>& load) {
  Wrench sum;
  for (Eigen::Index n = 0; n < space.node_count(); ++n) {
    const Vector3 force = load.segment<3>(6 * n);
    sum.force += force;
    sum.moment += space.nodes().col(n).cross(force) + load.segment<3>(6 * n + 3);
  }
  return sum;
}

namespace {

/// The cells that each shell was divided into. Cells of two shells have no node in common.
std::vector<std::vector<int>> cells_by_shell(const Space& space) {
  std::vector<std::vector<int>> cells(space.mesh().shells.size());
  for (std::size_t cell = 0; cell < space.shells().size(); ++cell)
    cells[space.shells()[cell].shell].push_back(static_cast<int>(cell));
  return cells;
}

}  // namespace

Eigen::MatrixXd inertia_loads(const Space& space, const MassProperties& mass) {
  return inertia_loads(Matter(space), mass);
}

Eigen::MatrixXd inertia_loads(const Matter& matter, const MassProperties& mass, int threads) {
  const Space& space = matter.space();
  Eigen::MatrixXd loads = make_large_zero(space.freedoms(), 12);
  const VisitMatter add = [&](const MatterPoint& p) {
    const Eigen::Matrix<double, 3, 12> forces =
        p.mass * mass.density_factor(p.place) * inertia_forces(p.place);
    add_forces(p, forces, loads);
  };
  // Shell by shell: threads add to rows of their own, each row in the order of its cells.
  const std::vector<std::vector<int>> cells = cells_by_shell(space);
  parallel::in_batches(static_cast<int>(cells.size()), 32, threads, [&](int first, int count) {
    for (int shell = first; shell < first + count; ++shell)
      for (const int cell : cells[shell]) matter.visit_shell(cell, add);
  });
  matter.visit_others(add);
  return loads;
}

Eigen::MatrixXd inertia_loads(const Space& space, const MassProperties& mass,
                              const MeshPart& part) {
  Eigen::MatrixXd loads = make_large_zero(space.freedoms(), 12);
  const VisitMatter add = [&](const MatterPoint& p) {
    const Eigen::Matrix<double, 3, 12> forces =
        p.mass * mass.density_factor(p.place) * inertia_forces(p.place);
    add_forces(p, forces, loads);
  };
  std::vector<int> cells;
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell)
    if (MeshPart::has(part.shells, space.shells()[cell].shell)) cells.push_back(cell);
  for_each_shell_point(space, cells, add);
  visit_beams(space, &part, add);
  visit_solids(space, &part, add);
  visit_masses(space, &part, add);
  return loads;
}

void add_spread_wrenches(const Space& space, const std::vector<int>& cells, const Vector3& point,
                         const Eigen::MatrixXd& wrenches, Eigen::MatrixXd& loads) {
  // The cells' own nodes, numbered for themselves.
  std::vector<int> nodes;
  for (const int cell : cells)
    nodes.insert(nodes.end(), space.shell_nodes(cell),
                 space.shell_nodes(cell) + space.nodes_per_shell());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<int> own(at(space.nodes_per_shell()));
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(nodes.size()), 6);
  Eigen::Matrix<double, 6, 6> resultants = Eigen::Matrix<double, 6, 6>::Zero();
  double volume = 0;
  for_each_shell_point(space, cells, [&](MatterPoint p) {
    Eigen::Matrix<double, 3, 6> forces;
    forces << Eigen::Matrix3d::Identity(), -cross_matrix(p.place - point);
    forces *= p.volume;
    for (std::size_t i = 0; i < own.size(); ++i)
      own[i] = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), p.nodes[i]) -
                                nodes.begin());
    p.nodes = own.data();
    add_forces(p, forces, fields);
    volume += p.volume;
  });
  if (!(volume > 0)) throw ModelError("no plate is there to spread a force over");
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto forces = fields.middleRows<6>(6 * static_cast<Eigen::Index>(n));
    resultants.topRows<3>() += forces.topRows<3>();
    resultants.bottomRows<3>() +=
        cross_matrix(space.nodes().col(nodes[n]) - point) * forces.topRows<3>() +
        forces.bottomRows<3>();
  }
  // Twice: the second pass removes the rounding of the first.
  Eigen::MatrixXd factors = algebra::solve_by_full_pivoting(resultants, wrenches);
  factors += algebra::solve_by_full_pivoting(resultants, wrenches - resultants * factors);
  const Eigen::MatrixXd spread = fields * factors;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    loads.middleRows<6>(6 * static_cast<Eigen::Index>(nodes[n])) +=
        spread.middleRows<6>(6 * static_cast<Eigen::Index>(n));
}

Eigen::MatrixXd spread_wrenches(const Space& space, const std::vector<int>& cells,
                                const Vector3& point, const Eigen::MatrixXd& wrenches) {
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(space.freedoms(), wrenches.cols());
  add_spread_wrenches(space, cells, point, wrenches, loads);
  return loads;
}

namespace {

/// Sums the mass matrix of one cell after another, whose points come one behind the other.
class MassSum {
 public:
  explicit MassSum(const Space& space) : space_(space) {}

  void add(const MatterPoint& point, double dm) {
    if (!std::equal(members_.begin(), members_.end(), point.nodes, point.nodes + point.node_count))
      flush(point);
    const Eigen::Matrix3d arm = cross_matrix(point.arm);
    Eigen::Matrix<double, 6, 6> block;
    block << Eigen::Matrix3d::Identity(), -arm, arm, -arm * arm;
    for (int j = 0; j < count_; ++j)
      for (int i = 0; i < count_; ++i)
        own_.block<6, 6>(6 * i, 6 * j) += dm * point.values[i] * point.values[j] * block;
  }
  Eigen::SparseMatrix<double> finish() {
    flush({});
    Eigen::SparseMatrix<double> matrix(space_.freedoms(), space_.freedoms());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
  }

 private:
  void flush(const MatterPoint& next) {
    // What the two faces of a plate have against each other is rounding.
    const double least = own_.size() > 0 ? 1e-14 * own_.cwiseAbs().maxCoeff() : 0;
    for (int j = 0; j < 6 * count_; ++j)
      for (int i = 0; i < 6 * count_; ++i)
        if (std::abs(own_(i, j)) > least)
          entries_.emplace_back(6 * members_[i / 6] + i % 6, 6 * members_[j / 6] + j % 6,
                                own_(i, j));
    count_ = next.node_count;
    members_.assign(next.nodes, next.nodes + next.node_count);
    own_.setZero(6 * count_, 6 * count_);
  }

  const Space& space_;
  int count_ = 0;
  std::vector<int> members_;
  Eigen::MatrixXd own_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

Eigen::SparseMatrix<double> mass_matrix(const Space& space, const MassProperties& mass) {
  MassSum sum(space);
  for_each_matter_point(space, [&](const MatterPoint& point) {
    sum.add(point, point.mass * mass.density_factor(point.place));
  });
  return sum.finish();
}

}  // namespace blocklift::structure
