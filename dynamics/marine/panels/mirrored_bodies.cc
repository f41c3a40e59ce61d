#include "dynamics/marine/panels/mirrored_bodies.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace blocklift::dynamics {
namespace {

using Points = std::vector<Vector3>;

double size_of(const Points& points) {
  Vector3 low = points.front(), high = low;
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

/// Has each point an image among the others, to a millionth of the size?
bool are_images(const Points& points, const Points& others, const Symmetry& plane) {
  if (points.size() != others.size()) return false;
  const double tolerance = 1e-6 * size_of(points);
  Points sorted = others;
  std::sort(sorted.begin(), sorted.end(),
            [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  return std::all_of(points.begin(), points.end(), [&](const Vector3& point) {
    const Vector3 image = plane.reflect(1, point);
    auto other = std::lower_bound(sorted.begin(), sorted.end(), image.z() - tolerance,
                                  [](const Vector3& p, double z) { return p.z() < z; });
    for (; other != sorted.end() && other->z() <= image.z() + tolerance; ++other) {
      if ((*other - image).norm() < tolerance) return true;
    }
    return false;
  });
}

/// The image of each body; none if one has none.
std::optional<std::vector<std::size_t>> find_images(const std::vector<Points>& vertices_W,
                                                    const Symmetry& plane) {
  std::vector<std::size_t> images;
  for (const Points& points : vertices_W) {
    const auto image =
        std::find_if(vertices_W.begin(), vertices_W.end(),
                     [&](const Points& others) { return are_images(points, others, plane); });
    if (image == vertices_W.end()) return std::nullopt;
    images.push_back(static_cast<std::size_t>(image - vertices_W.begin()));
  }
  return images;
}

/// The part of a panel on the positive side of the plane of an axis, in one or two panels.
void add_positive_part(const Panel& panel, int axis, std::vector<Panel>& panels) {
  const double tolerance = 1e-6 * panel.diameter();
  const auto count = static_cast<std::size_t>(panel.vertex_count);
  Points part;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 &a = panel.vertices[k], &b = panel.vertices[(k + 1) % count];
    if (a[axis] > -tolerance) part.push_back(a);
    if (std::min(a[axis], b[axis]) > -tolerance || std::max(a[axis], b[axis]) < tolerance) continue;
    Vector3 crossing = a + a[axis] / (a[axis] - b[axis]) * (b - a);
    crossing[axis] = 0.0;
    part.push_back(crossing);
  }
  for (std::size_t k = 1; k + 1 < part.size(); k += 2) {
    Points piece{part[0], part[k], part[k + 1]};
    if (k + 2 < part.size()) piece.push_back(part[k + 2]);
    panels.push_back(make_panel(piece));
  }
}

/// The half of a mesh on the positive side, and its image. Panels across the plane are cut.
PanelMesh from_half(const PanelMesh& mesh, const Symmetry& plane) {
  const int axis = plane.x ? 0 : 1;
  PanelMesh half{{}, plane};
  for (const Panel& panel : mesh.panels) {
    const double tolerance = 1e-6 * panel.diameter();
    double lowest = 0.0, highest = 0.0;
    for (int k = 0; k < panel.vertex_count; ++k) {
      lowest = std::min(lowest, panel.vertices[k][axis]);
      highest = std::max(highest, panel.vertices[k][axis]);
    }
    if (highest < tolerance) continue;
    if (lowest > -tolerance) {
      half.panels.push_back(panel);
    } else {
      add_positive_part(panel, axis, half.panels);
    }
  }
  return expand_symmetry(half);
}

/// The image of a mesh alone.
PanelMesh image_of(const PanelMesh& mesh, const Symmetry& plane) {
  PanelMesh both = expand_symmetry(PanelMesh{mesh.panels, plane});
  const auto own = static_cast<std::ptrdiff_t>(mesh.panels.size());
  both.panels.erase(both.panels.begin(), both.panels.begin() + own);
  return both;
}

}  // namespace

void mirror_bodies(const std::vector<std::vector<Vector3>>& vertices_W,
                   std::vector<WettedBody>& bodies) {
  for (const Symmetry& plane : {Symmetry{true, false}, Symmetry{false, true}}) {
    const auto images = find_images(vertices_W, plane);
    if (!images) continue;
    std::vector<WettedBody> mirrored = bodies;
    bool same = true;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const std::size_t image = (*images)[b];
      if (image == b) mirrored[b].hull = from_half(bodies[b].hull, plane);
      if (image < b) mirrored[b].hull = image_of(bodies[image].hull, plane);
      // What lies in the plane would be lost, or doubled.
      same &= std::abs(mirrored[b].hull.total_area() - bodies[b].hull.total_area()) <
              1e-5 * bodies[b].hull.total_area();
    }
    if (same) bodies = std::move(mirrored);
  }
}

}  // namespace blocklift::dynamics
