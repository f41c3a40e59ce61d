#include "pipeline/build/radiation_problem.h"

#include "dynamics/simulation/marched_surface.h"

namespace blocklift::pipeline {

dynamics::MemoryFit memory_fit_of_vessels() {
  dynamics::MemoryFit fit;
  fit.tolerance = 0.005;
  fit.most_states = 400;
  fit.acceptable_error = 0.02;
  // Water that swings long between two hulls takes more states.
  fit.loose_tolerance = 0.1;
  fit.most_loose_states = 600;
  return fit;
}

PanelProblem without_lowered(const RadiationProblem& problem) {
  PanelProblem others = problem;
  if (problem.lowered)
    others.bodies.erase(others.bodies.begin() + static_cast<std::ptrdiff_t>(problem.lowered->body));
  return others;
}

PanelProblem at_draught(const RadiationProblem& problem, double draught) {
  PanelProblem there = problem;
  if (!problem.lowered) return there;
  PanelProblem::Body& body = there.bodies[problem.lowered->body];
  body.X_DB.p.z() = -body.hull->bounds()[0].z() - draught;
  return there;
}

MarchedWater make_marched_water(const RadiationProblem& problem) {
  if (!problem.direct || problem.bodies.empty()) return {};
  const dynamics::PanelModel model = make_panel_model(problem);
  require_panels_for_waves(model, problem.frequencies.back());
  dynamics::DirectRadiation::Settings settings;
  settings.damping_strength = dynamics::damping_zone(problem.frequencies.front()).strength;
  settings.lids = problem.lids;
  settings.waves = problem.waves;
  settings.with_froude_krylov = false;  // HullForce's
  settings.ramp = problem.ramp;
  settings.origin = problem.origin;
  MarchedWater water;
  water.radiation = std::make_shared<dynamics::DirectRadiation>(model, settings);
  water.step = dynamics::marching_step(*water.radiation, problem.frequencies.back());
  water.unknowns = model.body_mesh().size() + model.surface_mesh().size();
  return water;
}

}  // namespace blocklift::pipeline
