#include "pipeline/files/crane_check.h"

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/files/crane_pose.h"
#include "pipeline/mechanism/mechanism_parts_check.h"

namespace blocklift::pipeline {
namespace {

void check_hoists(const CraneModel& crane, Reading& reading) {
  for (const HoistModel& hoist : crane.hoists) {
    check_range_ascends(hoist.winch, "the winch of hoist " + hoist.name.value, hoist.name.mark,
                        reading);
    if (!hoist.body.value.empty() && !crane.find_body(hoist.body.value)) {
      reading.error(hoist.body.mark,
                    fmt::format("hoist {} stands on body \"{}\", which the crane does not have",
                                hoist.name.value, hoist.body.value),
                    {names_hint("its bodies are", names_of(crane.bodies), hoist.body.value)});
    }
    if (crane.find_drive(hoist.name.value) || crane.find_body(hoist.name.value)) {
      reading.error(
          hoist.name.mark,
          fmt::format("hoist {} has the name of a {} of this crane; give it another",
                      hoist.name.value, crane.find_drive(hoist.name.value) ? "drive" : "body"));
    }
  }
}

}  // namespace

void check_crane(const CraneModel& crane, Reading& reading, const Mark& mark) {
  check_parts(crane, reading);
  check_hoists(crane, reading);
  check_joint_positions(crane, crane.pose, "the pose", reading);
  if (reading.diagnostics().has_errors()) return;
  try {
    put_together(crane);
  } catch (const dynamics::ModelError& error) {
    reading.error(mark, error.what());
  } catch (const dynamics::SimulationError& error) {
    reading.error(crane.loops.front().name.mark, error.what(),
                  {"the key \"pose\" says where joints stand when the crane is put together"});
  }
}

}  // namespace blocklift::pipeline
