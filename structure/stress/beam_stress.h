#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/formulation/cell_heat.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// Points (x_2, x_3) of a beam's section at which its stress is looked at, m:
/// BeamSection::stress_points; of a section that has none the corners of the rectangle with its
/// area's radii of gyration, x_2 = +-sqrt(3 I_3 / A), x_3 = +-sqrt(3 I_2 / A).
std::vector<Eigen::Vector2d> stress_points(const BeamSection& section);

/// Normal stress along a beam at the points of its section, Pa: a row a point of stress_points(), a
/// column a motion (freedoms x k), s = E (stretch + x_3 k_2 - x_2 k_3); of a rod the stretch alone.
/// Ends that are released turn and move as the release lets them.
/// @param cell place in Space::beams(); @param xi on its unit length.
/// @param heat of as many cases as there are motions; null: none.
Eigen::MatrixXd beam_stresses(const Space& space, int cell, double xi,
                              const Eigen::Ref<const Eigen::MatrixXd>& motions,
                              const CellHeat* heat = nullptr);

/// Their mean over the section, N / A, a column a motion.
Eigen::RowVectorXd beam_stress_at_centroid(const Space& space, int cell, double xi,
                                           const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                           const CellHeat* heat = nullptr);

/// Section forces along a beam in its axes about the centroid: rows N, Q_2, Q_3, M_1, M_2, M_3 (N,
/// N m; beam_stiffness_law), a column a motion; of a rod all but N and M_1 are zero.
Eigen::MatrixXd beam_forces(const Space& space, int cell, double xi,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions,
                            const CellHeat* heat = nullptr);

/// Rows 6 point + component of Stress for rows of normal stresses.
Eigen::MatrixXd as_uniaxial(const Eigen::MatrixXd& normal_stresses);

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
