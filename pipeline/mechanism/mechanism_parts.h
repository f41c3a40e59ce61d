#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/multibody/joint.h"
#include "dynamics/multibody/loop_definition.h"
#include "pipeline/declaration/geometry_format.h"
#include "pipeline/declaration/parameters_format.h"
#include "pipeline/declaration/table.h"

/// What cranes and mechanism files are made of, declared once for both.
namespace blocklift::pipeline {

/// Box for the drawing, in its body's frame.
struct BoxShape {
  Vector3 size = Vector3::Zero();      ///< along x, y, z, m
  Vector3 centre = Vector3::Zero();    ///< m
  Vector3 attitude = Vector3::Zero();  ///< roll, pitch, yaw, rad
};

/// Area on which the wind acts.
struct WindAreaModel {
  double area = std::numeric_limits<double>::quiet_NaN();         ///< m^2
  double coefficient = std::numeric_limits<double>::quiet_NaN();  ///< of pressure
  std::optional<Vector3> normal;     ///< of a flat area, in the body's frame; none: no direction
  Vector3 centre = Vector3::Zero();  ///< of pressure, in the body's frame, m
};

/// Products and moments of inertia about the centre of mass, kg m^2.
struct InertiaModel {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

/// Rigid body of a mechanism.
struct BodyModel {
  Located<std::string> name;
  double mass = std::numeric_limits<double>::quiet_NaN();  ///< kg
  Vector3 centre_of_mass = Vector3::Zero();                ///< in the body's frame, m
  std::optional<Located<Vector3>> radii_of_gyration;       ///< about the axes through it, m
  std::optional<Located<InertiaModel>> inertia;
  std::vector<BoxShape> shapes;
  std::vector<WindAreaModel> wind_areas;

  /// Inertia about the centre of mass along the body's axes, kg m^2. Off-diagonal entries are the
  /// negative products of inertia as the file gives them: I_xy = xy.
  Eigen::Matrix3d inertia_matrix() const;
};

/// Joint that carries a body.
struct JointModel {
  Located<std::string> name;
  dynamics::JointKind kind = dynamics::JointKind::fixed;
  Located<std::string> parent;
  Located<std::string> child;
  Vector3 axis = Vector3::UnitZ();
  std::optional<Vector3> second_axis;
  Vector3 position = Vector3::Zero();  ///< of the joint frame in the parent, m
  Vector3 attitude = Vector3::Zero();  ///< of the joint frame in the parent, rad
  std::vector<Located<Quantity>> damping;
};

/// What a drive or a winch can do; lengths or angles as its joint moves.
struct DriveLimits {
  Located<Quantity> speed;
  Located<Quantity> acceleration;
  Located<Quantity> jerk;
  std::array<Quantity, 2> range{};  ///< lowest and highest coordinate
};

/// Points of a coordinate over time.
using TimeTable = std::vector<std::array<Quantity, 2>>;

/// Drive that prescribes a joint's motion: moved by an operation within its limits, at constant
/// speed, or along a table. The latter two are for mechanism files alone.
struct DriveModel : DriveLimits {
  Located<std::string> name;
  Located<std::string> joint;
  Located<int> degree_of_freedom;  ///< of the joint, from 1
  std::optional<Located<Quantity>> constant_speed;
  std::optional<Located<TimeTable>> table;
};

/// A point of a body.
struct PointModel {
  Located<std::string> body;
  Vector3 position = Vector3::Zero();  ///< in the body's frame, m
  Mark place;
};

/// A degree of freedom of a joint.
struct JointAxis {
  Located<std::string> joint;
  Located<int> degree_of_freedom{1, {}};  ///< from 1
};

/// One side of a loop: a frame in a body or, of a gear, a degree of freedom of a joint.
struct LoopSide {
  std::optional<Located<std::string>> body;
  std::optional<Located<Vector3>> position;  ///< of the loop's frame in the body, m
  std::optional<Located<Vector3>> attitude;  ///< of the loop's frame in the body, rad
  std::optional<Located<std::string>> joint;
  std::optional<Located<int>> degree_of_freedom;  ///< from 1
  Mark place;
};

/// What must hold between two bodies besides the joints of the tree.
struct LoopModel {
  Located<std::string> name;
  dynamics::LoopKind kind = dynamics::LoopKind::revolute;
  std::optional<LoopSide> first;
  std::optional<LoopSide> second;
  std::optional<Located<Vector3>> axis;
  std::optional<Located<Vector3>> second_axis;
  std::optional<Located<double>> length;    ///< m
  std::optional<Located<Quantity>> ratio;   ///< of a gear
  std::optional<Located<Quantity>> offset;  ///< of a gear
  std::optional<Located<std::vector<std::vector<PointModel>>>> paths;
};

enum class SpringKind { point, joint, torsional };

/// Spring and damper between two points, at a degree of freedom of a joint, or between the
/// orientations of two bodies.
struct SpringModel {
  Located<std::string> name;
  SpringKind kind = SpringKind::point;
  std::optional<PointModel> from;
  std::optional<PointModel> to;
  std::optional<Located<std::string>> joint;
  std::optional<Located<int>> degree_of_freedom;  ///< from 1
  Located<Quantity> stiffness;
  std::optional<Located<Quantity>> damping;
  std::optional<Located<double>> free_length;        ///< m
  std::optional<Located<Quantity>> free_coordinate;  ///< m or rad
  std::optional<Located<Vector3>> free_orientation;  ///< rad: roll, pitch, yaw
};

/// Positions or velocities of joints: the values that the file gives to each.
using JointValues = std::vector<Named<Located<std::vector<Quantity>>>>;

/// Bodies joined to a mechanism, with what acts between them. SI units.
struct MechanismParts {
  std::vector<BodyModel> bodies;
  std::vector<JointModel> joints;
  std::vector<LoopModel> loops;
  std::vector<SpringModel> springs;
  std::vector<DriveModel> drives;

  const BodyModel* find_body(const std::string& name) const;
  const JointModel* find_joint(const std::string& name) const;
  const DriveModel* find_drive(const std::string& name) const;
};

/// For each velocity of a joint: does it turn (true) or displace (false)?
std::vector<bool> joint_turns(dynamics::JointKind kind);

Format<BodyModel> body_format();
Format<JointModel> joint_format();
Format<LoopModel> loop_format();
Format<SpringModel> spring_format();
/// `{body: boom, position: [1 m, 0 m, 0 m]}`
Format<PointModel> point_format();
/// Values of joints by name, each one quantity or several, of any of these dimensions.
Format<JointValues> joint_values_format(const std::vector<Dimension>& dimensions);
/// Area on which the wind acts; shared with blocks.
Format<WindAreaModel> wind_area_format();

/// Quantities that a drive's coordinate and its derivatives may be.
extern const std::vector<Dimension> travels, speeds, accelerations, jerks;
/// Quantities that a joint's positions may be: travels, and the plain numbers of a quaternion.
extern const std::vector<Dimension> joint_positions;

/// The keys of a drive that are the same in cranes and in mechanism files.
/// @param limits_required in cranes; elsewhere a drive may follow a table instead.
Table<DriveModel> drive_table(bool limits_required);

}  // namespace blocklift::pipeline
