#include "pipeline/build/rope_stretch.h"

#include <vector>

namespace blocklift::pipeline {

void set_stretch(dynamics::RopeDefinition& rope, const RopeModel& model) {
  rope.damping_time = model.damping_time;
  if (!model.tension_curve) {
    rope.axial_stiffness = model.axial_stiffness;
    return;
  }
  std::vector<dynamics::TensionPoint> points;
  for (const auto& [strain, tension] : model.curve()) points.push_back({strain, tension});
  rope.tension_law = dynamics::TensionLaw(points);
}

}  // namespace blocklift::pipeline
