#include "pipeline/mechanism/mechanism_parts.h"

#include "pipeline/mechanism/mechanism_parts_check.h"

namespace blocklift::pipeline {

const std::vector<Dimension> travels = {Dimension::length, Dimension::angle};
const std::vector<Dimension> speeds = {Dimension::speed, Dimension::angular_speed};
const std::vector<Dimension> accelerations = {Dimension::acceleration,
                                              Dimension::angular_acceleration};
const std::vector<Dimension> jerks = {Dimension::jerk, Dimension::angular_jerk};
const std::vector<Dimension> joint_positions = {Dimension::length, Dimension::angle,
                                                Dimension::ratio};

namespace {

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

const BodyModel* MechanismParts::find_body(const std::string& name) const {
  return find_by_name(bodies, name);
}
const JointModel* MechanismParts::find_joint(const std::string& name) const {
  return find_by_name(joints, name);
}
const DriveModel* MechanismParts::find_drive(const std::string& name) const {
  return find_by_name(drives, name);
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

Format<BodyModel> body_format() {
  const auto radii = converted<std::array<double, 3>, Vector3>(
      array_of<double, 3>(quantity(Dimension::length, Range::not_negative())),
      [](std::array<double, 3> r) { return Vector3(r[0], r[1], r[2]); });
  Table<BodyModel> table("body",
                         "A rigid body. Its frame is where its joint puts it; give either "
                         "radii_of_gyration or inertia.");
  table
      .required("mass", &BodyModel::mass, quantity(Dimension::mass, Range::not_negative()),
                "its mass; zero is allowed where a child carries mass")
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

Format<JointValues> joint_values_format(const std::vector<Dimension>& dimensions) {
  const auto value = quantity_of(dimensions);
  const auto one = converted<Quantity, std::vector<Quantity>>(
      value, [](Quantity alone) { return std::vector<Quantity>{alone}; });
  return names_to(located(by_shape<std::vector<Quantity>>(one, list_of(value, 1), std::nullopt)));
}

Table<DriveModel> drive_table(bool limits_required) {
  Table<DriveModel> table("drive",
                          "Moves a joint along a motion profile with limited speed, "
                          "acceleration and jerk.");
  table.required("joint", &DriveModel::joint, located(reference()), "the joint that it moves")
      .by_default("degree_of_freedom", &DriveModel::degree_of_freedom,
                  integer(Range::between(1, 6)), "1",
                  "which of the joint's degrees of freedom, counted from 1");
  const auto add = [&](const char* key, auto member, auto format, const char* meaning) {
    if (limits_required) {
      table.required(key, member, format, meaning);
    } else {
      table.optional(key, member, format, meaning);
    }
  };
  const auto limit = [](const std::vector<Dimension>& dimensions) {
    return quantity_of(dimensions, Range::positive());
  };
  add("speed", &DriveModel::speed, limit(speeds), "largest speed");
  add("acceleration", &DriveModel::acceleration, limit(accelerations), "largest acceleration");
  add("jerk", &DriveModel::jerk, limit(jerks), "largest rate of change of the acceleration");
  add("range", &DriveModel::range, array_of<Quantity, 2>(quantity_of(travels)),
      "lowest and highest coordinate of the joint");
  return table;
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

}  // namespace blocklift::pipeline
