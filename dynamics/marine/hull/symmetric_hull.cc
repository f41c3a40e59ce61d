#include "dynamics/marine/hull/symmetric_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

/// Vertices near the plane are moved onto it; over the size of their smallest panel.
constexpr double near_plane = 0.05;

Hull moved_onto_plane(const Hull& hull, int axis) {
  std::vector<double> size(hull.vertices().size(), std::numeric_limits<double>::infinity());
  for (int k = 0; k < hull.panel_count(); ++k) {
    const double diameter = hull.panel_diameter(k);
    for (const int vertex : hull.panel(k)) {
      double& smallest = size[vertex];
      smallest = std::min(smallest, diameter);
    }
  }
  Hull moved(hull.name());
  for (std::size_t v = 0; v < size.size(); ++v) {
    Vector3 p = hull.vertices()[v];
    if (std::abs(p[axis]) < near_plane * size[v]) p[axis] = 0.0;
    moved.add_vertex(p);
  }
  for (int k = 0; k < hull.panel_count(); ++k) moved.add_panel(hull.panel(k));
  return moved;
}

bool is_warped(const Hull& hull, int panel) {
  const Vector3 normal = hull.panel_area_vector(panel).normalized();
  const Vector3& first = hull.vertex(hull.panel(panel)[0]);
  const double tolerance = 1e-9 * hull.panel_diameter(panel);
  const auto corners = hull.panel(panel);
  return std::any_of(corners.begin(), corners.end(), [&](int corner) {
    return std::abs(normal.dot(hull.vertex(corner) - first)) > tolerance;
  });
}

/// The half on the positive side of the plane; edges are cut once for all panels that share them.
class PositiveHalf {
 public:
  PositiveHalf(const Hull& whole, int axis)
      : whole_(whole), axis_(axis), half_(whole.name()), number_(whole.vertices().size(), -1) {
    for (int k = 0; k < whole.panel_count(); ++k) add_panel(k);
  }

  Hull take() && { return std::move(half_); }

 private:
  double side(int vertex) const { return whole_.vertex(vertex)[axis_]; }

  void add_panel(int panel) {
    const std::span<const int> corners = whole_.panel(panel);
    const auto beyond = [this](int corner) { return side(corner) > 0.0; };
    if (std::none_of(corners.begin(), corners.end(), beyond)) return;
    const bool across =
        std::any_of(corners.begin(), corners.end(), [this](int c) { return side(c) < 0.0; });
    if (!across) {
      std::vector<int> kept;
      for (const int corner : corners) kept.push_back(take_vertex(corner));
      half_.add_panel(kept);
    } else if (is_warped(whole_, panel)) {
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        add_cut({corners[0], corners[i], corners[i + 1]});
      }
    } else {
      add_cut({corners.begin(), corners.end()});
    }
  }

  /// By Sutherland and Hodgman.
  void add_cut(const std::vector<int>& corners) {
    std::vector<int> kept;
    bool beyond = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      if (side(a) >= 0.0) kept.push_back(take_vertex(a));
      beyond = beyond || side(a) > 0.0;
      if (side(a) * side(b) < 0.0) kept.push_back(crossing(a, b));
    }
    if (beyond && kept.size() >= 3) half_.add_panel(kept);
  }

  /// Those that no panel keeps are left out.
  int take_vertex(int vertex) {
    int& taken = number_[vertex];
    if (taken < 0) taken = half_.add_vertex(whole_.vertex(vertex));
    return taken;
  }

  int crossing(int a, int b) {
    const auto [known, is_new] = crossings_.try_emplace({std::min(a, b), std::max(a, b)}, 0);
    if (is_new) {
      const Vector3 &p = whole_.vertex(a), &q = whole_.vertex(b);
      Vector3 at = p + p[axis_] / (p[axis_] - q[axis_]) * (q - p);
      at[axis_] = 0.0;
      known->second = half_.add_vertex(at);
    }
    return known->second;
  }

  const Hull& whole_;
  int axis_;
  Hull half_;
  std::vector<int> number_;
  std::map<std::pair<int, int>, int> crossings_;
};

std::string planes_of(const std::vector<int>& axes) {
  std::string text;
  for (const int axis : axes) {
    text += (text.empty() ? "" : " and ") + std::string(axis == 0 ? "x = 0" : "y = 0");
  }
  return text;
}

void require_symmetric(const Hull& hull, const Hull& symmetric, const std::vector<int>& axes) {
  const EnclosedVolume before = calc_enclosed_volume(hull);
  const EnclosedVolume after = calc_enclosed_volume(symmetric);
  const auto [low, high] = hull.bounds();
  const double length = (high - low).norm();
  const Matrix3 inertia = before.inertia.matrix(), difference = after.inertia.matrix() - inertia;
  const double off_volume = std::abs(after.volume / before.volume - 1.0);
  const double off_centre = (after.centre - before.centre).norm() / length;
  const double off_inertia = difference.norm() / inertia.norm();
  if (off_volume <= 0.01 && off_centre <= 0.01 && off_inertia <= 0.02) return;
  std::ostringstream text;
  text << "the hull is not symmetric in " << planes_of(axes)
       << " of its frame: what lies on the positive side, with its images, holds " << after.volume
       << " m3 about (" << after.centre.transpose() << ") m, and the mesh " << before.volume
       << " m3 about (" << before.centre.transpose() << ") m";
  throw ModelError(text.str());
}

}  // namespace

Hull made_symmetric(const Hull& hull, const std::vector<int>& axes) {
  Hull part = hull;
  for (const int axis : axes) {
    part = PositiveHalf(moved_onto_plane(part, axis), axis).take();
    if (part.panel_count() == 0) {
      throw ModelError("the hull is not symmetric in " + planes_of(axes) +
                       " of its frame: no panel lies at positive " + (axis == 0 ? "x" : "y"));
    }
  }
  const auto [low, high] = hull.bounds();
  for (const int axis : axes) part = with_mirror_image(part, axis, 1e-9 * (high - low).norm());
  require_symmetric(hull, part, axes);
  return part;
}

}  // namespace blocklift::dynamics
