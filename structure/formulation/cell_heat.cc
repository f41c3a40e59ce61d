#include "structure/formulation/cell_heat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "parallel/threads.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/shell.h"
#include "structure/formulation/solid.h"
#include "structure/index.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Functions of the temperature over a shell at a point of its unit square: of its corners, then
/// what the middles of its edges have beyond the mean of their ends.
Eigen::Matrix<double, 1, 8> temperature_values(bool is_triangle, const Eigen::Vector2d& xi) {
  const double x = xi.x(), y = xi.y();
  Eigen::Matrix<double, 1, 8> values;
  values << (1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y, 4 * x * (1 - x) * (1 - y),
      4 * x * (1 - x) * y, 4 * y * (1 - y) * (1 - x), 4 * y * (1 - y) * x;
  // A triangle's area coordinates are (1 - x)(1 - y), x (1 - y) and y.
  if (is_triangle) {
    values[4] *= 1 - y;
    values[5] = 0;
  }
  return values;
}

/// The centre of a cell's area on its shell's unit square; a triangle narrows with 1 - y.
Eigen::Vector2d middle_of(const ShellCell& cell, bool is_triangle) {
  Eigen::Vector2d middle = cell.origin + cell.size * Eigen::Vector2d(0.5, 0.5);
  if (!is_triangle) return middle;
  const double from = cell.origin.y(), to = from + cell.size;
  const double half = (to * to - from * from) / 2;
  middle.y() = (half - (std::pow(to, 3) - std::pow(from, 3)) / 3) / (cell.size - half);
  return middle;
}

/// Forces or moments along e_1 and e_2 of those along the axes of a shell's laminate.
Eigen::Matrix3d turn_from_laminate(const Shell& shell, const Vector3& e_1, const Vector3& e_2) {
  const double angle = std::atan2(shell.laminate_axis.dot(e_2), shell.laminate_axis.dot(e_1));
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d strains;  // along the laminate's axes of those along e_1 and e_2
  strains << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return strains.transpose();
}

/// E alpha / (1 - nu): stress of a plate that is held in its plane, per kelvin.
double held_plate_stress(const Material& material, const MaterialExpansion& expansion) {
  return material.youngs_modulus * expansion.coefficient / (1 - material.poisson_ratio);
}

/// int alpha . Q alpha (1, z, z^2) dz of a plate.
Eigen::Vector3d plate_energies(const Mesh& mesh, const ShellSection& section,
                               const Expansions& expansions, double t) {
  if (section.laminate >= 0) return expansions.of_laminates[at(section.laminate)].energies;
  const MaterialExpansion& expansion = expansions.of_materials[at(section.material)];
  const double stress = held_plate_stress(mesh.materials[at(section.material)], expansion);
  return 2 * expansion.coefficient * stress * Eigen::Vector3d(t, 0, t * t * t / 12);
}

}  // namespace

CellHeat::CellHeat(const Space& space, const Expansions& expansions, TemperatureRises rises)
    : space_(&space),
      expansions_(&expansions),
      rises_(std::move(rises)),
      cases_(std::max({rises_.of_shells.cols(), rises_.of_beams.cols(), rises_.of_solids.cols()})) {
  for (Eigen::MatrixXd* one : {&rises_.of_shells, &rises_.of_beams, &rises_.of_solids})
    if (one->rows() == 0) one->resize(0, cases_);
  Eigen::Index first = 0;
  for (const Solid& solid : space.mesh().solids) {
    first_of_solid_.push_back(first);
    first += static_cast<Eigen::Index>(solid.vertices.size());
  }
}

CellHeat CellHeat::part(Eigen::Index first, Eigen::Index count) const {
  return {*space_,
          *expansions_,
          {rises_.of_shells.middleCols(first, count), rises_.of_beams.middleCols(first, count),
           rises_.of_solids.middleCols(first, count)}};
}

