#include "pipeline/verification/models/hemisphere.h"

#include <cmath>
#include <numbers>

#include "dynamics/marine/panels/panel_shapes.h"

namespace blocklift::dynamics::examples {

Hemisphere make_hemisphere(double radius, const HemisphereDivision& division, const Water& water,
                           double low) {
  std::vector<WettedBody> bodies{
      {"sphere",
       make_half_ellipsoid(Vector3::Constant(radius),
                           {.meridians = division.meridians, .parallels = division.parallels}),
       Vector3(0, 0, low)}};
  const SurfaceMesh surface =
      make_surface_mesh(find_water_lines(bodies), {.first_ring = division.first_ring * radius,
                                                   .growth = division.growth,
                                                   .radius = division.outer_radius * radius});
  PanelModel model(bodies, surface, water, find_symmetry(bodies));
  const int unknowns = bodies[0].hull.size() + surface.mesh.size();
  return {bodies, std::move(model), unknowns};
}

HydrodynamicDatabase compute_unit_database(const PanelModel& model) {
  DatabaseSettings settings;
  for (const HemisphereRow& row : hulme) settings.frequencies.push_back(std::sqrt(row.ka));
  settings.headings = {0.0, std::numbers::pi / 3};
  settings.duration = 40.0;
  settings.damping_strength = 0.5;
  return compute_database(model, settings);
}

LinearFloatation task_10() {
  LinearFloatation sphere;
  sphere.mass = Eigen::MatrixXd::Zero(6, 6);
  sphere.mass.diagonal() << 261.8e3, 261.8e3, 261.8e3, 1.690e6, 1.690e6, 2.606e6;
  sphere.stiffness = Eigen::MatrixXd::Zero(6, 6);
  sphere.stiffness(heave, heave) = 7.695e5;
  sphere.start = Eigen::VectorXd::Zero(6);
  sphere.start[heave] = 1.0;
  return sphere;
}

}  // namespace blocklift::dynamics::examples
