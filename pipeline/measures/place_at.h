#pragma once

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Pose of a body of the lift at a sample; of the world the identity.
inline dynamics::Pose pose_at(const dynamics::History& history, dynamics::BodyIndex body,
                              Eigen::Index sample) {
  if (body == dynamics::world_index) return dynamics::Pose::identity();
  return history.bodies[body - 1].X_WB(sample);
}

/// Place of a body's point at a sample, in W, m.
inline Vector3 place_at(const dynamics::History& history, const dynamics::BodyPoint& point,
                        Eigen::Index sample) {
  return pose_at(history, point.body, sample).apply(point.p_BoQ_B);
}

}  // namespace blocklift::pipeline