CellHeat::AtPoint CellHeat::at_shell(int cell, const Eigen::Vector2d& xi) const {
  const ShellCell& located = space_->shells()[cell];
  const bool is_triangle = space_->mesh().shells[located.shell].is_triangle();
  const Eigen::Matrix<double, 1, 8> values = temperature_values(
      is_triangle, space_->degree() == 1 ? middle_of(located, is_triangle)
                                         : Eigen::Vector2d(located.origin + located.size * xi));
  const auto rows = rises_.of_shells.middleRows<TemperatureRises::rows_of_shell>(
      TemperatureRises::rows_of_shell * located.shell);
  return {values * rows.topRows<8>(), values * rows.bottomRows<8>()};
}

Eigen::MatrixXd CellHeat::shell_forces(int cell, const Eigen::Vector2d& xi, const Vector3& e_1,
                                       const Vector3& e_2, double thickness) const {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(6, cases_);
  if (rises_.of_shells.rows() == 0) return forces;
  const Mesh& mesh = space_->mesh();
  const Shell& shell = mesh.shells[space_->shells()[cell].shell];
  const ShellSection& section = mesh.section_of(shell);
  const AtPoint here = at_shell(cell, xi);
  if (section.laminate < 0) {
    const double stress =
        held_plate_stress(mesh.material_of(shell), expansions_->of_materials[section.material]);
    forces.row(0) = forces.row(1) = stress * thickness * here.rise;
    forces.row(3) = forces.row(4) = stress * std::pow(thickness, 3) / 12 * here.slope;
    return forces;
  }
  const auto& held = expansions_->of_laminates[section.laminate].forces;
  const Eigen::Matrix3d turn = turn_from_laminate(shell, e_1, e_2);
  forces.topRows<3>() = turn * (held[0] * here.rise + held[1] * here.slope);
  forces.bottomRows<3>() = turn * (held[1] * here.rise + held[2] * here.slope);
  return forces;
}

Eigen::MatrixXd CellHeat::beam_strains(int cell, double xi) const {
  Eigen::MatrixXd strains = Eigen::MatrixXd::Zero(6, cases_);
  if (rises_.of_beams.rows() == 0) return strains;
  const BeamCell& located = space_->beams()[cell];
  const Mesh& mesh = space_->mesh();
  const double share = located.origin + located.size * (located.degree == 1 ? 0.5 : xi);
  const auto rows = rises_.of_beams.middleRows<TemperatureRises::rows_of_beam>(
      TemperatureRises::rows_of_beam * located.beam);
  const Eigen::Matrix<double, 3, Eigen::Dynamic> here =
      (1 - share) * rows.topRows<3>() + share * rows.bottomRows<3>();
  const int material = mesh.section_of(mesh.beams[located.beam]).material;
  const double alpha = expansions_->of_materials[material].coefficient;
  strains.row(0) = alpha * here.row(0);
  // x_3 k_2 - x_2 k_3 is the stretch at (x_2, x_3).
  strains.row(4) = alpha * here.row(1);
  strains.row(5) = -alpha * here.row(2);
  return strains;
}

Eigen::MatrixXd CellHeat::beam_forces(int cell) const {
  const Eigen::Index size = 6 * (space_->beams()[cell].degree + 1);
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(size, cases_);
  for (const BeamGaussPoint& point : beam_gauss_points(*space_, cell))
    forces += point.weight * point.strain.transpose() * (point.law * beam_strains(cell, point.xi));
  return forces;
}

Eigen::MatrixXd CellHeat::beam_release(int cell) const {
  if (rises_.of_beams.rows() == 0)
    return Eigen::MatrixXd::Zero(6 * (space_->beams()[cell].degree + 1), cases_);
  return beam_release_motion(*space_, cell, beam_forces(cell));
}

