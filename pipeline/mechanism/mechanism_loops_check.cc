#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pipeline/mechanism/mechanism_parts_check.h"

/// Rules for loops and springs.
namespace blocklift::pipeline {
namespace {

using dynamics::LoopKind;

bool is_joint(LoopKind kind) { return kind <= LoopKind::translational; }

void check_side(const MechanismParts& parts, const LoopModel& loop, const LoopSide& side,
                Reading& reading) {
  const std::string user = "loop " + loop.name.value;
  if (loop.kind == LoopKind::gear && side.joint) {
    check_freedom(parts,
                  {*side.joint, side.degree_of_freedom.value_or(Located<int>{1, side.place})}, user,
                  reading);
  } else if (loop.kind != LoopKind::gear && side.body) {
    check_point(parts, {*side.body, Vector3::Zero(), side.place}, user, reading);
  }
}

/// The dimension that a gear's ratio has: of the first joint's coordinate over the second's.
void check_gear(const MechanismParts& parts, const LoopModel& loop, Reading& reading) {
  if (!loop.first || !loop.second || !loop.first->joint || !loop.second->joint) return;
  const auto turns = [&](const LoopSide& side) -> std::optional<bool> {
    const JointModel* joint = parts.find_joint(side.joint->value);
    if (!joint) return std::nullopt;
    const std::vector<bool> all = joint_turns(joint->kind);
    const int degree = side.degree_of_freedom ? side.degree_of_freedom->value : 1;
    if (degree < 1 || degree > static_cast<int>(all.size())) return std::nullopt;
    return all[degree - 1];
  };
  const auto first = turns(*loop.first);
  const auto second = turns(*loop.second);
  if (!first || !second) return;
  const Dimension due = *first == *second ? Dimension::ratio
                        : *first          ? Dimension::angle_per_length
                                          : Dimension::length_per_angle;
  if (loop.ratio && std::isfinite(loop.ratio->value.value) && loop.ratio->value.dimension != due) {
    reading.error(loop.ratio->mark,
                  fmt::format("the ratio of gear {} is {}; {} is due, for example \"{}\"",
                              loop.name.value, text_of(loop.ratio->value.dimension).noun,
                              text_of(due).noun, text_of(due).example),
                  {fmt::format("the first joint {}, the second one {}", *first ? "turns" : "slides",
                               *second ? "turns" : "slides")});
  }
  if (loop.offset && std::isfinite(loop.offset->value.value) &&
      is_angular(loop.offset->value.dimension) != *first) {
    reading.error(
        loop.offset->mark,
        fmt::format("the offset of gear {} is {}, but its first joint {}", loop.name.value,
                    text_of(loop.offset->value.dimension).noun, *first ? "turns" : "slides"));
  }
}

const char* place_of(SpringKind kind) {
  switch (kind) {
    case SpringKind::point:
      return "acts between points";
    case SpringKind::joint:
      return "acts at a joint";
    case SpringKind::torsional:
      return "acts against the turning of two bodies";
  }
  return "";
}

void check_one_spring(const MechanismParts& parts, const SpringModel& spring, Reading& reading) {
  const std::string user = "spring " + spring.name.value;
  for (const auto* end : {&spring.from, &spring.to}) {
    if (*end) check_point(parts, **end, user, reading);
  }
  if (spring.from && spring.to && !spring.from->body.value.empty() &&
      spring.from->body.value == spring.to->body.value) {
    reading.error(spring.to->body.mark,
                  fmt::format("{} has both ends on body {}, so it can do nothing", user,
                              spring.to->body.value));
  }
  bool turns = spring.kind == SpringKind::torsional;
  if (spring.kind == SpringKind::joint) {
    if (!spring.joint) return;
    const auto found = check_freedom(
        parts,
        {*spring.joint, spring.degree_of_freedom.value_or(Located<int>{1, spring.joint->mark})},
        user, reading);
    if (!found) return;
    turns = *found;
  }
  const auto check = [&](const char* key, const Located<Quantity>& value, bool angular) {
    if (!std::isfinite(value.value.value) || is_angular(value.value.dimension) == angular) return;
    reading.error(
        value.mark,
        fmt::format("{} of {} is {}, but it {}", key, user, text_of(value.value.dimension).noun,
                    spring.kind == SpringKind::point       ? "is a point spring"
                    : spring.kind == SpringKind::torsional ? "is a torsional spring"
                    : angular                              ? "acts where its joint turns"
                                                           : "acts where its joint slides"));
  };
  check("stiffness", spring.stiffness, turns);
  if (spring.damping) check("damping", *spring.damping, turns);
  if (spring.free_coordinate) check("free_coordinate", *spring.free_coordinate, turns);
}

}  // namespace

bool check_point(const MechanismParts& parts, const PointModel& point, const std::string& user,
                 Reading& reading) {
  const std::string& body = point.body.value;
  if (body.empty()) return false;
  if (body == "world" || parts.find_body(body)) return true;
  std::vector<std::string> known = names_of(parts.bodies);
  known.emplace_back("world");
  reading.error(
      point.body.mark,
      fmt::format("{} names body \"{}\", which the {} does not have", user, body, reading.owner()),
      {names_hint("its bodies are", known, body)});
  return false;
}

const JointModel* look_up_joint(const MechanismParts& parts, const Located<std::string>& name,
                                const std::string& user, Reading& reading) {
  const JointModel* joint = parts.find_joint(name.value);
  if (!joint && !name.value.empty()) {
    reading.error(name.mark,
                  fmt::format("{} names joint \"{}\", which the {} does not have", user, name.value,
                              reading.owner()),
                  {names_hint("its joints are", names_of(parts.joints), name.value)});
  }
  return joint;
}

std::optional<bool> check_freedom(const MechanismParts& parts, const JointAxis& freedom,
                                  const std::string& user, Reading& reading) {
  const std::string& name = freedom.joint.value;
  if (name.empty()) return std::nullopt;
  const JointModel* joint = look_up_joint(parts, freedom.joint, user, reading);
  if (!joint) return std::nullopt;
  const std::vector<bool> turns = joint_turns(joint->kind);
  const int degree = freedom.degree_of_freedom.value;
  if (!dynamics::velocities_are_rates(joint->kind)) {
    reading.error(
        freedom.joint.mark,
        fmt::format("{} cannot act at the {} joint {}: no single coordinate describes its "
                    "turning",
                    user, dynamics::joint_kind_name(joint->kind), name));
    return std::nullopt;
  }
  if (degree > static_cast<int>(turns.size())) {
    reading.error(freedom.degree_of_freedom.mark,
                  fmt::format("joint {} is {} and has {} degree{} of freedom; {} names the one "
                              "numbered {}",
                              name, dynamics::joint_kind_name(joint->kind), turns.size(),
                              turns.size() == 1 ? "" : "s", user, degree));
    return std::nullopt;
  }
  if (degree < 1) return std::nullopt;
  return turns[degree - 1];
}

void check_loop_side(const LoopSide& side, Reading& reading, const Mark& mark) {
  if (side.joint && (side.body || side.position || side.attitude)) {
    reading.error(mark,
                  "a side of a loop is a frame in a body or a joint that is geared, not both");
  } else if (!side.joint && !side.body) {
    reading.error(mark, "a side of a loop names a body, or of a gear a joint",
                  {"for example {body: rod, position: [1 m, 0 m, 0 m]}"});
  } else if (side.degree_of_freedom && !side.joint) {
    reading.error(side.degree_of_freedom->mark, "degree_of_freedom goes with a joint");
  }
}

void check_loop(const LoopModel& loop, Reading& reading, const Mark& mark) {
  const std::string kind(dynamics::loop_kind_name(loop.kind));
  const auto refuse = [&](const auto& member, const char* key, bool allowed) {
    if (!member || allowed) return;
    reading.error(member->mark,
                  fmt::format("{} is {}, which has no {}", reading.owner(), kind, key));
  };
  const auto demand = [&](bool given, const char* key, const char* example) {
    if (given) return;
    reading.error(mark,
                  fmt::format("{} is {} and lacks the key \"{}\"", reading.owner(), kind, key),
                  {example});
  };
  const bool has_axis =
      (is_joint(loop.kind) && loop.kind != LoopKind::fixed && loop.kind != LoopKind::spherical &&
       loop.kind != LoopKind::translational) ||
      loop.kind == LoopKind::point_on_line;
  refuse(loop.axis, "axis", has_axis);
  refuse(loop.second_axis, "second_axis", loop.kind == LoopKind::universal);
  refuse(loop.length, "length",
         loop.kind == LoopKind::distance || loop.kind == LoopKind::rope_length);
  refuse(loop.ratio, "ratio", loop.kind == LoopKind::gear);
  refuse(loop.offset, "offset", loop.kind == LoopKind::gear);
  refuse(loop.paths, "paths", loop.kind == LoopKind::rope_length);
  if (loop.kind == LoopKind::gear) demand(loop.ratio.has_value(), "ratio", "for example ratio: -2");
  if (loop.kind == LoopKind::rope_length) {
    demand(loop.paths.has_value(), "paths", "for example paths: [[{body: a}, {body: world}]]");
    for (const auto* side : {&loop.first, &loop.second}) {
      if (*side)
        reading.error((*side)->place,
                      reading.owner() + " is led over paths, not from side to side");
    }
    return;
  }
  const char* example = loop.kind == LoopKind::gear
                            ? "for example {joint: crank}"
                            : "for example {body: world, position: [1 m, 0 m, 0 m]}";
  demand(loop.first.has_value(), "first", example);
  demand(loop.second.has_value(), "second", example);
  for (const auto* side : {&loop.first, &loop.second}) {
    if (!*side) continue;
    if ((*side)->joint.has_value() == (loop.kind == LoopKind::gear)) continue;
    reading.error((*side)->place,
                  fmt::format("{} is {}: its sides are {}", reading.owner(), kind,
                              loop.kind == LoopKind::gear ? "joints" : "frames in bodies"),
                  {example});
  }
}

void check_spring(const SpringModel& spring, Reading& reading, const Mark& mark) {
  const bool at_joint = spring.kind == SpringKind::joint;
  const bool torsional = spring.kind == SpringKind::torsional;
  const char* place = place_of(spring.kind);
  const auto check = [&](bool given, const char* key, bool due, bool required) {
    if (given && !due) {
      reading.error(mark, fmt::format("{} {}, so it has no {}", reading.owner(), place, key));
    } else if (!given && due && required) {
      reading.error(mark,
                    fmt::format("{} {} and lacks the key \"{}\"", reading.owner(), place, key));
    }
  };
  check(spring.from.has_value(), "from", !at_joint, true);
  check(spring.to.has_value(), "to", !at_joint, true);
  check(spring.free_length.has_value(), "free_length", spring.kind == SpringKind::point, true);
  check(spring.joint.has_value(), "joint", at_joint, true);
  check(spring.degree_of_freedom.has_value(), "degree_of_freedom", at_joint, false);
  check(spring.free_coordinate.has_value(), "free_coordinate", at_joint, false);
  check(spring.free_orientation.has_value(), "free_orientation", torsional, false);
  if (!torsional) return;
  for (const auto* end : {&spring.from, &spring.to}) {
    if (!*end || (*end)->position.isZero(0.0)) continue;
    reading.error((*end)->place, fmt::format("{} {}, so that a position on them means nothing",
                                             reading.owner(), place));
  }
}

void check_loops_and_springs(const MechanismParts& parts, Reading& reading) {
  for (const LoopModel& loop : parts.loops) {
    for (const auto* side : {&loop.first, &loop.second}) {
      if (*side) check_side(parts, loop, **side, reading);
    }
    if (loop.kind == LoopKind::gear) check_gear(parts, loop, reading);
    if (!loop.paths) continue;
    for (const auto& path : loop.paths->value) {
      for (const PointModel& point : path) {
        check_point(parts, point, "loop " + loop.name.value, reading);
      }
    }
  }
  for (const SpringModel& spring : parts.springs) check_one_spring(parts, spring, reading);
}

}  // namespace blocklift::pipeline
