#pragma once

#include <vector>

#include "dynamics/multibody/added_inertia.h"

namespace blocklift::dynamics {

/// Heading of a frame H: of the level part of its x axis, from the world's x towards its y, rad.
/// Zero where that axis stands upright.
double find_heading(const Matrix3& R_WH);

/// R_WL of the level axes L of a frame H: z points upwards, x along H's heading, so that they turn
/// with its yaw and not with its roll and pitch.
///
/// What is linear in the waves and in small motions, the databases' excitation and memory, acts
/// along them: to the first order they are H's axes. Along H's axes themselves a first-order force
/// F would bring the second-order force theta x F of the tilt theta, whose mean does not vanish and
/// which is one of several parts of a force of second order of which the others are not there
/// (Pinkster 1980, ch. III; Faltinsen, Sea Loads (1990), ch. 3 and 5).
Matrix3 level_axes(const Matrix3& R_WH);

/// From each frame's own axes into its level ones: rows (angular; linear) of frame after frame, 6N,
/// of velocities or of a Jacobian (AddedInertia). Does not allocate.
void turn_to_level_axes(const std::vector<BodyFrame>& frames, const Kinematics& kinematics,
                        Eigen::Ref<Eigen::MatrixXd> rows);

/// Adds forces on the frames' origins R along their level axes (moment about R; force; 6N) to those
/// on the bodies about Bo in W. With velocities of turn_to_level_axes their power is force times
/// velocity. Does not allocate.
void add_level_forces(const std::vector<BodyFrame>& frames, const Kinematics& kinematics,
                      ConstVectorRef force, std::vector<ForceVector>& F_Bo_W);

}  // namespace blocklift::dynamics
