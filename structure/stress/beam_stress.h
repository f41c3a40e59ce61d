#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/formulation/cell_heat.h"
#include "structure/mesh/beams/section_shear.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// Stress of a beam at the points of its section, Pa: rows 6 point + component of Stress for
/// points_of_beam(), a column a motion (freedoms x k).
///
/// The normal stress along the beam is s = E (stretch + x_3 k_2 - x_2 k_3), of a rod that of its
/// stretch alone; the shear stress (12) is that of SectionPoint, of a rod that of torsion alone.
/// All other components are zero, and von Mises' stress is sqrt(s^2 + 3 tau^2).
/// Ends that are released turn and move as the release lets them.
/// @param cell place in Space::beams(); @param xi on its unit length.
/// @param heat of as many cases as there are motions; null: none.
Eigen::MatrixXd beam_stresses(const Space& space, int cell, double xi,
                              const Eigen::Ref<const Eigen::MatrixXd>& motions,
                              const CellHeat* heat = nullptr);

/// The points of a beam's section at a share of its length that beam_stresses looks at:
/// checked_points(), of a rod, whose stress is one all over its section, the one with most torsion.
/// A taper may have fewer at an end where its torsion constant or its area vanishes.
std::vector<SectionPoint> points_of_beam(const Mesh& mesh, const Beam& beam, double share);

/// The largest von Mises stress of the points of a section, Pa.
/// @param stresses a column of beam_stresses.
double largest_von_mises(const Eigen::VectorXd& stresses);

/// Mean normal stress over the section, N / A, a column a motion.
Eigen::RowVectorXd beam_stress_at_centroid(const Space& space, int cell, double xi,
                                           const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                           const CellHeat* heat = nullptr);

/// Section forces along a beam in its axes about the centroid: rows N, Q_2, Q_3, M_1, M_2, M_3 (N,
/// N m; beam_stiffness_law), a column a motion; of a rod all but N and M_1 are zero. Forces across
/// and torsion are those of the Gauss points, carried to the place: between these the shear strain
/// of a slender beam's polynomials is no force's.
Eigen::MatrixXd beam_forces(const Space& space, int cell, double xi,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions,
                            const CellHeat* heat = nullptr);

/// Torsion moment that twists a section, about BeamSection::twist_centre(): M_1 of the forces about
/// the centroid less the moment of Q_2 and Q_3, which act there without twisting it (G J twist).
/// @param forces rows of beam_forces.
Eigen::RowVectorXd torsion_about_twist_centre(const BeamSection& section,
                                              const Eigen::MatrixXd& forces);

/// Motion of a point of a beam's centroid line for one motion of the block, and the one case of its
/// heat.
struct BeamMotion {
  Vector3 displacement = Vector3::Zero();  ///< m
  Vector3 rotation = Vector3::Zero();      ///< rad
};
BeamMotion beam_motion_at(const Space& space, int cell, double xi,
                          const Eigen::Ref<const Eigen::VectorXd>& motion,
                          const CellHeat* heat = nullptr);

}  // namespace blocklift::structure
