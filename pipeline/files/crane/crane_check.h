#pragma once

#include "pipeline/declaration/reading.h"
#include "pipeline/files/crane/crane_model.h"

namespace blocklift::pipeline {

/// Names that refer to something exist; every body hangs on one joint, without a ring; drives move
/// joints that they can; ranges ascend; drives and hoists have different names. Complains into the
/// reading; values that could not be read are NaN or empty and are passed over.
void check_crane(const CraneModel& crane, Reading& reading, const Mark& mark);

}  // namespace blocklift::pipeline
