#pragma once

#include "pipeline/input/crane_model.h"
#include "pipeline/input/reading.h"

namespace blocklift::pipeline {

// Rules over several keys of a crane's model file; each complains into the reading. Values that
// could not be read are NaN or empty and are passed over.

/// Either radii of gyration or inertia, and an inertia that some distribution of mass can have:
/// principal moments positive, none larger than the sum of the other two.
void check_body(const BodyModel& body, Reading& reading, const Mark& mark);

/// Second axis square to the first; damping one value a degree of freedom, of its kind.
void check_joint(const JointModel& joint, Reading& reading, const Mark& mark);

/// Names that refer to something exist; every body hangs on one joint, without a ring; drives move
/// joints that they can; ranges ascend; drives and hoists have different names.
void check_crane(const CraneModel& crane, Reading& reading, const Mark& mark);

}  // namespace blocklift::pipeline
