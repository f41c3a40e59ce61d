#include "pipeline/build/lift_marine.h"

#include <cmath>
#include <optional>
#include <string>

namespace blocklift::pipeline {
namespace {

/// Mass of the cranes that stand on a vessel, kg; hook blocks and what they carry not counted.
double mass_on(const LiftCase& lift_case, const std::string& vessel) {
  double mass = 0;
  for (const given::Crane& crane : lift_case.cranes) {
    if (!crane.base || crane.base->value != vessel) continue;
    for (const BodyModel& body : crane.model->bodies) mass += body.mass;
  }
  return mass;
}

/// The load as it makes waves; none: it makes none.
std::optional<FloatingLoad> floating_load(const LiftCase& lift_case) {
  const given::Load& load = lift_case.load;
  if (!load.draughts || !load.vessel) return std::nullopt;
  const dynamics::Pose X_WB = load.pose_afloat();
  return FloatingLoad{.vessel = load.vessel,
                      .draughts = load.draughts->value,
                      .position = X_WB.p.head<2>(),
                      .heading = std::atan2(X_WB.R(1, 0), X_WB.R(0, 0))};
}

}  // namespace

MarineBuilder marine_of(const LiftCase& lift_case) {
  MarineBuilder marine(lift_case, lift_case.gravity, floating_load(lift_case));
  marine.place([&](const std::string& vessel) { return mass_on(lift_case, vessel); });
  return marine;
}

}  // namespace blocklift::pipeline
