#include "pipeline/rigging/leg_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

constexpr double degrees_of_legs = std::numbers::pi / 180;

/// Whether a rope is a sling from a hook.
bool hangs_from(const LiftCase& lift_case, const given::Rope& rope, const std::string& hook) {
  return rope.is_sling() && rope.path.front().kind == ResolvedPoint::Kind::hook &&
         rope.path.front().body_name(lift_case.cranes) == hook;
}

bool legs_decide(const SharedHook& hook, const std::string& rule) {
  return hook.legs > 2 || (hook.legs == 2 && counts_legs(rule));
}

}  // namespace

double SharedHook::leg_factor() const {
  constexpr double steep = 45 * degrees_of_legs, rounding = 1e-6;
  if (legs < 2) return 1;
  if (angle <= steep + rounding) return legs == 2 ? 1.4 : 2.1;
  return legs == 2 ? 1.0 : 1.5;
}

double largest_leg_angle() { return 60 * degrees_of_legs; }

bool counts_legs(const std::string& rule) {
  constexpr std::array<std::string_view, 3> standards = {"EN 13414", "EN 818-4", "EN 1492"};
  return std::any_of(standards.begin(), standards.end(),
                     [&](std::string_view name) { return rule.starts_with(name); });
}

double demand_with_legs(double at_rest, const SharedHook& hook, const std::string& rule) {
  return legs_decide(hook, rule) ? std::max(at_rest, hook.load / hook.leg_factor()) : at_rest;
}

std::string legs_note(double at_rest, const SharedHook& hook, const std::string& rule) {
  if (!(demand_with_legs(at_rest, hook, rule) > at_rest)) return {};
  return fmt::format("{} legs as {:.1f}", hook.legs, hook.leg_factor());
}

SharedHook find_shared_hook(const LiftCase& lift_case, const LiftRun& lift,
                            const std::string& rope) {
  const given::Rope& own = *lift_case.find_rope(rope);
  if (own.path.front().kind != ResolvedPoint::Kind::hook) return {};
  const std::string name = own.path.front().body_name(lift_case.cranes);
  const auto hoist = std::find_if(lift.model.hoists.begin(), lift.model.hoists.end(),
                                  [&](const LiftHoist& one) { return one.name == name; });
  if (hoist == lift.model.hoists.end()) return {};
  const HoistModel& model =
      *lift_case.cranes[hoist->crane].model->find_hoist(name.substr(name.find('.') + 1));
  const dynamics::History& history = lift.static_history;
  Eigen::Index sample = 0;
  const double tackle = history.ropes[hoist->rope].tension.maxCoeff(&sample);
  SharedHook hook{0, std::max(0.0, tackle - model.hook_block.mass * lift_case.gravity), 0};
  for (const LiftRope& one : lift.model.ropes) {
    if (!hangs_from(lift_case, *lift_case.find_rope(one.name), name)) continue;
    ++hook.legs;
    const Eigen::Vector3d pull = history.ropes[one.rope].first_force.row(sample);
    if (pull.norm() > 0)
      hook.angle = std::max(hook.angle, std::acos(std::min(1.0, std::abs(pull.z()) / pull.norm())));
  }
  return hook;
}

}  // namespace blocklift::pipeline
