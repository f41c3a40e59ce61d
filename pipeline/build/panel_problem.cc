#include "pipeline/build/panel_problem.h"

#include <numbers>
#include <utility>

#include "dynamics/marine/panels/mirrored_bodies.h"

namespace blocklift::pipeline {
namespace {

double wave_length(double frequency, const dynamics::Water& water) {
  return 2.0 * std::numbers::pi / dynamics::calc_wave_number(frequency, water);
}

std::vector<dynamics::WettedBody> wetted_bodies(const PanelProblem& problem) {
  std::vector<dynamics::WettedBody> bodies;
  std::vector<std::vector<dynamics::Vector3>> vertices_D;
  for (const PanelProblem::Body& body : problem.bodies) {
    bodies.push_back(make_wetted_body(*body.hull, body.X_DB, body.p_BoR_B));
    bodies.back().name = body.name;
    std::vector<dynamics::Vector3>& vertices = vertices_D.emplace_back();
    for (const dynamics::Vector3& vertex : body.hull->vertices())
      vertices.push_back(body.X_DB.apply(vertex));
  }
  if (problem.symmetry) mirror_bodies(vertices_D, bodies);
  return bodies;
}

}  // namespace

dynamics::PanelModel make_panel_model(const PanelProblem& problem) {
  std::vector<dynamics::WettedBody> bodies = wetted_bodies(problem);
  const dynamics::Symmetry symmetry =
      problem.symmetry ? keep_symmetry(find_symmetry(bodies), problem.lids) : dynamics::Symmetry{};
  const std::vector<dynamics::WaterLine> lines = find_water_lines(bodies);
  dynamics::SurfaceMesh surface;
  surface.mesh.symmetry = symmetry;
  if (problem.method == dynamics::PanelMethod::marched_surface) {
    surface = make_surface_mesh(
        lines,
        dynamics::surface_settings(lines, wave_length(problem.frequencies.back(), problem.water),
                                   wave_length(problem.frequencies.front(), problem.water)));
  }
  return {std::move(bodies), surface, problem.water, symmetry};
}

dynamics::DatabaseSettings database_settings(const PanelProblem& problem) {
  dynamics::DatabaseSettings settings;
  settings.frequencies = problem.frequencies;
  settings.headings = problem.headings;
  settings.lids = problem.lids;
  settings.with_coarser = true;
  settings.with_far_field = problem.far_field;
  return settings;
}

dynamics::HydrodynamicDatabase compute_radiation(
    const PanelProblem& problem, const dynamics::PanelModel& model,
    const std::vector<dynamics::BodyGroup>& groups,
    const std::function<void(double, const char*)>& progress) {
  dynamics::DatabaseSettings settings = database_settings(problem);
  settings.progress = progress;
  return compute_by_method(problem.method, model, groups, settings);
}

}  // namespace blocklift::pipeline