ExpansionStrains CellHeat::expansion_of(int solid) const {
  const Solid& one = space_->mesh().solids[solid];
  if (one.elasticity >= 0) return expansions_->of_elasticities[one.elasticity];
  ExpansionStrains strains = ExpansionStrains::Zero();
  strains.head<3>().setConstant(expansions_->of_materials[one.material].coefficient);
  return strains;
}

ExpansionStrains CellHeat::held_stress(int solid) const {
  return elasticity_of(space_->mesh(), space_->mesh().solids[solid]) * expansion_of(solid);
}

Eigen::MatrixXd CellHeat::solid_stresses(int solid, const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd stresses = Eigen::MatrixXd::Zero(6 * values.rows(), cases_);
  if (rises_.of_solids.rows() == 0) return stresses;
  const ExpansionStrains stress = held_stress(solid);
  const Eigen::MatrixXd rises =
      values * rises_.of_solids.middleRows(first_of_solid_[solid], values.cols());
  for (Eigen::Index q = 0; q < values.rows(); ++q)
    stresses.middleRows<6>(6 * q) = stress * rises.row(q);
  return stresses;
}

void CellHeat::add_shells(Eigen::MatrixXd& loads) const {
  if (rises_.of_shells.rows() == 0) return;
  constexpr int run = 4096, batch = 64;  // cells whose loads are kept, and that a thread takes
  const int cells = static_cast<int>(space_->shells().size()), nodes = space_->nodes_per_shell();
  const Eigen::Matrix3Xd rule = square_rule(space_->degree() + 1);
  std::vector<Eigen::MatrixXd> of_cells(run);
  for (int begin = 0; begin < cells; begin += run) {
    const int many = std::min(run, cells - begin);
    parallel::in_batches(many, batch, 0, [&](int first, int count) {
      ShellOperator shells(*space_, rule.topRows<2>());
      for (int i = first; i < first + count; ++i) {
        const int cell = begin + i;
        shells.reinit(cell);
        of_cells[i].setZero(6 * nodes, cases_);
        for (Eigen::Index q = 0; q < rule.cols(); ++q) {
          const ShellPoint& point = shells.points()[q];
          of_cells[i] +=
              rule(2, q) * point.area * point.strain.topRows<6>().transpose() *
              shell_forces(cell, rule.col(q).head<2>(), point.e_1, point.e_2, point.thickness);
        }
      }
    });
    for (int i = 0; i < many; ++i)
      for (int node = 0; node < nodes; ++node)
        loads.middleRows<6>(6L * space_->shell_nodes(begin + i)[node]) +=
            of_cells[i].middleRows<6>(6L * node);
  }
}

void CellHeat::add_beams(Eigen::MatrixXd& loads) const {
  if (rises_.of_beams.rows() == 0) return;
  for (int cell = 0; cell < static_cast<int>(space_->beams().size()); ++cell) {
    const Eigen::MatrixXd forces = beam_motion(*space_, cell).transpose() * beam_forces(cell);
    const std::vector<int>& nodes = space_->beams()[cell].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      loads.middleRows<6>(6L * nodes[i]) += forces.middleRows<6>(6 * static_cast<Eigen::Index>(i));
  }
}

void CellHeat::add_solids(Eigen::MatrixXd& loads) const {
  if (rises_.of_solids.rows() == 0) return;
  const Mesh& mesh = space_->mesh();
  for (int s = 0; s < static_cast<int>(mesh.solids.size()); ++s) {
    const Eigen::MatrixXd stresses =
        solid_stresses(s, topology_of(mesh.solids[s].shape).kind.values);
    const std::vector<SolidPoint> points = solid_points(mesh, mesh.solids[s]);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const Eigen::Matrix3Xd& g = points[q].gradients;
      for (Eigen::Index c = 0; c < cases_; ++c) {
        const auto v = stresses.col(c).segment<6>(6 * static_cast<Eigen::Index>(q));
        Eigen::Matrix3d stress;
        stress << v[0], v[3], v[5], v[3], v[1], v[4], v[5], v[4], v[2];
        const Eigen::Matrix3Xd forces = points[q].weight * stress * g;
        for (Eigen::Index i = 0; i < forces.cols(); ++i)
          loads.col(c).segment<3>(6L * space_->solid_nodes(s)[i]) += forces.col(i);
      }
    }
  }
}

