#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/multibody/joint.h"
#include "pipeline/input/geometry_format.h"
#include "pipeline/input/rope_model.h"

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

/// Rigid body of a crane.
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

/// Drive that prescribes a joint's motion.
struct DriveModel : DriveLimits {
  Located<std::string> name;
  Located<std::string> joint;
  Located<int> degree_of_freedom;  ///< of the joint, from 1
};

/// Body of small size in which a tackle ends.
struct HookBlockModel {
  double mass = std::numeric_limits<double>::quiet_NaN();  ///< kg
  double wind_area = 0;                                    ///< m^2, from any side
  double wind_coefficient = 0;
  Vector3 size = Vector3::Zero();  ///< of the box in the drawing, m
};

/// Hoist: a winch on a body lets out a tackle whose hook block hangs free.
struct HoistModel {
  Located<std::string> name;
  Located<std::string> body;
  Vector3 sheave = Vector3::Zero();  ///< where the tackle leaves the body, in its frame, m
  HookBlockModel hook_block;
  RopeChoice rope_choice;
  RopeModel rope;                                                    ///< after the look-up
  double crane_stiffness = std::numeric_limits<double>::infinity();  ///< in series, N/m
  double capacity = std::numeric_limits<double>::quiet_NaN();        ///< load at the hook, N
  DriveLimits winch;  ///< of the rope length between sheave and hook block
};

/// Crane as a mechanism of bodies, joints, drives and hoists. SI units.
struct CraneModel {
  std::string kind;
  std::string title;
  std::vector<BodyModel> bodies;
  std::vector<JointModel> joints;
  std::vector<DriveModel> drives;
  std::vector<HoistModel> hoists;
  std::optional<double> capacity;  ///< of the whole crane, N
  Mark place;

  const BodyModel* find_body(const std::string& name) const;
  const JointModel* find_joint(const std::string& name) const;
  const DriveModel* find_drive(const std::string& name) const;
  const HoistModel* find_hoist(const std::string& name) const;
};

/// For each velocity of a joint: does it turn (true) or displace (false)?
std::vector<bool> joint_turns(dynamics::JointKind kind);

/// The format of a crane's model file, with the rules that concern its own keys.
Format<CraneModel> crane_model_format();

/// The keys of a winch; shared with ropes that have one of their own.
Format<DriveLimits> winch_format();
/// Area on which the wind acts; shared with blocks.
Format<WindAreaModel> wind_area_format();

}  // namespace blocklift::pipeline
