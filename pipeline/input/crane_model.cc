#include "pipeline/input/crane_model.h"

#include <algorithm>

#include "pipeline/input/crane_check.h"
#include "pipeline/input/table.h"

namespace blocklift::pipeline {
namespace {

const std::vector<Dimension> travels = {Dimension::length, Dimension::angle};
const std::vector<Dimension> speeds = {Dimension::speed, Dimension::angular_speed};
const std::vector<Dimension> accelerations = {Dimension::acceleration,
                                              Dimension::angular_acceleration};
const std::vector<Dimension> jerks = {Dimension::jerk, Dimension::angular_jerk};

Format<BoxShape> shape_format() {
  Table<BoxShape> table("shape",
                        "A box that stands for the body in drawings; it has no other effect.");
  table.required("box", &BoxShape::size, size_format(), "size along x, y and z")
      .by_default("centre", &BoxShape::centre, position_format(), "[0 m, 0 m, 0 m]",
                  "centre in the body's frame")
      .by_default("orientation", &BoxShape::attitude, attitude_format(), "[0 deg, 0 deg, 0 deg]",
                  "roll, pitch and yaw in the body's frame");
  return table.format();
}

Format<InertiaModel> inertia_format() {
  const auto moment = quantity(Dimension::moment_of_inertia, Range::not_negative());
  const auto entry = quantity(Dimension::moment_of_inertia);
  Table<InertiaModel> table("inertia",
                            "Entries of the inertia matrix about the centre of mass, along the "
                            "body's axes; off the diagonal the entries themselves (-sum m x y).");
  table.required("xx", &InertiaModel::xx, moment, "about x")
      .required("yy", &InertiaModel::yy, moment, "about y")
      .required("zz", &InertiaModel::zz, moment, "about z")
      .by_default("xy", &InertiaModel::xy, entry, "0 t m^2", "entry off the diagonal")
      .by_default("xz", &InertiaModel::xz, entry, "0 t m^2", "entry off the diagonal")
      .by_default("yz", &InertiaModel::yz, entry, "0 t m^2", "entry off the diagonal");
  return table.format();
}

Format<BodyModel> body_format() {
  const auto radii = converted<std::array<double, 3>, Vector3>(
      array_of<double, 3>(quantity(Dimension::length, Range::not_negative())),
      [](std::array<double, 3> r) { return Vector3(r[0], r[1], r[2]); });
  Table<BodyModel> table("body",
                         "A rigid body. Its frame is where its joint puts it; give either "
                         "radii_of_gyration or inertia.");
  table.required("mass", &BodyModel::mass, quantity(Dimension::mass, Range::positive()), "its mass")
      .by_default("centre_of_mass", &BodyModel::centre_of_mass, position_format(),
                  "[0 m, 0 m, 0 m]", "in the body's frame")
      .optional("radii_of_gyration", &BodyModel::radii_of_gyration, radii,
                "about the body's axes through its centre of mass")
      .optional("inertia", &BodyModel::inertia, inertia_format(),
                "in place of radii_of_gyration, when the axes are not principal ones")
      .optional("shapes", &BodyModel::shapes, list_of(shape_format()), "boxes for the drawing")
      .optional("wind_areas", &BodyModel::wind_areas, list_of(wind_area_format()),
                "areas on which the wind acts")
      .rule(check_body);
  return table.format();
}

Format<JointModel> joint_format() {
  std::vector<std::pair<std::string, dynamics::JointKind>> kinds;
  for (const std::string_view name : dynamics::joint_kind_names()) {
    kinds.emplace_back(name, *dynamics::joint_kind(name));
  }
  const auto damping = located(
      quantity_of({Dimension::damping, Dimension::rotational_damping}, Range::not_negative()));
  const auto one = converted<Located<Quantity>, std::vector<Located<Quantity>>>(
      damping, [](Located<Quantity> value) { return std::vector{std::move(value)}; });
  Table<JointModel> table("joint",
                          "How a body may move against its parent. At zero coordinates the "
                          "child's frame coincides with the joint frame.");
  table
      .required("kind", &JointModel::kind, choice<dynamics::JointKind>(kinds),
                "which motions it allows")
      .by_default("parent", &JointModel::parent, located(reference()), "world",
                  "body that carries the joint; \"world\" is the crane's own base")
      .required("child", &JointModel::child, located(reference()), "body that the joint carries")
      .by_default("axis", &JointModel::axis, direction_format(), "[0, 0, 1]",
                  "of turning or sliding, in the joint frame; of a planar joint the normal")
      .optional("second_axis", &JointModel::second_axis, direction_format(),
                "of a universal joint: fixed in the child and square to the first; of a planar "
                "joint: direction of the first displacement")
      .by_default("position", &JointModel::position, position_format(), "[0 m, 0 m, 0 m]",
                  "of the joint frame in the parent's frame")
      .by_default("orientation", &JointModel::attitude, attitude_format(), "[0 deg, 0 deg, 0 deg]",
                  "of the joint frame in the parent's frame: roll, pitch, yaw")
      .optional("damping", &JointModel::damping,
                by_shape<std::vector<Located<Quantity>>>(one, list_of(damping), std::nullopt),
                "viscous, one value for each degree of freedom")
      .rule(check_joint);
  return table.format();
}

Format<DriveModel> drive_format() {
  Table<DriveModel> table("drive",
                          "Moves a joint along a motion profile with limited speed, "
                          "acceleration and jerk.");
  table.required("joint", &DriveModel::joint, located(reference()), "the joint that it moves")
      .by_default("degree_of_freedom", &DriveModel::degree_of_freedom,
                  integer(Range::between(1, 6)), "1",
                  "which of the joint's degrees of freedom, counted from 1")
      .required("speed", &DriveModel::speed, quantity_of(speeds, Range::positive()),
                "largest speed")
      .required("acceleration", &DriveModel::acceleration,
                quantity_of(accelerations, Range::positive()), "largest acceleration")
      .required("jerk", &DriveModel::jerk, quantity_of(jerks, Range::positive()),
                "largest rate of change of the acceleration")
      .required("range", &DriveModel::range, array_of<Quantity, 2>(quantity_of(travels)),
                "lowest and highest coordinate of the joint");
  return table.format();
}

Format<HookBlockModel> hook_block_format() {
  Table<HookBlockModel> table("hook block",
                              "Hangs free from the tackle; slings start at its centre.");
  table
      .required("mass", &HookBlockModel::mass, quantity(Dimension::mass, Range::positive()),
                "with hook and lower sheaves")
      .by_default("wind_area", &HookBlockModel::wind_area,
                  quantity(Dimension::area, Range::not_negative()), "0 m^2",
                  "the same from any side")
      .by_default("wind_coefficient", &HookBlockModel::wind_coefficient,
                  number(Range::not_negative()), "1.2", "of wind pressure")
      .by_default("size", &HookBlockModel::size, size_format(), "[1 m, 1 m, 2 m]",
                  "of the box in the drawing");
  return table.format();
}

Format<HoistModel> hoist_format() {
  Table<HoistModel> table("hoist",
                          "A winch with its tackle and hook block. The tackle's falls are "
                          "taken together as one rope.");
  table.required("body", &HoistModel::body, located(reference()), "that carries the upper sheaves")
      .required("sheave", &HoistModel::sheave, position_format(),
                "where the tackle leaves the body, in its frame")
      .required("hook_block", &HoistModel::hook_block, hook_block_format(), "at its lower end")
      .required("rope", &HoistModel::rope_choice, rope_choice_format(), "all falls together")
      .optional("crane_stiffness", &HoistModel::crane_stiffness,
                quantity(Dimension::stiffness, Range::positive()),
                "of what the tackle hangs from, in series with it; rigid if left out")
      .required("capacity", &HoistModel::capacity, quantity(Dimension::load, Range::positive()),
                "largest load at the hook")
      .required("winch", &HoistModel::winch, winch_format(),
                "lets out and takes in the tackle: rope length between sheave and hook block");
  return table.format();
}

template <class T>
const T* find_by_name(const std::vector<T>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&](const T& item) { return item.name.value == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

Eigen::Matrix3d BodyModel::inertia_matrix() const {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  if (inertia) {
    const InertiaModel& i = inertia->value;
    matrix << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz;
  } else if (radii_of_gyration) {
    matrix.diagonal() = mass * radii_of_gyration->value.cwiseAbs2();
  }
  return matrix;
}

const BodyModel* CraneModel::find_body(const std::string& name) const {
  return find_by_name(bodies, name);
}
const JointModel* CraneModel::find_joint(const std::string& name) const {
  return find_by_name(joints, name);
}
const DriveModel* CraneModel::find_drive(const std::string& name) const {
  return find_by_name(drives, name);
}
const HoistModel* CraneModel::find_hoist(const std::string& name) const {
  return find_by_name(hoists, name);
}

std::vector<bool> joint_turns(dynamics::JointKind kind) {
  using dynamics::JointKind;
  switch (kind) {
    case JointKind::fixed:
      return {};
    case JointKind::revolute:
      return {true};
    case JointKind::prismatic:
      return {false};
    case JointKind::cylindrical:
      return {true, false};
    case JointKind::universal:
      return {true, true};
    case JointKind::spherical:
      return {true, true, true};
    case JointKind::planar:
      return {false, false, true};
    case JointKind::translational:
      return {false, false, false};
    case JointKind::free:
      return {true, true, true, false, false, false};
  }
  return {};
}

Format<DriveLimits> winch_format() {
  Table<DriveLimits> table("winch",
                           "Lets out and takes in rope along a motion profile with limited "
                           "speed, acceleration and jerk.");
  const Range positive = Range::positive();
  table
      .required("speed", &DriveLimits::speed, quantity_of({Dimension::speed}, positive),
                "largest speed, of the hook")
      .required("acceleration", &DriveLimits::acceleration,
                quantity_of({Dimension::acceleration}, positive), "largest acceleration")
      .required("jerk", &DriveLimits::jerk, quantity_of({Dimension::jerk}, positive),
                "largest rate of change of the acceleration")
      .required("range", &DriveLimits::range,
                array_of<Quantity, 2>(quantity_of({Dimension::length}, positive)),
                "shortest and longest rope");
  return table.format();
}

Format<WindAreaModel> wind_area_format() {
  Table<WindAreaModel> table("wind area", "An area on which the wind acts.");
  table
      .required("area", &WindAreaModel::area, quantity(Dimension::area, Range::not_negative()),
                "its size")
      .by_default("coefficient", &WindAreaModel::coefficient, number(Range::not_negative()), "1.2",
                  "of wind pressure")
      .optional(
          "normal", &WindAreaModel::normal, direction_format(),
          "of a flat area, in the body's frame; without it the area is the same from any side")
      .by_default("centre", &WindAreaModel::centre, position_format(), "[0 m, 0 m, 0 m]",
                  "where the force acts, in the body's frame");
  return table.format();
}

Format<CraneModel> crane_model_format() {
  Table<CraneModel> table("crane",
                          "A crane: bodies joined by joints, drives that move joints, and "
                          "hoists with their tackle. Its base (\"world\" to the crane) "
                          "stands where the lift case puts it.");
  table
      .required("kind", &CraneModel::kind, choice<std::string>({{"crane", "crane"}}),
                "what this file describes")
      .optional("title", &CraneModel::title, text(), "for people")
      .required("bodies", &CraneModel::bodies, named_tables(body_format()), "its rigid bodies")
      .required("joints", &CraneModel::joints, named_tables(joint_format()),
                "one for each body, which it carries")
      .optional("drives", &CraneModel::drives, named_tables(drive_format()),
                "of joints; a joint without a drive moves freely")
      .optional("hoists", &CraneModel::hoists, named_tables(hoist_format()),
                "winches with tackle and hook block")
      .optional("capacity", &CraneModel::capacity, quantity(Dimension::load, Range::positive()),
                "largest load of all hooks together")
      .place(&CraneModel::place)
      .rule(check_crane);
  return table.format();
}

}  // namespace blocklift::pipeline
