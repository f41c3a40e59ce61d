#include "pipeline/build/keel_clearance.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

/// Water under a panel.
struct UnderPanel {
  double size;       ///< of the panel: the root of its area, m
  double clearance;  ///< from its middle to the ground, m
};

std::optional<UnderPanel> find_widest(const dynamics::Hull& hull, const dynamics::Pose& X_WB,
                                      double depth) {
  constexpr double looks_down = -0.5;  // the normal's share along the world's z
  std::optional<UnderPanel> widest;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const Vector3 area = X_WB.R * hull.panel_area_vector(panel);
    const double height = X_WB.apply(hull.panel_midpoint(panel)).z();
    if (height >= 0.0 || area.z() > looks_down * area.norm()) continue;
    const UnderPanel here{std::sqrt(area.norm()), depth + height};
    if (here.clearance <= 0.0) continue;
    if (!widest || here.size * widest->clearance > widest->size * here.clearance) widest = here;
  }
  return widest;
}

}  // namespace

std::string doubt_about_keel(const std::string& name, const dynamics::Hull& hull,
                             const dynamics::Pose& X_WB, double depth) {
  if (!std::isfinite(depth)) return {};
  constexpr double rounding = 1e-6;
  const std::optional<UnderPanel> widest = find_widest(hull, X_WB, depth);
  if (!widest || widest->size <= (1.0 + rounding) * widest->clearance) return {};
  return fmt::format(
      "Under the keel of {} are {:.3g} m of water, and the panels there are {:.3g} m wide. Panels "
      "wider than the water under them make its added mass in heave, roll and pitch too large, by "
      "a fifth at four times the depth: take panels of {:.3g} m or less.",
      name, widest->clearance, widest->size, widest->clearance);
}

std::string doubt_about_keels(const RadiationProblem& problem) {
  if (problem.given) return {};
  for (const PanelProblem::Body& body : problem.bodies) {
    std::string doubt = doubt_about_keel(body.name, *body.hull, body.X_DB, problem.water.depth);
    if (!doubt.empty()) return doubt;
  }
  return {};
}

}  // namespace blocklift::pipeline
