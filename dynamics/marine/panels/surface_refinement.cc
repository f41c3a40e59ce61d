#include "dynamics/marine/panels/surface_refinement.h"

#include <cmath>

#include "dynamics/marine/panels/surface_rings.h"

namespace blocklift::dynamics {
namespace {

using Vector2 = Eigen::Vector2d;

/// Pieces of a length, each at most so long; rounding makes none more.
int piece_count(double length, double most) {
  return std::max(1, static_cast<int>(std::ceil(length / most - 1e-6)));
}

}  // namespace

std::vector<Panel> refine_surface(const std::vector<Panel>& panels, const SurfaceFineness& fineness,
                                  double tolerance) {
  std::vector<Panel> refined;
  for (const Panel& panel : panels) {
    // Counter-clockwise seen from above; the fourth corner of a triangle is its third.
    std::array<Vector2, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) corner[k] = panel.vertices[3 - k].head<2>();
    const auto edge = [&](std::size_t k) { return (corner[(k + 1) % 4] - corner[k]).norm(); };
    const double most = fineness.at(panel.centroid.head<2>());
    const int along = piece_count(std::max(edge(0), edge(2)), most);
    const int across = piece_count(std::max(edge(1), edge(3)), most);
    if (along == 1 && across == 1) {
      refined.push_back(panel);
      continue;
    }
    const auto at = [&](int i, int j) -> Vector2 {
      const double s = static_cast<double>(i) / along, t = static_cast<double>(j) / across;
      return (1 - t) * ((1 - s) * corner[0] + s * corner[1]) +
             t * ((1 - s) * corner[3] + s * corner[2]);
    };
    for (int j = 0; j < across; ++j) {
      for (int i = 0; i < along; ++i) {
        add_surface_panel({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, tolerance,
                          refined);
      }
    }
  }
  return refined;
}

}  // namespace blocklift::dynamics
