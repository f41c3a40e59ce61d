#include "dynamics/marine/panels/mirrored_bodies.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

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

/// A quadrangle that is not flat was flattened, which moves its vertices by up to a hundredth of
/// its size, also off the plane of an axis: these are put back, and it becomes two triangles. They
/// meet at the shorter diagonal, which is that of an image in the other plane, too.
/// @returns nothing if the panel has no such vertex.
std::vector<Panel> put_back_onto_plane(const Panel& panel, int axis) {
  if (panel.vertex_count != 4) return {};
  const double size = panel.diameter();
  Points corners(panel.vertices.begin(), panel.vertices.end());
  bool is_off = false;
  for (Vector3& corner : corners) {
    if (std::abs(corner[axis]) > 0.01 * size) continue;
    is_off |= std::abs(corner[axis]) > 1e-6 * size;
    corner[axis] = 0.0;
  }
  if (!is_off) return {};
  if ((corners[3] - corners[1]).norm() < (corners[2] - corners[0]).norm())
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  std::vector<Panel> triangles;
  for (const Points& triangle :
       {Points{corners[0], corners[1], corners[2]}, Points{corners[0], corners[2], corners[3]}}) {
    const double doubled = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
    if (doubled > 1e-6 * size * size) triangles.push_back(make_panel(triangle));
  }
  return triangles;
}

/// All panels, those with vertices that flattening has moved off the plane of an axis divided.
std::vector<Panel> put_back_onto_plane(const std::vector<Panel>& panels, int axis) {
  std::vector<Panel> result;
  for (const Panel& panel : panels) {
    const std::vector<Panel> triangles = put_back_onto_plane(panel, axis);
    if (triangles.empty()) {
      result.push_back(panel);
    } else {
      result.insert(result.end(), triangles.begin(), triangles.end());
    }
  }
  return result;
}

/// The half of panels on the positive side, and its image. Panels across the plane are cut.
PanelMesh from_half(const std::vector<Panel>& panels, const Symmetry& plane) {
  const int axis = plane.x ? 0 : 1;
  PanelMesh half{{}, plane};
  for (const Panel& panel : panels) {
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

/// What to do about quadrangles that flattening has moved off the plane.
enum class Flattened { cut, put_back };

std::vector<WettedBody> mirrored_in(const Symmetry& plane, const std::vector<std::size_t>& images,
                                    const std::vector<WettedBody>& bodies, Flattened flattened) {
  std::vector<WettedBody> mirrored = bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::vector<Panel>& panels = bodies[b].hull.panels;
    if (images[b] < b) mirrored[b].hull = image_of(bodies[images[b]].hull, plane);
    if (images[b] != b) continue;
    mirrored[b].hull = from_half(
        flattened == Flattened::cut ? panels : put_back_onto_plane(panels, plane.x ? 0 : 1), plane);
  }
  return mirrored;
}

bool differ_little(double a, double b, double share) {
  return std::abs(a - b) <= share * std::abs(b);
}

/// Vertices that are images may still belong to unlike surfaces. Quadrangles that are not flat are
/// divided along either diagonal, though, which changes area and volume somewhat, and may leave a
/// triangle in the plane, as at the foot of a stem: with its image it is a wall without thickness,
/// and both go.
bool are_same_surfaces(const std::vector<WettedBody>& bodies, const std::vector<WettedBody>& others,
                       double share) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const PanelMesh &hull = bodies[b].hull, &other = others[b].hull;
    if (!differ_little(hull.total_area(), other.total_area(), share)) return false;
    if (!differ_little(hull.displaced_volume(), other.displaced_volume(), share)) return false;
  }
  return true;
}

}  // namespace

void mirror_bodies(const std::vector<std::vector<Vector3>>& vertices_W,
                   std::vector<WettedBody>& bodies) {
  for (const Symmetry& plane : {Symmetry{true, false}, Symmetry{false, true}}) {
    const auto images = find_images(vertices_W, plane);
    if (!images) continue;
    const Symmetry had = find_symmetry(bodies);
    const Symmetry due{had.x || plane.x, had.y || plane.y};
    for (const auto& [flattened, share] :
         {std::pair(Flattened::cut, 1e-5), std::pair(Flattened::put_back, 1e-2)}) {
      std::vector<WettedBody> mirrored = mirrored_in(plane, *images, bodies, flattened);
      if (!are_same_surfaces(mirrored, bodies, share) || find_symmetry(mirrored) != due) continue;
      bodies = std::move(mirrored);
      break;
    }
  }
}

}  // namespace blocklift::dynamics
