#include "pipeline/mechanism/mechanism_parts_check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "pipeline/mechanism/joint_values.h"

namespace blocklift::pipeline {

bool is_angular(Dimension dimension) {
  return dimension == Dimension::angle || dimension == Dimension::angular_speed ||
         dimension == Dimension::angular_acceleration || dimension == Dimension::angular_jerk ||
         dimension == Dimension::rotational_damping || dimension == Dimension::rotational_stiffness;
}

/// Complains if the lowest coordinate is not below the highest.
void check_range_ascends(const DriveLimits& limits, const std::string& owner, const Mark& mark,
                         Reading& reading) {
  const Quantity& low = limits.range[0];
  const Quantity& high = limits.range[1];
  if (low.value >= high.value) {
    reading.error(mark,
                  fmt::format("the range of {} ends at {}, where it begins at {}", owner,
                              format_quantity(high.value, high.dimension),
                              format_quantity(low.value, low.dimension)),
                  {"a range is the lowest and then the highest coordinate"});
  }
}

namespace {

void check_drive_dimensions(const DriveModel& drive, bool turns, Reading& reading) {
  const auto check = [&](const char* key, const Quantity& found, const Mark& mark) {
    if (!std::isfinite(found.value) || is_angular(found.dimension) == turns) return;
    reading.error(mark, fmt::format("{} of drive {} is {}, but joint {} {}", key, drive.name.value,
                                    text_of(found.dimension).noun, drive.joint.value,
                                    turns ? "turns" : "slides"));
  };
  check("speed", drive.speed.value, drive.speed.mark);
  check("acceleration", drive.acceleration.value, drive.acceleration.mark);
  check("jerk", drive.jerk.value, drive.jerk.mark);
  for (const Quantity& limit : drive.range) check("range", limit, drive.name.mark);
  if (drive.constant_speed) {
    check("constant_speed", drive.constant_speed->value, drive.constant_speed->mark);
  }
  if (!drive.table) return;
  for (const auto& point : drive.table->value) check("table", point[1], drive.table->mark);
}

void check_drive(const MechanismParts& parts, const DriveModel& drive, Reading& reading) {
  if (std::isfinite(drive.range[0].value)) {
    check_range_ascends(drive, "drive " + drive.name.value, drive.name.mark, reading);
  }
  if (drive.joint.value.empty()) return;
  const JointModel* joint = parts.find_joint(drive.joint.value);
  if (!joint) {
    reading.error(drive.joint.mark,
                  fmt::format("drive {} moves joint \"{}\", which the {} does not have",
                              drive.name.value, drive.joint.value, reading.owner()),
                  {names_hint("its joints are", names_of(parts.joints), drive.joint.value)});
    return;
  }
  const std::vector<bool> turns = joint_turns(joint->kind);
  const int degree = drive.degree_of_freedom.value;
  if (joint->kind == dynamics::JointKind::spherical || joint->kind == dynamics::JointKind::free) {
    reading.error(
        drive.joint.mark,
        fmt::format("drive {} cannot move the {} joint {}: no single coordinate "
                    "describes its turning",
                    drive.name.value, dynamics::joint_kind_name(joint->kind), joint->name.value));
  } else if (degree > static_cast<int>(turns.size())) {
    reading.error(
        drive.degree_of_freedom.mark,
        fmt::format("joint {} is {} and has {} degree{} of freedom; drive {} moves the "
                    "one numbered {}",
                    joint->name.value, dynamics::joint_kind_name(joint->kind), turns.size(),
                    turns.size() == 1 ? "" : "s", drive.name.value, degree));
  } else if (degree >= 1) {
    check_drive_dimensions(drive, turns[degree - 1], reading);
  }
}

void check_drives(const MechanismParts& parts, Reading& reading) {
  std::set<std::pair<std::string, int>> moved;
  for (const DriveModel& drive : parts.drives) {
    check_drive(parts, drive, reading);
    if (!moved.emplace(drive.joint.value, drive.degree_of_freedom.value).second) {
      reading.error(drive.joint.mark, fmt::format("drive {} moves joint {}, which another drive "
                                                  "moves already",
                                                  drive.name.value, drive.joint.value));
    }
  }
}

/// Complains about joints whose ends do not exist, and bodies with no joint or several.
bool check_joint_ends(const MechanismParts& parts, Reading& reading) {
  bool sound = true;
  const auto fail = [&](const Mark& mark, std::string message, std::vector<std::string> hints) {
    reading.error(mark, std::move(message), std::move(hints));
    sound = false;
  };
  for (const JointModel& joint : parts.joints) {
    for (const Located<std::string>* end : {&joint.parent, &joint.child}) {
      const bool is_world = end == &joint.parent && end->value == "world";
      if (end->value.empty() || is_world || parts.find_body(end->value)) continue;
      fail(end->mark,
           fmt::format("joint {} joins body \"{}\", which the {} does not have", joint.name.value,
                       end->value, reading.owner()),
           {names_hint("its bodies are", names_of(parts.bodies), end->value)});
    }
  }
  for (const BodyModel& body : parts.bodies) {
    const auto count = std::count_if(
        parts.joints.begin(), parts.joints.end(),
        [&](const JointModel& joint) { return joint.child.value == body.name.value; });
    if (body.name.value == "world") {
      fail(body.name.mark, "a body cannot be named \"world\"",
           {"that is what everything stands on"});
    } else if (count != 1) {
      fail(body.name.mark,
           fmt::format("body {} is the child of {} joints", body.name.value,
                       count == 0 ? "no" : std::to_string(count)),
           {"each body is the child of exactly one joint"});
    }
  }
  return sound;
}

/// Complains about bodies that carry each other in a ring and so never reach the base.
void check_no_ring(const MechanismParts& parts, Reading& reading) {
  for (const BodyModel& body : parts.bodies) {
    std::string carried = body.name.value;
    for (std::size_t step = 0; carried != "world" && step <= parts.bodies.size(); ++step) {
      for (const JointModel& joint : parts.joints) {
        if (joint.child.value == carried) {
          carried = joint.parent.value;
          break;
        }
      }
    }
    if (carried != "world") {
      reading.error(body.name.mark,
                    fmt::format("body {} is not carried by the world: its joints form a ring",
                                body.name.value));
      return;
    }
  }
}

void check_joint_values(const MechanismParts& parts, const JointValues& values,
                        const std::string& user, const char* what,
                        JointVector (*convert)(dynamics::JointKind, const std::vector<Quantity>&),
                        Reading& reading) {
  for (const auto& value : values) {
    const JointModel* joint = look_up_joint(parts, value.name, user, reading);
    if (!joint) continue;
    const JointVector vector = convert(joint->kind, value.value.value);
    if (vector.complaint.empty()) continue;
    reading.error(value.value.mark,
                  fmt::format("the {} of joint {} {}", what, joint->name.value, vector.complaint));
  }
}

}  // namespace

void check_body(const BodyModel& body, Reading& reading, const Mark& mark) {
  const std::string hint = "give radii_of_gyration: [x, y, z], or inertia: {xx: , yy: , zz: }";
  if (body.radii_of_gyration && body.inertia) {
    reading.error(body.inertia->mark, reading.owner() + " has both radii_of_gyration and inertia",
                  {hint});
    return;
  }
  if (!body.radii_of_gyration && !body.inertia) {
    if (body.mass == 0) return;
    reading.error(mark, reading.owner() + " has neither radii_of_gyration nor inertia", {hint});
    return;
  }
  const Eigen::Matrix3d inertia = body.inertia_matrix();
  if (!inertia.allFinite()) return;
  const Vector3 moments = algebra::symmetric_eigenvalues(inertia);
  const double tolerance = 1e-9 * moments.cwiseAbs().maxCoeff();
  if (moments[0] < -tolerance || moments[2] > moments[0] + moments[1] + tolerance) {
    reading.error(
        body.inertia ? body.inertia->mark : body.radii_of_gyration->mark,
        fmt::format("{} has an inertia that no distribution of mass has: principal "
                    "moments {:.4g}, {:.4g} and {:.4g} t m^2",
                    reading.owner(), moments[0] / 1000, moments[1] / 1000, moments[2] / 1000),
        {"none may be negative or larger than the sum of the other two"});
  }
}

void check_joint(const JointModel& joint, Reading& reading, const Mark& mark) {
  using dynamics::JointKind;
  const bool takes_second = joint.kind == JointKind::universal || joint.kind == JointKind::planar;
  if (joint.second_axis && !takes_second) {
    reading.error(mark, fmt::format("{} is {} and has no second axis", reading.owner(),
                                    dynamics::joint_kind_name(joint.kind)));
  } else if (joint.second_axis && std::abs(joint.second_axis->dot(joint.axis)) > 1e-6) {
    reading.error(mark, reading.owner() + " has a second axis that is not square to the first");
  }
  if (joint.damping.empty()) return;
  const std::vector<bool> turns = joint_turns(joint.kind);
  if (joint.damping.size() != turns.size()) {
    reading.error(joint.damping.front().mark,
                  fmt::format("{} is {}: it takes {} value{} of damping and has {}",
                              reading.owner(), dynamics::joint_kind_name(joint.kind), turns.size(),
                              turns.size() == 1 ? "" : "s", joint.damping.size()));
    return;
  }
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Quantity& found = joint.damping[i].value;
    if (!std::isfinite(found.value) || is_angular(found.dimension) == turns[i]) continue;
    reading.error(
        joint.damping[i].mark,
        fmt::format("damping {} of {} is {}, but the joint {} there", i + 1, reading.owner(),
                    text_of(found.dimension).noun, turns[i] ? "turns" : "slides"));
  }
}

void check_joint_positions(const MechanismParts& parts, const JointValues& values,
                           const std::string& user, Reading& reading) {
  check_joint_values(parts, values, user, "position", joint_position, reading);
}

void check_joint_velocities(const MechanismParts& parts, const JointValues& values,
                            const std::string& user, Reading& reading) {
  check_joint_values(parts, values, user, "velocity", joint_velocity, reading);
}

void check_parts(const MechanismParts& parts, Reading& reading) {
  if (check_joint_ends(parts, reading)) check_no_ring(parts, reading);
  check_drives(parts, reading);
  check_loops_and_springs(parts, reading);
}

}  // namespace blocklift::pipeline
