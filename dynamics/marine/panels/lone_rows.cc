#include "dynamics/marine/panels/lone_rows.h"

#include <array>
#include <cmath>

#include "dynamics/marine/panels/panel_clusters.h"

namespace blocklift::dynamics {
namespace {

std::array<Panel, 2> cut_sides(const Panel& panel, int side) {
  const auto vertex = [&](int k) { return panel.vertices[(side + k) % 4]; };
  const Vector3 here = 0.5 * (vertex(0) + vertex(1)), there = 0.5 * (vertex(2) + vertex(3));
  return {make_panel(std::array{vertex(0), here, there, vertex(3)}),
          make_panel(std::array{here, vertex(1), vertex(2), there})};
}

std::vector<WettedBody> halve_bodies(const PanelModel& model, bool& changed) {
  changed = false;
  std::vector<WettedBody> bodies = model.bodies();
  for (WettedBody& body : bodies) {
    const int before = body.hull.size();
    body.hull = halve_lone_rows(body.hull, model.symmetry());
    changed = changed || body.hull.size() > before;
  }
  return bodies;
}

}  // namespace

PanelMesh halve_lone_rows(const PanelMesh& hull, const Symmetry& planes) {
  const auto beside = find_what_is_beside(hull, find_shared_edges(hull), planes);
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < hull.panels.size(); ++k) {
    std::vector<Panel> pieces{hull.panels[k]};
    for (const std::size_t side : {0, 1}) {
      // What lies beside the panel at two opposite sides: the other two are cut.
      const std::size_t other = 1 - side;
      if (hull.panels[k].vertex_count != 4 || beside[k][other] == Beside::panel ||
          beside[k][other + 2] == Beside::panel)
        continue;
      std::vector<Panel> cut;
      for (const Panel& piece : pieces) {
        for (const Panel& half : cut_sides(piece, static_cast<int>(side))) cut.push_back(half);
      }
      pieces = std::move(cut);
    }
    panels.insert(panels.end(), pieces.begin(), pieces.end());
  }
  return make_panel_mesh(std::move(panels), hull.symmetry);
}

Eigen::VectorXd calc_error_of_lone_rows(const PanelModel& model, const Eigen::VectorXd& volumes,
                                        const RankineSettings& settings) {
  bool changed = false;
  std::vector<WettedBody> bodies = halve_bodies(model, changed);
  if (!changed) return Eigen::VectorXd::Zero(model.mode_count());
  SurfaceMesh none;
  none.mesh.symmetry = model.symmetry();
  const PanelModel halved(std::move(bodies), none, model.water(), model.symmetry());
  RankineSettings plain = settings;
  plain.keep_factors = false;
  plain.coarser = nullptr;
  const auto volumes_of = [&](const PanelModel& of) {
    Eigen::VectorXd found = Eigen::VectorXd::Zero(of.mode_count());
    for (const Parity& parity : of.parities()) {
      if (of.normal_velocities(parity).isZero(0.0)) continue;
      const RankinePart part(of, parity, plain);
      found(part.modes()) += part.infinite_frequency_volume().diagonal();
    }
    return found;
  };
  // In finite depth the image in the bottom is felt without a surface otherwise than with it.
  const bool deep = is_deep(model.water());
  const PanelModel as_it_is(model.bodies(), none, model.water(), model.symmetry());
  const Eigen::VectorXd before = deep ? volumes : volumes_of(as_it_is);
  return 2.0 * (before - volumes_of(halved)).cwiseAbs();
}

double lone_rows_bytes(const PanelModel& model) {
  bool changed = false;
  int count = 0;
  for (const WettedBody& body : halve_bodies(model, changed)) count += body.hull.size();
  if (!changed) return 0.0;
  const int computed =
      (count + model.symmetry().image_count() - 1) / model.symmetry().image_count();
  return rankine_part_bytes(computed, 0, false);
}

}  // namespace blocklift::dynamics
