#include "pipeline/files/mechanism/urdf_import.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "pipeline/declaration/document.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// Keeps what the URDF library says in place of printing it, while it lives.
class KeptMessages : public console_bridge::OutputHandler {
 public:
  KeptMessages() { console_bridge::useOutputHandler(this); }
  ~KeptMessages() override { console_bridge::restorePreviousOutputHandler(); }
  KeptMessages(const KeptMessages&) = delete;
  KeptMessages& operator=(const KeptMessages&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
           int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) messages.push_back(text);
  }
  std::vector<std::string> messages;
};

Vector3 vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

/// By the quaternion: the library's own angles are rounded where the pitch is near a right angle.
Eigen::Matrix3d matrix_of(const urdf::Rotation& rotation) {
  return Eigen::Quaterniond(rotation.w, rotation.x, rotation.y, rotation.z)
      .normalized()
      .toRotationMatrix();
}

/// Gathers the parts of one robot.
class Importer {
 public:
  explicit Importer(const urdf::ModelInterface& robot) : robot_(robot) {}

  RobotImport run() {
    result_.name = robot_.getName();
    const std::string root = robot_.getRoot()->name;
    if (root != "world") result_.root = root;
    for (const auto& [name, link] : robot_.links_) add_link(*link);
    for (const auto& [name, joint] : robot_.joints_) add_joint(*joint);
    note("have limits, which are not enforced", limited_, "joints");
    note("have friction, which is not considered", rubbing_, "joints");
    note("have safety controllers, which are not considered", guarded_, "joints");
    note("have no inertia and count as massless", massless_, "links");
    note("have shapes, which play no part in the motion: there is no contact", shaped_, "links");
    return std::move(result_);
  }

 private:
  static Located<std::string> named(const std::string& name) { return {name, {}}; }

  void note(const char* what, const std::vector<std::string>& names, const char* of) {
    if (!names.empty())
      result_.notes.push_back(fmt::format("{} {} {}", of, list_of_names(names), what));
  }

  void add_link(const urdf::Link& link) {
    if (!link.visual_array.empty() || !link.collision_array.empty()) shaped_.push_back(link.name);
    if (link.name == "world") return;
    BodyModel body;
    body.name = named(link.name);
    body.mass = 0;
    if (link.inertial) {
      const urdf::Inertial& given = *link.inertial;
      body.mass = given.mass;
      body.centre_of_mass = vector_of(given.origin.position);
      // The inertia is given along the axes of its own frame.
      const Eigen::Matrix3d R = matrix_of(given.origin.rotation);
      Eigen::Matrix3d I;
      I << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz,
          given.izz;
      I = R * I * R.transpose();
      body.inertia =
          Located<InertiaModel>{{I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)}, {}};
    } else {
      massless_.push_back(link.name);
    }
    result_.parts.bodies.push_back(std::move(body));
  }

  static dynamics::JointKind kind_of(int type) {
    switch (type) {
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        return dynamics::JointKind::revolute;
      case urdf::Joint::PRISMATIC:
        return dynamics::JointKind::prismatic;
      case urdf::Joint::FLOATING:
        return dynamics::JointKind::free;
      case urdf::Joint::PLANAR:
        return dynamics::JointKind::planar;
      default:
        return dynamics::JointKind::fixed;
    }
  }

  void add_joint(const urdf::Joint& given) {
    JointModel joint;
    joint.name = named(given.name);
    joint.kind = kind_of(given.type);
    joint.parent = named(given.parent_link_name);
    joint.child = named(given.child_link_name);
    const Vector3 axis = vector_of(given.axis);
    if (axis.norm() > 0) joint.axis = axis.normalized();
    const urdf::Pose& origin = given.parent_to_joint_origin_transform;
    joint.position = vector_of(origin.position);
    joint.attitude = roll_pitch_yaw_of(matrix_of(origin.rotation));
    const std::vector<bool> turns = joint_turns(joint.kind);
    if (given.dynamics && given.dynamics->damping != 0) {
      for (const bool turn : turns) {
        joint.damping.push_back(
            {{given.dynamics->damping, turn ? Dimension::rotational_damping : Dimension::damping},
             {}});
      }
    }
    if (given.dynamics && given.dynamics->friction != 0) rubbing_.push_back(given.name);
    if (given.limits && joint.kind != dynamics::JointKind::fixed) limited_.push_back(given.name);
    if (given.safety) guarded_.push_back(given.name);
    if (given.mimic) add_gear(given);
    result_.parts.joints.push_back(std::move(joint));
  }

  /// A joint that mimics another: its position is multiplier times the other's, plus offset.
  void add_gear(const urdf::Joint& given) {
    const auto other = robot_.getJoint(given.mimic->joint_name);
    const bool turns = given.type != urdf::Joint::PRISMATIC;
    const bool other_turns = !other || other->type != urdf::Joint::PRISMATIC;
    LoopModel gear;
    gear.name = named(given.name + "_mimics_" + given.mimic->joint_name);
    gear.kind = dynamics::LoopKind::gear;
    const auto side = [&](const std::string& joint) {
      LoopSide at;
      at.joint = named(joint);
      return at;
    };
    gear.first = side(given.name);
    gear.second = side(given.mimic->joint_name);
    const Dimension ratio = turns == other_turns ? Dimension::ratio
                            : turns              ? Dimension::angle_per_length
                                                 : Dimension::length_per_angle;
    gear.ratio = Located<Quantity>{{given.mimic->multiplier, ratio}, {}};
    gear.offset =
        Located<Quantity>{{given.mimic->offset, turns ? Dimension::angle : Dimension::length}, {}};
    result_.parts.loops.push_back(std::move(gear));
  }

  const urdf::ModelInterface& robot_;
  RobotImport result_;
  std::vector<std::string> limited_, rubbing_, guarded_, massless_, shaped_;
};

/// Elements beside links and joints, which the URDF library passes over.
void note_extensions(const std::string& text, std::vector<std::string>& notes) {
  for (const char* element : {"transmission", "gazebo", "sensor", "ros2_control"}) {
    if (text.find(std::string("<") + element) != std::string::npos) {
      notes.push_back(fmt::format("elements <{}> play no part", element));
    }
  }
}

}  // namespace

std::optional<RobotImport> import_urdf(const fs::path& path, const Mark& mark,
                                       Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& message, std::vector<std::string> hints = {}) {
    diagnostics.error(mark, fmt::format("robot description {}: {}", shown_path(path), message),
                      std::move(hints));
    return std::nullopt;
  };
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return refuse("there is no such file");
  if (fs::file_size(path, error) > largest_input_file) return refuse("the file is too large");
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) return refuse("the file cannot be read");
  if (text.find("<xacro:") != std::string::npos) {
    return refuse("it has macros of xacro",
                  {"expand it first: xacro robot.urdf.xacro > robot.urdf"});
  }
  KeptMessages messages;
  urdf::ModelInterfaceSharedPtr robot;
  try {
    robot = urdf::parseURDF(text);
  } catch (const std::exception& exception) {
    return refuse(exception.what());
  }
  if (!robot || !robot->getRoot())
    return refuse("it is no URDF that can be used", messages.messages);
  if (robot->links_.contains("") || robot->joints_.contains("")) {
    return refuse("a link or joint has no name");
  }
  RobotImport result = Importer(*robot).run();
  for (const std::string& message : messages.messages) result.notes.push_back(message);
  note_extensions(text, result.notes);
  return result;
}

}  // namespace blocklift::pipeline
