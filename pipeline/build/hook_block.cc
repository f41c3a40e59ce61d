#include "pipeline/build/hook_block.h"

#include <cmath>
#include <utility>

namespace blocklift::pipeline {

namespace {

/// What turns about the vertical on a parent. It never leans, so that its moments of inertia about
/// level axes do not matter.
dynamics::BodyDefinition upright_body(std::string name, std::string parent, double mass,
                                      double radius_of_gyration) {
  dynamics::BodyDefinition body;
  body.name = std::move(name);
  body.parent = std::move(parent);
  body.joint.kind = dynamics::JointKind::revolute;
  body.joint.axis = Vector3::UnitZ();
  body.mass = mass;
  body.I_BBcm_B = mass * radius_of_gyration * radius_of_gyration * Eigen::Matrix3d::Identity();
  return body;
}

}  // namespace

std::vector<dynamics::BodyDefinition> hook_bodies(const std::string& name,
                                                  const HookBlockModel& block) {
  dynamics::BodyDefinition place;
  place.name = block.turning ? name + ".place" : name;
  place.joint.kind = dynamics::JointKind::translational;
  place.mass = block.turning ? 0 : block.mass;
  if (!block.turning) return {place};
  const double radius = block.turning->radius_of_gyration;
  if (!block.turning->bearing) return {place, upright_body(name, place.name, block.mass, radius)};
  const HookBearingModel& bearing = *block.turning->bearing;
  const std::string turns = name + ".block";
  return {place, upright_body(turns, place.name, block.mass - bearing.hook_mass, radius),
          upright_body(name, turns, bearing.hook_mass, bearing.radius_of_gyration)};
}

double hang_twin_falls(const TurningBlockModel& turning, const Eigen::Matrix3d& R_WT,
                       dynamics::RopeDefinition& tackle) {
  constexpr double least_level = 0.1;  // of a unit vector
  Vector3 ahead = R_WT.col(0);
  if (ahead.head<2>().norm() < least_level) ahead = R_WT.col(1);
  const double yaw = std::atan2(ahead.y(), ahead.x()) + turning.towards;
  const Vector3 aside = turning.falls_apart / 2 * Vector3(-ahead.y(), ahead.x(), 0).normalized();
  const Vector3 aside_above = R_WT.transpose() * aside;
  const Vector3 aside_below = Eigen::AngleAxisd(-yaw, Vector3::UnitZ()) * aside;
  const dynamics::BodyPoint sheave = tackle.points.front(), block = tackle.points.back();
  tackle.points = {{sheave.body, sheave.p_BoQ_B + aside_above},
                   {block.body, block.p_BoQ_B + aside_below},
                   {sheave.body, sheave.p_BoQ_B - aside_above},
                   {block.body, block.p_BoQ_B - aside_below}};
  tackle.left_out = {0, 1, 0};
  tackle.twin_falls = true;
  return yaw;
}

dynamics::JointFriction bearing_friction(const dynamics::Mechanism& mechanism,
                                         dynamics::BodyIndex hook,
                                         const HookBearingModel& bearing) {
  constexpr double creep = 1e-4;  // rad/s, a third of a degree in a minute
  return {mechanism,
          {.name = mechanism.body(hook).name + ".bearing",
           .body = hook,
           .friction = bearing.friction_moment,
           .creep = creep}};
}

}  // namespace blocklift::pipeline
