#include "structure/stress/beam_stress.h"

#include <cmath>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/gauss_line.h"
#include "structure/space/joints.h"

namespace blocklift::structure {

namespace {

Eigen::MatrixXd motions_of_beam(const BeamCell& cell,
                                const Eigen::Ref<const Eigen::MatrixXd>& motions) {
  Eigen::MatrixXd local(6 * static_cast<Eigen::Index>(cell.nodes.size()), motions.cols());
  for (std::size_t i = 0; i < cell.nodes.size(); ++i)
    local.middleRows<6>(6 * static_cast<Eigen::Index>(i)) =
        motions.middleRows<6>(6 * static_cast<Eigen::Index>(cell.nodes[i]));
  return local;
}

const Beam& beam_of(const Space& space, int cell) {
  return space.mesh().beams[space.beams()[cell].beam];
}

double modulus_of(const Mesh& mesh, const BeamSection& section) {
  return mesh.materials[section.material].youngs_modulus;
}

BeamSection section_of(const Space& space, int cell, double xi) {
  const BeamCell& located = space.beams()[cell];
  return section_at(space.mesh(), beam_of(space, cell), located.origin + located.size * xi);
}

/// Motion of a cell's own ends.
Eigen::MatrixXd own_motion_of(const Space& space, int cell,
                              const Eigen::Ref<const Eigen::MatrixXd>& motions,
                              const CellHeat* heat) {
  Eigen::MatrixXd own = beam_motion(space, cell) * motions_of_beam(space.beams()[cell], motions);
  if (heat != nullptr) own += heat->beam_release(cell);
  return own;
}

/// Strains by the cell's own polynomials, beyond those of heat, which no force belongs to.
Eigen::MatrixXd own_strains_of(const Space& space, int cell, double xi,
                               const Eigen::Ref<const Eigen::MatrixXd>& motions,
                               const CellHeat* heat) {
  Eigen::MatrixXd strains =
      beam_point(space, cell, xi).strain * own_motion_of(space, cell, motions, heat);
  if (heat != nullptr) strains -= heat->beam_strains(cell, xi);
  return strains;
}

/// Of a tapered beam the strains that the section forces at the Gauss points, carried to the place,
/// give there: forces are smooth where the strains of a taper are no polynomial.
Eigen::MatrixXd strains_of(const Space& space, int cell, double xi,
                           const Eigen::Ref<const Eigen::MatrixXd>& motions, const CellHeat* heat) {
  if (beam_of(space, cell).end_section < 0) return own_strains_of(space, cell, xi, motions, heat);
  const auto law_at = [&](double place) {
    const BeamSection section = section_of(space, cell, place);
    return beam_stiffness_law(space.mesh().materials[section.material], section);
  };
  const std::vector<double> points = gauss_places(space.beams()[cell].degree);
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(6, motions.cols());
  const std::vector<double> shares = lagrange_at(points, xi);
  for (std::size_t q = 0; q < points.size(); ++q)
    forces += shares[q] * law_at(points[q]) * own_strains_of(space, cell, points[q], motions, heat);
  return algebra::least_squares(law_at(xi), forces);
}

Vector3 arm_of(const Beam& beam, const BeamCell& cell, double xi) {
  const double share = cell.origin + cell.size * xi;
  return (1 - share) * beam.offset[0] + share * beam.offset[1];
}

}  // namespace

std::vector<Eigen::Vector2d> stress_points(const BeamSection& section) {
  if (!section.stress_points.empty()) return section.stress_points;
  const double x = std::sqrt(3 * section.second_moment_3 / section.area),
               y = std::sqrt(3 * section.second_moment_2 / section.area);
  return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
}

Eigen::MatrixXd beam_stresses(const Space& space, int cell, double xi,
                              const Eigen::Ref<const Eigen::MatrixXd>& motions,
                              const CellHeat* heat) {
  const Eigen::MatrixXd strain = strains_of(space, cell, xi, motions, heat);
  const Beam& beam = beam_of(space, cell);
  const BeamSection section = section_of(space, cell, xi);
  const double modulus = modulus_of(space.mesh(), section);
  const std::vector<Eigen::Vector2d> points = stress_points(section);
  Eigen::MatrixXd stresses(static_cast<Eigen::Index>(points.size()), motions.cols());
  for (std::size_t p = 0; p < points.size(); ++p) {
    auto row = stresses.row(p);
    row = modulus * strain.row(0);
    if (!beam.is_rod)
      row += modulus * (points[p].y() * strain.row(4) - points[p].x() * strain.row(5));
  }
  return stresses;
}

Eigen::RowVectorXd beam_stress_at_centroid(const Space& space, int cell, double xi,
                                           const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                           const CellHeat* heat) {
  const BeamSection& section = space.mesh().section_of(beam_of(space, cell));
  return modulus_of(space.mesh(), section) * strains_of(space, cell, xi, motions, heat).row(0);
}

Eigen::MatrixXd beam_forces(const Space& space, int cell, double xi,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions,
                            const CellHeat* heat) {
  const BeamSection section = section_of(space, cell, xi);
  const Material& material = space.mesh().materials[section.material];
  Eigen::MatrixXd forces =
      beam_stiffness_law(material, section) * strains_of(space, cell, xi, motions, heat);
  if (!beam_of(space, cell).is_rod) return forces;
  for (const Eigen::Index row : {1, 2, 4, 5}) forces.row(row).setZero();
  return forces;
}

Eigen::MatrixXd as_uniaxial(const Eigen::MatrixXd& normal_stresses) {
  Eigen::MatrixXd stresses =
      Eigen::MatrixXd::Zero(6 * normal_stresses.rows(), normal_stresses.cols());
  for (Eigen::Index p = 0; p < normal_stresses.rows(); ++p)
    stresses.row(6 * p) = normal_stresses.row(p);
  return stresses;
}

BeamMotion beam_motion_at(const Space& space, int cell, double xi,
                          const Eigen::Ref<const Eigen::VectorXd>& motion, const CellHeat* heat) {
  const BeamCell& located = space.beams()[cell];
  const Eigen::VectorXd local = own_motion_of(space, cell, motion, heat);
  const std::vector<double> values = lagrange_values(located.degree, xi);
  BeamMotion moved;
  for (std::size_t i = 0; i < values.size(); ++i) {
    moved.displacement += values[i] * local.segment<3>(6 * static_cast<Eigen::Index>(i));
    moved.rotation += values[i] * local.segment<3>(6 * static_cast<Eigen::Index>(i) + 3);
  }
  moved.displacement += moved.rotation.cross(arm_of(beam_of(space, cell), located, xi));
  return moved;
}

}  // namespace blocklift::structure
