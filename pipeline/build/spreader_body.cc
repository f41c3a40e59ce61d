#include "pipeline/build/spreader_body.h"

#include <numbers>

namespace blocklift::pipeline {

dynamics::BodyDefinition spreader_body(const given::Spreader& spreader) {
  dynamics::BodyDefinition body;
  body.name = spreader.name.value;
  body.joint.kind = dynamics::JointKind::free;
  body.mass = spreader.mass();
  body.p_BoBcm_B = spreader.centre();
  body.I_BBcm_B = spreader.inertia();
  return body;
}

std::vector<BoxShape> spreader_boxes(const given::Spreader& spreader) {
  const double length = spreader.length.value;
  const auto box = [](const BarSection& bar, double along, const Vector3& centre, double yaw) {
    return BoxShape{Vector3(along, bar.width(), bar.height()), centre, {0, 0, yaw}};
  };
  const BarSection& own = spreader.section.value;
  if (!spreader.is_frame()) return {box(own, length, Vector3::Zero(), 0)};
  const BarSection& across = spreader.cross_section ? spreader.cross_section->value : own;
  const double width = *spreader.width;
  std::vector<BoxShape> sides;
  for (const double side : {-0.5, 0.5}) {
    sides.push_back(box(own, length, {0, side * width, 0}, 0));
    sides.push_back(box(across, width, {side * length, 0, 0}, std::numbers::pi / 2));
  }
  return sides;
}

}  // namespace blocklift::pipeline
