#include "pipeline/results/files/lift_scene.h"

namespace blocklift::pipeline {

LoadMass load_mass(const structure::MassProperties& mass) {
  return {mass.mass, mass.centre_of_mass_B, mass.inertia_BBcm_B};
}

std::vector<structure::LiftingPoint> vessel_lugs(const given::Load& load) {
  std::vector<structure::LiftingPoint> lugs;
  for (const Named<Vector3>& lug : load.lugs) {
    structure::LiftingPoint& region = lugs.emplace_back();
    region.name = lug.name.value;
    region.p_BPin = lug.value;
  }
  return lugs;
}

DrawnBox drawn_box(const BoxShape& box) {
  return {box.size, box.centre, dynamics::quaternion_from_rotation(rotation_of(box.attitude))};
}

Scene make_scene(const BuiltLift& model, const std::vector<structure::LiftingPoint>& lugs) {
  Scene scene;
  for (const LiftBody& body : model.bodies) {
    DrawnBody drawn{body.name, body.kind, {}};
    for (const BoxShape& box : body.boxes) drawn.boxes.push_back(drawn_box(box));
    scene.bodies.push_back(drawn);
  }
  for (const LiftHoist& hoist : model.hoists)
    scene.hoists.push_back({hoist.name, static_cast<std::size_t>(hoist.rope), hoist.hook_is_first});
  scene.load_body = model.system.mechanism().body(model.load).name;
  scene.lugs = lugs;
  return scene;
}

}  // namespace blocklift::pipeline