Eigen::MatrixXd CellHeat::loads() const {
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(space_->freedoms(), cases_);
  add_shells(loads);
  add_beams(loads);
  add_solids(loads);
  return loads;
}

Eigen::RowVectorXd CellHeat::shell_energy() const {
  const Mesh& mesh = space_->mesh();
  Eigen::RowVectorXd energy = Eigen::RowVectorXd::Zero(cases_);
  if (rises_.of_shells.rows() == 0) return energy;
  constexpr int batch = 256;
  const int cells = static_cast<int>(space_->shells().size());
  const Eigen::Matrix3Xd rule = square_rule(space_->degree() + 1);
  std::vector<Eigen::RowVectorXd> of_batches(at((cells + batch - 1) / batch), energy);
  parallel::in_batches(cells, batch, 0, [&](int first, int count) {
    ShellOperator shells(*space_, rule.topRows<2>());
    for (int cell = first; cell < first + count; ++cell) {
      shells.reinit(cell);
      const ShellSection& section = mesh.section_of(mesh.shells[space_->shells()[cell].shell]);
      for (Eigen::Index q = 0; q < rule.cols(); ++q) {
        const ShellPoint& point = shells.points()[q];
        const Eigen::Vector3d of = plate_energies(mesh, section, *expansions_, point.thickness);
        const auto [rise, slope] = at_shell(cell, rule.col(q).head<2>());
        of_batches[at(first / batch)].array() +=
            rule(2, q) * point.area / 2 *
            (of[0] * rise.array().square() + 2 * of[1] * rise.array() * slope.array() +
             of[2] * slope.array().square());
      }
    }
  });
  for (const Eigen::RowVectorXd& part : of_batches) energy += part;
  return energy;
}

Eigen::RowVectorXd CellHeat::beam_energy() const {
  Eigen::RowVectorXd energy = Eigen::RowVectorXd::Zero(cases_);
  if (rises_.of_beams.rows() == 0) return energy;
  for (int cell = 0; cell < static_cast<int>(space_->beams().size()); ++cell) {
    for (const BeamGaussPoint& point : beam_gauss_points(*space_, cell)) {
      const Eigen::MatrixXd strains = beam_strains(cell, point.xi);
      energy += point.weight / 2 * strains.cwiseProduct(point.law * strains).colwise().sum();
    }
    energy -= beam_forces(cell).cwiseProduct(beam_release(cell)).colwise().sum() / 2;
  }
  return energy;
}

Eigen::RowVectorXd CellHeat::solid_energy() const {
  Eigen::RowVectorXd energy = Eigen::RowVectorXd::Zero(cases_);
  if (rises_.of_solids.rows() == 0) return energy;
  const Mesh& mesh = space_->mesh();
  for (int s = 0; s < static_cast<int>(mesh.solids.size()); ++s) {
    const Eigen::MatrixXd& values = topology_of(mesh.solids[s].shape).kind.values;
    const Eigen::MatrixXd rises =
        values * rises_.of_solids.middleRows(first_of_solid_[s], values.cols());
    const double of = expansion_of(s).dot(held_stress(s)) / 2;
    const std::vector<SolidPoint> points = solid_points(mesh, mesh.solids[s]);
    for (std::size_t q = 0; q < points.size(); ++q)
      energy += points[q].weight * of * rises.row(static_cast<Eigen::Index>(q)).cwiseAbs2();
  }
  return energy;
}

Eigen::RowVectorXd CellHeat::held_energy() const {
  return shell_energy() + beam_energy() + solid_energy();
}

}  // namespace blocklift::structure
