#pragma once

#include "pipeline/files/lift_case/operation_schedule.h"
#include "pipeline/files/mechanism/mechanism_file.h"

namespace blocklift::pipeline {

/// When everything of a mechanism's operation happens; complains as for a case.
Schedule schedule_operation(const MechanismFile& file, Diagnostics& diagnostics,
                            const FoundMotion& found = {});

}  // namespace blocklift::pipeline
