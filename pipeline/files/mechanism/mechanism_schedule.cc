#include "pipeline/files/mechanism/mechanism_schedule.h"

#include <utility>

namespace blocklift::pipeline {

Schedule schedule_operation(const MechanismFile& file, Diagnostics& diagnostics,
                            const FoundMotion& found) {
  std::vector<Mover> movers;
  for (const DriveModel& drive : file.drives) {
    if (drive.constant_speed || drive.table) continue;
    add_mover(movers, drive.name.value, false, drive, file.start_of(drive));
  }
  for (const given::Rope& rope : file.ropes) {
    if (rope.winch) {
      add_mover(movers, rope.name.value, true, *rope.winch, {rope.length.value, Dimension::length});
    }
  }
  const auto is_known = [&](const std::string& name) {
    const given::Rope* rope = file.find_rope(name);
    const DriveModel* drive = file.find_drive(name);
    return (rope && rope->winch) || (drive && !drive->constant_speed && !drive->table);
  };
  return schedule_operation(
      {"the mechanism", std::move(movers), &file.operation, 0, is_known, found}, diagnostics);
}

}  // namespace blocklift::pipeline
