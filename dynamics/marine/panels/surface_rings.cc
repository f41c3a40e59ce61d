#include "dynamics/marine/panels/surface_rings.h"

#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

using Vector2 = Eigen::Vector2d;

std::vector<double> ring_edges(double distance, RingWidths& widths) {
  std::vector<double> edges{0.0, widths.width};
  widths.widen();
  while (edges.back() + 0.5 * widths.width < distance) {
    edges.push_back(edges.back() + widths.width);
    widths.widen();
  }
  const double sum = edges.back();
  for (double& edge : edges) edge /= sum;
  edges.back() = 1.0;
  return edges;
}

void add_surface_panel(const std::vector<Vector2>& points, double tolerance,
                       std::vector<Panel>& panels) {
  std::vector<Vector3> distinct;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector2& next = points[(k + 1) % points.size()];
    if ((next - points[k]).norm() > tolerance) {
      distinct.emplace_back(points[k].x(), points[k].y(), 0.0);
    }
  }
  if (distinct.size() < 3) return;
  std::reverse(distinct.begin(), distinct.end());  // normals down
  const Panel panel = make_panel(distinct);
  if (panel.normal.z() > 0.0 || !(panel.area > 0.0)) {
    throw ModelError("a ray of the surface mesh crosses another near (" +
                     std::to_string(points[0].x()) + ", " + std::to_string(points[0].y()) +
                     ") m: the water line there is too hollow; divide the body or round the line");
  }
  panels.push_back(panel);
}

void add_surface_rings(const std::array<Vector2, 2>& from, const std::array<Vector2, 2>& to,
                       const std::vector<double>& edges, double tolerance,
                       std::vector<Panel>& panels) {
  const auto at = [&](std::size_t ray, double share) -> Vector2 {
    return from[ray] + share * (to[ray] - from[ray]);
  };
  for (std::size_t j = 0; j + 1 < edges.size(); ++j) {
    const double s = edges[j], t = edges[j + 1];
    add_surface_panel({at(0, s), at(0, t), at(1, t), at(1, s)}, tolerance, panels);
  }
}

}  // namespace blocklift::dynamics
