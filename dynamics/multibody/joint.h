#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// How a body B may move against its parent P. The joint frame J is fixed in P (pose X_PJ); at zero
/// coordinates B coincides with J. Coordinates q and velocities v, in this order:
///
/// | kind          | q                                            | v                           |
/// |---------------|----------------------------------------------|-----------------------------|
/// | fixed         | none                                         | none                        |
/// | revolute      | angle about the axis                         | dq/dt                       |
/// | prismatic     | displacement along the axis                  | dq/dt                       |
/// | cylindrical   | angle about the axis, displacement along it  | dq/dt                       |
/// | universal     | angles about the axis, then about the second | dq/dt                       |
/// | spherical     | quaternion (w, x, y, z) of R_JB              | w_PB expressed in B         |
/// | planar        | two displacements, angle about the normal    | dq/dt                       |
/// | translational | three displacements along the axes of J      | dq/dt                       |
/// | free          | p_JoBo_J, quaternion of R_JB                 | w_PB, v_PBo, expressed in B |
///
/// w_PB is the angular velocity of B in P, v_PBo the velocity of Bo in P. A universal joint's first
/// axis is fixed in P, its second in B; the displacements of a planar joint have directions fixed
/// in P. Angles in rad, displacements in m. The paper's Table I names most of them.
enum class JointKind {
  fixed,
  revolute,
  prismatic,
  cylindrical,
  universal,
  spherical,
  planar,
  translational,
  free
};

/// Number of coordinates q of a joint.
int coordinate_count(JointKind kind);
/// Number of velocities v of a joint (its degrees of freedom).
int velocity_count(JointKind kind);
/// True where v is dq/dt entry by entry; false for joints with a quaternion.
bool velocities_are_rates(JointKind kind);
/// Index of the quaternion's first entry within the joint's q; none for joints without one.
std::optional<int> quaternion_offset(JointKind kind);

/// "revolute", "free", ...
std::string_view joint_kind_name(JointKind kind);
/// The kind of that name; none if there is no such kind.
std::optional<JointKind> joint_kind(std::string_view name);
/// All names, in the order of the enumeration.
const std::vector<std::string_view>& joint_kind_names();

/// A joint's geometry, in the joint frame J. Axes need not be of unit length: the builder sees to
/// it.
struct Joint {
  JointKind kind = JointKind::fixed;
  /// Revolute, prismatic, cylindrical: the axis. Universal: the first axis. Planar: the normal.
  Vector3 axis = Vector3::UnitZ();
  /// Universal: the second axis, perpendicular to the first. Planar: direction of the first
  /// displacement, perpendicular to the normal; the second is normal x first. NaN: chosen by the
  /// builder.
  Vector3 second_axis = Vector3::Constant(not_a_number);
};

/// q at which the body coincides with its joint frame: zeros, and a unit quaternion where there is
/// one.
Eigen::VectorXd zero_coordinates(JointKind kind);

/// dq/dt of one joint from its v; arrays of coordinate_count and velocity_count entries.
void joint_rates(JointKind kind, const double* q, const double* v, double* rates);

/// q (+) s v: moves one joint's q at the constant velocity v (in its own convention) during s
/// seconds, exactly: a rotation about a fixed axis for spherical, a screw motion for free.
/// Quaternions come out with unit length. `result` may be `q`.
void integrate_joint(JointKind kind, const double* q, const double* v, double s, double* result);

/// The v that carries q_from to q_to within one second by integrate_joint (the shorter way round).
void difference_joint(JointKind kind, const double* q_from, const double* q_to, double* v);

}  // namespace blocklift::dynamics
