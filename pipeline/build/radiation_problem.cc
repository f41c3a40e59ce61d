#include "pipeline/build/radiation_problem.h"

#include <algorithm>
#include <numbers>

#include "dynamics/marine/panels/mirrored_bodies.h"
#include "dynamics/marine/panels/wetted_body.h"
#include "dynamics/simulation/marched_surface.h"

namespace blocklift::pipeline {
namespace {

double wave_length(double frequency, const dynamics::Water& water) {
  return 2.0 * std::numbers::pi / dynamics::calc_wave_number(frequency, water);
}

}  // namespace

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

int RadiationProblem::lowered_body() const {
  const auto found = std::find_if(bodies.begin(), bodies.end(),
                                  [](const Body& body) { return !body.draughts.empty(); });
  return found == bodies.end() ? -1 : static_cast<int>(found - bodies.begin());
}

RadiationProblem without_lowered(RadiationProblem problem) {
  const int body = problem.lowered_body();
  if (body >= 0) problem.bodies.erase(problem.bodies.begin() + body);
  return problem;
}

RadiationProblem at_draught(RadiationProblem problem, double draught) {
  const int body = problem.lowered_body();
  if (body < 0) return problem;
  RadiationProblem::Body& lowered = problem.bodies[body];
  lowered.X_DB.p.z() = -lowered.vessel->hull.bounds()[0].z() - draught;
  lowered.draughts.clear();
  return problem;
}

dynamics::PanelModel make_panel_model(const RadiationProblem& problem) {
  std::vector<dynamics::WettedBody> bodies;
  std::vector<std::vector<Vector3>> vertices_W;
  for (const RadiationProblem::Body& body : problem.bodies) {
    const dynamics::Hull& hull = body.vessel->hull;
    bodies.push_back(make_wetted_body(hull, body.X_DB, body.p_BoR_B));
    bodies.back().name = body.name;
    std::vector<Vector3>& vertices = vertices_W.emplace_back();
    for (const Vector3& vertex : hull.vertices()) vertices.push_back(body.X_DB.apply(vertex));
  }
  mirror_bodies(vertices_W, bodies);
  const dynamics::Symmetry symmetry = keep_symmetry(find_symmetry(bodies), problem.lids);
  const std::vector<dynamics::WaterLine> lines = find_water_lines(bodies);
  dynamics::SurfaceMesh surface;
  surface.mesh.symmetry = symmetry;
  if (problem.method == dynamics::PanelMethod::marched_surface) {
    surface = make_surface_mesh(
        lines,
        dynamics::surface_settings(lines, wave_length(problem.frequencies.back(), problem.water),
                                   wave_length(problem.frequencies.front(), problem.water)));
  }
  dynamics::PanelModel model(std::move(bodies), surface, problem.water, symmetry);
  require_panels_for_waves(model, problem.frequencies.back());
  return model;
}

MarchedWater make_marched_water(const RadiationProblem& problem) {
  if (!problem.direct || problem.bodies.empty()) return {};
  const dynamics::PanelModel model = make_panel_model(problem);
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

dynamics::HydrodynamicDatabase compute_radiation(
    const RadiationProblem& problem, const dynamics::PanelModel& model,
    const std::vector<dynamics::BodyGroup>& groups,
    const std::function<void(double, const char*)>& progress) {
  dynamics::DatabaseSettings settings;
  settings.frequencies = problem.frequencies;
  settings.headings = problem.headings;
  settings.lids = problem.lids;
  settings.with_coarser = true;
  settings.with_far_field = problem.drifting.has_value();
  settings.progress = progress;
  return compute_by_method(problem.method, model, groups, settings);
}

}  // namespace blocklift::pipeline
