#include "pipeline/mechanism/build_parts.h"

#include <algorithm>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/mechanism/joint_values.h"

namespace blocklift::pipeline {

using dynamics::BodyDefinition;
using dynamics::BodyIndex;
using dynamics::Pose;

void PartsBuilder::add_bodies(dynamics::MechanismBuilder& builder,
                              const std::vector<std::string>& held) {
  // Bodies become children of ones that are there already: as many rounds as the tree is deep.
  std::vector<const JointModel*> waiting;
  for (const JointModel& joint : parts_.joints) waiting.push_back(&joint);
  while (!waiting.empty()) {
    const auto next = std::find_if(waiting.begin(), waiting.end(), [&](const JointModel* joint) {
      return joint->parent.value == "world" || body_of_.contains(joint->parent.value);
    });
    if (next == waiting.end()) {
      throw dynamics::ModelError("the joints of " +
                                 (prefix_.empty() ? "the mechanism" : "crane " + prefix_) +
                                 " form a ring");
    }
    const bool is_held = std::find(held.begin(), held.end(), (*next)->name.value) != held.end();
    add_body(builder, **next, is_held);
    waiting.erase(next);
  }
}

void PartsBuilder::add_body(dynamics::MechanismBuilder& builder, const JointModel& joint,
                            bool held) {
  const BodyModel& model = *parts_.find_body(joint.child.value);
  BodyDefinition body;
  body.name = prefix_ + model.name.value;
  body.joint.kind = joint.kind;
  body.joint.axis = joint.axis;
  if (joint.second_axis) body.joint.second_axis = *joint.second_axis;
  body.X_PJ = {rotation_of(joint.attitude), joint.position};
  if (joint.parent.value == "world") {
    body.X_PJ = X_WBase_ * body.X_PJ;
    body.parent = ground_.name;
  } else {
    body.parent = prefix_ + joint.parent.value;
  }
  body.mass = model.mass;
  body.p_BoBcm_B = model.centre_of_mass;
  body.I_BBcm_B = model.inertia_matrix();
  for (const Located<Quantity>& damping : joint.damping)
    body.damping.push_back(damping.value.value);
  const std::size_t freedoms = joint_turns(joint.kind).size();
  std::vector<DrivenFreedom> driven;
  for (const DriveModel& drive : parts_.drives) {
    if (drive.joint.value != joint.name.value) continue;
    body.driven.resize(freedoms, false);
    const int degree = drive.degree_of_freedom.value - 1;
    body.driven[degree] = true;
    driven.push_back({&drive, -1, degree});
  }
  if (held) body.driven.assign(freedoms, true);
  const BodyIndex index = builder.add_body(body);
  body_of_[model.name.value] = index;
  added_.push_back(&model);
  for (DrivenFreedom& freedom : driven) {
    freedom.body = index;
    driven_.push_back(freedom);
  }
}

void PartsBuilder::add_wind_areas(const std::shared_ptr<const dynamics::WindField>& wind,
                                  dynamics::ForceElements& elements) const {
  for (const BodyModel& model : parts_.bodies) {
    for (const WindAreaModel& area : model.wind_areas) {
      add_wind_area(prefix_ + model.name.value, body(model.name.value), area, wind, elements);
    }
  }
}

void add_wind_area(const std::string& body_name, BodyIndex body, const WindAreaModel& area,
                   const std::shared_ptr<const dynamics::WindField>& wind,
                   dynamics::ForceElements& elements) {
  auto& areas = std::get<std::vector<dynamics::WindArea>>(elements);
  dynamics::WindArea::Definition definition;
  definition.name = fmt::format("wind on {} {}", body_name, areas.size() + 1);
  definition.centre_of_pressure = {body, area.centre};
  definition.area = area.area;
  definition.coefficient = area.coefficient;
  definition.normal_B = area.normal;
  areas.emplace_back(wind, definition);
}

BodyIndex PartsBuilder::body(const std::string& name) const {
  return name == "world" ? ground_.body : body_of_.at(name);
}

BodyIndex PartsBuilder::carried_by(const std::string& joint) const {
  return body_of_.at(parts_.find_joint(joint)->child.value);
}

dynamics::BodyPoint PartsBuilder::point(const std::string& name, const Vector3& position) const {
  return {body(name), name == "world" ? X_WBase_.apply(position) : position};
}

Pose PartsBuilder::frame(const LoopSide& side) const {
  const Vector3 zero = Vector3::Zero();
  const Pose X_BodyK{rotation_of(side.attitude ? side.attitude->value : zero),
                     side.position ? side.position->value : zero};
  return side.body->value == "world" ? X_WBase_ * X_BodyK : X_BodyK;
}

dynamics::LoopDefinition PartsBuilder::definition_of(const LoopModel& loop) const {
  using dynamics::LoopKind;
  dynamics::LoopDefinition definition;
  definition.name = prefix_ + loop.name.value;
  definition.kind = loop.kind;
  if (loop.axis) definition.axis = loop.axis->value;
  if (loop.second_axis) definition.second_axis = loop.second_axis->value;
  if (loop.length) definition.length = loop.length->value;
  if (loop.ratio) definition.ratio = loop.ratio->value.value;
  if (loop.offset) definition.offset = loop.offset->value.value;
  if (loop.kind == LoopKind::rope_length) {
    for (const std::vector<PointModel>& path : loop.paths->value) {
      std::vector<dynamics::LoopPoint> points;
      for (const PointModel& at : path) {
        points.push_back({full_name(at.body.value), point(at.body.value, at.position).p_BoQ_B});
      }
      definition.paths.push_back(std::move(points));
    }
    return definition;
  }
  if (loop.kind == LoopKind::gear) {
    const auto child_of = [&](const LoopSide& side) {
      return prefix_ + parts_.find_joint(side.joint->value)->child.value;
    };
    const auto degree_of = [](const LoopSide& side) {
      return side.degree_of_freedom ? side.degree_of_freedom->value - 1 : 0;
    };
    definition.first = child_of(*loop.first);
    definition.second = child_of(*loop.second);
    definition.first_velocity = degree_of(*loop.first);
    definition.second_velocity = degree_of(*loop.second);
    return definition;
  }
  definition.first = full_name(loop.first->body->value);
  definition.second = full_name(loop.second->body->value);
  definition.X_FirstK = frame(*loop.first);
  definition.X_SecondK = frame(*loop.second);
  return definition;
}

void PartsBuilder::add_loops(dynamics::MechanismBuilder& builder,
                             const dynamics::Mechanism* known) const {
  for (std::size_t i = 0; i < parts_.loops.size(); ++i) {
    dynamics::LoopDefinition definition = definition_of(parts_.loops[i]);
    if (known) {
      definition.length = known->loops()[i].length;
      definition.offset = known->loops()[i].offset;
    }
    builder.add_loop(definition);
  }
}

void PartsBuilder::set_positions(const dynamics::Mechanism& mechanism, const JointValues& positions,
                                 dynamics::VectorRef q) const {
  for (const auto& position : positions) {
    const JointModel& joint = *parts_.find_joint(position.name.value);
    const dynamics::Body& body = mechanism.body(carried_by(joint.name.value));
    q.segment(body.q_offset, body.nq()) = joint_position(joint.kind, position.value.value).values;
  }
}

void PartsBuilder::add_springs(const dynamics::Mechanism& mechanism,
                               dynamics::ForceElements& elements) const {
  for (const SpringModel& spring : parts_.springs) {
    const double damping = spring.damping ? spring.damping->value.value : 0.0;
    if (spring.kind == SpringKind::point) {
      dynamics::PointSpring::Definition definition;
      definition.name = prefix_ + spring.name.value;
      definition.from = point(spring.from->body.value, spring.from->position);
      definition.to = point(spring.to->body.value, spring.to->position);
      definition.stiffness = spring.stiffness.value.value;
      definition.damping = damping;
      definition.free_length = spring.free_length->value;
      std::get<std::vector<dynamics::PointSpring>>(elements).emplace_back(std::move(definition));
      continue;
    }
    if (spring.kind == SpringKind::torsional) {
      dynamics::TorsionalSpring::Definition definition;
      definition.name = prefix_ + spring.name.value;
      definition.from = point(spring.from->body.value, Vector3::Zero()).body;
      definition.to = point(spring.to->body.value, Vector3::Zero()).body;
      definition.stiffness = spring.stiffness.value.value;
      definition.damping = damping;
      if (spring.free_orientation) {
        definition.R_FT_free = rotation_of(spring.free_orientation->value);
      }
      std::get<std::vector<dynamics::TorsionalSpring>>(elements).emplace_back(definition);
      continue;
    }
    dynamics::JointSpring::Definition definition;
    definition.name = prefix_ + spring.name.value;
    definition.body = carried_by(spring.joint->value);
    definition.degree_of_freedom =
        spring.degree_of_freedom ? spring.degree_of_freedom->value - 1 : 0;
    definition.stiffness = spring.stiffness.value.value;
    definition.damping = damping;
    definition.free_coordinate = spring.free_coordinate ? spring.free_coordinate->value.value : 0.0;
    std::get<std::vector<dynamics::JointSpring>>(elements).emplace_back(mechanism,
                                                                        std::move(definition));
  }
}

}  // namespace blocklift::pipeline
