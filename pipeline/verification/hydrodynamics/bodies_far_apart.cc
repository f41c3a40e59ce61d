#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

// Two boxes of 10 x 10 m, 5 m deep, in 20 m of water, their middles 100 m apart; the first stands
// on its corner. At 1.8 rad/s there are five waves between them.
constexpr double box_distance = 100.0, box_draught = 5.0;
const Water box_water{1000.0, 9.81, 20.0};

/// About the origin, by an angle about the vertical (rad).
PanelMesh turn_about_vertical(const PanelMesh& mesh, double angle) {
  const Matrix3 R = rotation_about(Vector3::UnitZ(), angle);
  std::vector<Panel> panels;
  for (const Panel& panel : mesh.panels) {
    std::vector<Vector3> corners;
    for (int k = 0; k < panel.vertex_count; ++k) {
      corners.emplace_back(R * panel.vertices[static_cast<std::size_t>(k)]);
    }
    panels.push_back(make_panel(corners));
  }
  return make_panel_mesh(std::move(panels));
}

struct TwoBoxes {
  HydrodynamicDatabase database;
  int panels = 0;
};

TwoBoxes compute_two_boxes(int panels_along, bool carried) {
  const BoxDivision division{panels_along, panels_along, panels_along / 2, 2.5};
  const PanelMesh box = expand_symmetry(make_box_hull(10.0, 10.0, box_draught, division));
  const Vector3 half(0.5 * box_distance, 0, 0), middle(0, 0, -0.5 * box_draught);
  const std::vector<WettedBody> bodies{
      {"turned", translate(turn_about_vertical(box, 0.25 * std::numbers::pi), -half),
       middle - half},
      {"straight", translate(box, half), middle + half}};
  DatabaseSettings settings;
  settings.frequencies = {1.0, 1.4, 1.8};
  settings.with_far_field = true;
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double w) {
    return 2.0 * std::numbers::pi / calc_wave_number(w, box_water);
  };
  SurfaceMeshSettings surface =
      surface_settings(lines, length(settings.frequencies.back()), length(settings.frequencies[0]));
  if (!carried) surface.carried_wave = 0.0;
  const PanelModel model(bodies, make_surface_mesh(lines, surface), box_water, {false, true});
  TwoBoxes result{compute_database(model, settings),
                  2 * (model.body_mesh().size() + model.surface_mesh().size())};
  return result;
}

/// Work of the damping of two motions on each other by the waves that both send out together:
/// B = rho g c_g/w^2 Re int H_i H_j^* dt.
double damping_by_waves(const HydrodynamicDatabase& database, std::size_t k, Eigen::Index i,
                        Eigen::Index j) {
  const double w = database.frequencies[k];
  const Eigen::VectorXcd &a = database.far_field.radiated[k].col(i),
                         &b = database.far_field.radiated[k].col(j);
  const double mean = b.dot(a).real() / static_cast<double>(a.size());
  const double flux =
      database.water.density * database.water.gravity * calc_group_velocity(w, database.water);
  return flux / (w * w) * 2.0 * std::numbers::pi * mean;
}

std::vector<VerificationRow> far_apart_rows() {
  std::vector<VerificationRow> rows;
  const TwoBoxes fine = compute_two_boxes(12, true);
  const HydrodynamicDatabase& database = fine.database;
  const Eigen::Index other = modes_per_body;
  const double published = 72040.0;
  rows.push_back(compare(
      fmt::format("two boxes 100 m apart, surge on surge at 1.8 rad/s, {} panels", fine.panels),
      "kg/s", published, database.damping[2](surge, other + surge), 0.05 * published,
      "WAMIT, example of two cubes in WEC-Sim's BEMIO"));
  for (const int mode : {surge, heave}) {
    for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
      const double own = std::sqrt(database.damping[k](mode, mode) *
                                   database.damping[k](other + mode, other + mode));
      rows.push_back(
          compare(fmt::format("{} on {} of the other, {} rad/s, over that on itself",
                              mode == surge ? "surge" : "heave", mode == surge ? "surge" : "heave",
                              database.frequencies[k]),
                  "1", damping_by_waves(database, k, mode, other + mode) / own,
                  database.damping[k](mode, other + mode) / own, 0.02,
                  "conservation of energy: waves far away against pressure on the hulls"));
    }
  }
  return rows;
}

}  // namespace

VerificationCase bodies_far_apart() {
  return {.name = "bodies-far-apart",
          .stage = "hydrodynamics",
          .source = "WAMIT; conservation of energy",
          .compute = far_apart_rows};
}

}  // namespace blocklift::pipeline
