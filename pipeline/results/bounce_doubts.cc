#include "pipeline/results/bounce_doubts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

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

/// Largest share of a rope's largest load that motion has added to what it bears at rest.
double largest_rise(const LiftRun& lift) {
  const auto at_rest = dynamics::find_largest_tensions(lift.static_history),
             in_motion = dynamics::find_largest_tensions(lift.dynamic_history());
  double rise = 0;
  for (std::size_t rope = 0; rope < in_motion.size(); ++rope)
    if (in_motion[rope].tension > 0)
      rise = std::max(rise, 1 - at_rest[rope].tension / in_motion[rope].tension);
  return rise;
}

}  // namespace

std::vector<std::string> list_bounce_doubts(const LiftCase& lift_case, const LiftRun& lift) {
  constexpr double worth_saying = 0.005;  // of a rope's largest load
  constexpr double most_damping = 0.1;
  const dynamics::Mode* quickest = nullptr;
  const dynamics::Mode* most_damped = nullptr;
  for (const NaturalModes& modes : lift.natural_modes)
    for (const dynamics::Mode& mode : modes.linearisation.modes) {
      if (!is_bounce(lift.model, mode)) continue;
      if (!quickest || mode.period() < quickest->period()) quickest = &mode;
      if (!most_damped || mode.damping_ratio() > most_damped->damping_ratio()) most_damped = &mode;
    }
  std::vector<std::string> doubts;
  // On pads the load bounces on these, which its ropes hardly feel.
  if (!quickest || !lift_case.supports.empty()) return doubts;
  const double interval = lift_case.dynamics.sample_interval, period = quickest->period();
  const double missed =
      interval < period ? 1 - std::cos(std::numbers::pi * interval / period) : 1.0;
  const double missed_share = missed * largest_rise(lift);
  if (missed_share > worth_saying)
    doubts.push_back(fmt::format(
        "The largest loads are sought among samples {:g} s apart, and the motion \"{}\" has a "
        "period of {:.3g} s: a peak may be missed by up to {:.0f} % of what motion adds, {:.1f} % "
        "of a rope's largest load. Ask for a sample_interval of at most {:.2g} s.",
        interval, quickest->name, period, 100 * missed, 100 * missed_share, period / 20));
  if (most_damped->damping_ratio() > most_damping)
    doubts.push_back(fmt::format(
        "The motion \"{}\" has {:.1f} % of the critical damping; usual are 1 to 2 %. So much takes "
        "away what starts and stops add to the loads: is the damping_time of ropes and tackles too "
        "large?",
        most_damped->name, 100 * most_damped->damping_ratio()));
  return doubts;
}

}  // namespace blocklift::pipeline
