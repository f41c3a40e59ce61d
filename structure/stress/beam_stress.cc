#include "structure/stress/beam_stress.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/gauss_line.h"
#include "structure/space/joints.h"
#include "structure/stress_tensor.h"

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

/// Strains by the cell's own polynomials, beyond those of heat, which no force belongs to; of a rod
/// stretch and twist alone.
/// @param own motion of the cell's ends (own_motion_of).
Eigen::MatrixXd own_strains_of(const Space& space, int cell, double xi, const Eigen::MatrixXd& own,
                               const CellHeat* heat) {
  Eigen::MatrixXd strains = beam_point(space, cell, xi).strain * own;
  if (heat != nullptr) strains -= heat->beam_strains(cell, xi);
  if (beam_of(space, cell).is_rod)
    for (const Eigen::Index row : {1, 2, 4, 5}) strains.row(row).setZero();
  return strains;
}

Eigen::Matrix<double, 6, 6> law_of(const Space& space, const BeamSection& section) {
  return beam_stiffness_law(space.mesh().materials[section.material], section);
}

/// Section forces at the Gauss points, carried to a place.
/// @param law at that place.
Eigen::MatrixXd carried_forces(const Space& space, int cell, double xi,
                               const Eigen::Matrix<double, 6, 6>& law, const Eigen::MatrixXd& own,
                               const CellHeat* heat) {
  const bool is_tapered = beam_of(space, cell).end_section >= 0;
  const std::vector<double> points = gauss_places(space.beams()[cell].degree);
  const std::vector<double> shares = lagrange_at(points, xi);
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(6, own.cols());
  for (std::size_t q = 0; q < points.size(); ++q)
    forces += shares[q] * (is_tapered ? law_of(space, section_of(space, cell, points[q])) : law) *
              own_strains_of(space, cell, points[q], own, heat);
  return forces;
}

/// What a section feels of motions, a column each.
struct SectionState {
  BeamSection section;
  Eigen::MatrixXd strains, forces;  ///< rows as BeamPoint::strain and beam_forces
};

/// Of a tapered beam the strains that the section forces at the Gauss points, carried to the place,
/// give there: forces are smooth where the strains of a taper are no polynomial.
SectionState state_at(const Space& space, int cell, double xi,
                      const Eigen::Ref<const Eigen::MatrixXd>& motions, const CellHeat* heat) {
  const Beam& beam = beam_of(space, cell);
  const Eigen::MatrixXd own = own_motion_of(space, cell, motions, heat);
  SectionState state;
  state.section = section_of(space, cell, xi);
  const Eigen::Matrix<double, 6, 6> law = law_of(space, state.section);
  state.forces = carried_forces(space, cell, xi, law, own, heat);
  if (beam.end_section < 0) {
    state.strains = own_strains_of(space, cell, xi, own, heat);
    for (const Eigen::Index row : {0, 4, 5}) state.forces.row(row) = law.row(row) * state.strains;
  } else {
    state.strains = algebra::least_squares(law, state.forces);
  }
  if (beam.is_rod)
    for (const Eigen::Index row : {1, 2, 4, 5}) {
      state.forces.row(row).setZero();
      state.strains.row(row).setZero();
    }
  return state;
}

std::vector<SectionPoint> points_of(const BeamSection& section, bool is_rod) {
  std::vector<SectionPoint> points = checked_points(section);
  if (!is_rod) return points;
  return {*std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::abs(a.of_torsion) < std::abs(b.of_torsion);
  })};
}

Vector3 arm_of(const Beam& beam, const BeamCell& cell, double xi) {
  const double share = cell.origin + cell.size * xi;
  return (1 - share) * beam.offset[0] + share * beam.offset[1];
}

}  // namespace

std::vector<SectionPoint> points_of_beam(const Mesh& mesh, const Beam& beam, double share) {
  return points_of(section_at(mesh, beam, share), beam.is_rod);
}

Eigen::MatrixXd beam_stresses(const Space& space, int cell, double xi,
                              const Eigen::Ref<const Eigen::MatrixXd>& motions,
                              const CellHeat* heat) {
  const SectionState state = state_at(space, cell, xi, motions, heat);
  const std::vector<SectionPoint> points = points_of(state.section, beam_of(space, cell).is_rod);
  const double modulus = modulus_of(space.mesh(), state.section);
  const Eigen::RowVectorXd torsion = torsion_about_twist_centre(state.section, state.forces);
  constexpr Eigen::Index normal = 0, shear = 3;  // 11 and 12 of Stress
  Eigen::MatrixXd stresses =
      Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(points.size()), motions.cols());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SectionPoint& point = points[p];
    const auto first = 6 * static_cast<Eigen::Index>(p);
    stresses.row(first + normal) =
        modulus * (state.strains.row(0) + point.place.y() * state.strains.row(4) -
                   point.place.x() * state.strains.row(5));
    stresses.row(first + shear) = point.of_torsion * torsion +
                                  point.of_force[0] * state.forces.row(1) +
                                  point.of_force[1] * state.forces.row(2);
  }
  return stresses;
}

double largest_von_mises(const Eigen::VectorXd& stresses) {
  double largest = 0;
  for (Eigen::Index row = 0; row < stresses.rows(); row += 6)
    largest = std::max(largest, von_mises(Stress(stresses.segment<6>(row))));
  return largest;
}

Eigen::RowVectorXd beam_stress_at_centroid(const Space& space, int cell, double xi,
                                           const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                           const CellHeat* heat) {
  const SectionState state = state_at(space, cell, xi, motions, heat);
  return modulus_of(space.mesh(), state.section) * state.strains.row(0);
}

Eigen::MatrixXd beam_forces(const Space& space, int cell, double xi,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions,
                            const CellHeat* heat) {
  return state_at(space, cell, xi, motions, heat).forces;
}

Eigen::RowVectorXd torsion_about_twist_centre(const BeamSection& section,
                                              const Eigen::MatrixXd& forces) {
  const Eigen::Vector2d centre = section.twist_centre();
  return forces.row(3) - (centre[0] * forces.row(2) - centre[1] * forces.row(1));
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
