#include "pipeline/build/held_heading.h"

#include <algorithm>
#include <string>

namespace blocklift::pipeline {

namespace {

/// The hook that all ropes that hold the load hang on, by its name; empty if there is none.
std::string find_only_hook(const std::vector<LiftRope>& ropes) {
  std::string hook;
  for (const LiftRope& rope : ropes) {
    if (!rope.holds_load()) continue;
    if (rope.hoist.empty() || (!hook.empty() && rope.hoist != hook)) return {};
    hook = rope.hoist;
  }
  return hook;
}

/// Do ropes end at several places of a hook, so that it turns with what hangs on it?
bool has_places_apart(const std::vector<LiftRope>& ropes,
                      const std::vector<dynamics::RopeDefinition>& definitions,
                      dynamics::BodyIndex hook) {
  constexpr double same = 1e-6;  // m
  std::optional<Vector3> first;
  for (const LiftRope& rope : ropes)
    for (const dynamics::BodyPoint& point : definitions[rope.rope].points) {
      if (point.body != hook) continue;
      if (first && (point.p_BoQ_B - *first).norm() > same) return true;
      first = point.p_BoQ_B;
    }
  return false;
}

/// Is the hook locked to a block that turns against its falls?
bool turns_with_falls(const LiftCase& lift_case, const LiftHoist& hoist) {
  const given::Crane& crane = lift_case.cranes[hoist.crane];
  const HoistModel* model = crane.model->find_hoist(hoist.name.substr(crane.name.value.size() + 1));
  return model && model->hook_block.turning && !model->hook_block.turning->bearing;
}

}  // namespace

std::optional<dynamics::HeldHeading> find_held_heading(
    const LiftCase& lift_case, const std::vector<LiftRope>& ropes,
    const std::vector<LiftHoist>& hoists, const std::vector<dynamics::RopeDefinition>& definitions,
    const dynamics::HeldHeading& drawn) {
  const bool has_tuggers = std::ranges::any_of(lift_case.tuggers, [](const given::Tugger& line) {
    return line.from.body.value == "load" || line.to.body.value == "load";
  });
  if (lift_case.load.vessel || has_tuggers) return std::nullopt;
  const auto hoist = std::ranges::find(hoists, find_only_hook(ropes), &LiftHoist::name);
  if (hoist == hoists.end()) return std::nullopt;
  if (turns_with_falls(lift_case, *hoist) && has_places_apart(ropes, definitions, hoist->hook))
    return std::nullopt;
  return drawn;
}

dynamics::EquilibriumSettings settings_at_rest(const BuiltLift& model) {
  return {.held_heading = model.held_heading};
}

dynamics::EquilibriumSolver solver_at_rest(const BuiltLift& model) {
  return dynamics::EquilibriumSolver(model.at_rest(), settings_at_rest(model));
}

}  // namespace blocklift::pipeline
