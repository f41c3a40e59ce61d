#include "pipeline/files/environment/vessel_doubts.h"

#include <cmath>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {
namespace {

std::string doubt_about_dry_vessels(const MarineParts& parts) {
  std::vector<std::string> names;
  for (const given::Vessel& vessel : parts.vessels) {
    if (vessel.radiation.value == RadiationMethod::none) names.push_back(vessel.name.value);
  }
  if (names.empty()) return {};
  return fmt::format(
      "In waves, and radiation: none: no water moves along with {}. Without added mass natural "
      "periods of heave, roll and pitch are too short, nothing but the damping that the file gives "
      "damps them, and waves are not diffracted. That is for trials: for a verdict leave radiation "
      "out, or name a database.",
      list_of_names(names));
}

/// Newtons by which the current at the surface pulls a vessel that lies still, by its linear
/// damping.
double pull_of_damping(const given::Vessel& vessel, const given::Current& current) {
  const double angle = current.towards - vessel.heading;
  return current.speed *
         std::hypot(vessel.damping.surge * std::cos(angle), vessel.damping.sway * std::sin(angle));
}

}  // namespace

std::vector<std::string> doubts_about_vessels(const MarineParts& parts) {
  std::vector<std::string> doubts;
  if (!parts.sea) return doubts;
  if (parts.sea->waves) {
    if (std::string dry = doubt_about_dry_vessels(parts); !dry.empty())
      doubts.push_back(std::move(dry));
  }
  if (!parts.sea->current) return doubts;
  for (const given::Vessel& vessel : parts.vessels) {
    if (!vessel.current_load) continue;
    const double pull = pull_of_damping(vessel, *parts.sea->current);
    if (!(pull > 0.0)) continue;
    doubts.push_back(fmt::format(
        "The linear damping of surge and sway acts on the velocity through the water: the current "
        "of {:.3g} m/s pulls vessel {} by {:.4g} kN through it, besides its current_load, whose "
        "coefficients hold the whole force of a current. Damping of the motion through the world "
        "is that of a restraint.",
        parts.sea->current->speed, vessel.name.value, pull / 1e3));
  }
  return doubts;
}

}  // namespace blocklift::pipeline
