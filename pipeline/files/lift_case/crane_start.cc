#include "pipeline/files/lift_case/crane_start.h"

namespace blocklift::pipeline {

CranePose pose_at_start(const given::Crane& crane) {
  return pose_at_start(
      *crane.model, [&](const std::string& drive) { return crane.find_start(drive)->value.value; },
      crane.name.value);
}

}  // namespace blocklift::pipeline
