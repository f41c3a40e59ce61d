#include "pipeline/results/doubts/bounce_doubts.h"

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

/// Whether the load goes up and down in a mode by what stretches. How it rocks on its ropes may be
/// far quicker, and adds little to their loads.
bool is_bounce(const BuiltLift& model, const dynamics::Mode& mode) {
  if (mode.kind != dynamics::ModeKind::oscillating || mode.elastic_share < 0.5 ||
      mode.name.find("bounce") == std::string::npos)
    return false;
  double rigid = 0, vibrating = 0;
  for (const dynamics::BodyModeMotion& body : mode.bodies)
    if (body.body == model.load) rigid = body.energy_share;
  for (const dynamics::ElasticModeMotion& one : mode.elastic_modes) vibrating += one.energy_share;
  return rigid - vibrating >= 0.5;
}

}  // namespace

std::vector<std::string> list_bounce_doubts(const LiftCase& lift_case, const LiftRun& lift) {
  constexpr double most_damping = 0.1;
  const dynamics::Mode* most_damped = nullptr;
  for (const NaturalModes& modes : lift.natural_modes)
    for (const dynamics::Mode& mode : modes.linearisation.modes) {
      if (!is_bounce(lift.model, mode)) continue;
      if (!most_damped || mode.damping_ratio() > most_damped->damping_ratio()) most_damped = &mode;
    }
  std::vector<std::string> doubts;
  // On pads the load bounces on these, which its ropes hardly feel.
  if (!most_damped || !lift_case.supports.empty()) return doubts;
  if (most_damped->damping_ratio() > most_damping)
    doubts.push_back(fmt::format(
        "The motion \"{}\" has {:.1f} % of the critical damping; usual are 1 to 2 %. So much takes "
        "away what starts and stops add to the loads: is the damping_time of ropes and tackles too "
        "large?",
        most_damped->name, 100 * most_damped->damping_ratio()));
  return doubts;
}

}  // namespace blocklift::pipeline
