#include "dynamics/marine/wetted_body.h"

#include <algorithm>
#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Polygon = std::vector<Vector3>;

double diameter_of(const Polygon& polygon) {
  double squared = 0.0;
  for (const Vector3& a : polygon) {
    for (const Vector3& b : polygon) squared = std::max(squared, (a - b).squaredNorm());
  }
  return std::sqrt(squared);
}

Vector3 area_vector(const Polygon& polygon) {
  Vector3 doubled = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    doubled += (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]);
  }
  return 0.5 * doubled;
}

bool is_flat(const Polygon& polygon) {
  const Vector3 normal = area_vector(polygon).normalized();
  const double tolerance = 0.01 * diameter_of(polygon);
  return std::all_of(polygon.begin(), polygon.end(), [&](const Vector3& vertex) {
    return std::abs(normal.dot(vertex - polygon[0])) < tolerance;
  });
}

/// The part at z <= 0, by Sutherland and Hodgman.
Polygon cut_at_surface(Polygon polygon) {
  const double tolerance = 1e-3 * diameter_of(polygon);
  for (Vector3& vertex : polygon) {
    if (std::abs(vertex.z()) < tolerance) vertex.z() = 0.0;
  }
  Polygon below;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if (a.z() <= 0.0) below.push_back(a);
    if ((a.z() < 0.0 && b.z() > 0.0) || (a.z() > 0.0 && b.z() < 0.0)) {
      Vector3 crossing = a + a.z() / (a.z() - b.z()) * (b - a);
      crossing.z() = 0.0;
      below.push_back(crossing);
    }
  }
  return below;
}

/// Quadrangles and at the end a triangle between the first vertex and the edges.
void add_panels(const Polygon& polygon, std::vector<Panel>& panels) {
  const double smallest = 1e-9 * std::pow(diameter_of(polygon), 2);
  for (std::size_t k = 1; k + 1 < polygon.size(); k += 2) {
    Polygon piece{polygon[0], polygon[k], polygon[k + 1]};
    if (k + 2 < polygon.size()) piece.push_back(polygon[k + 2]);
    if (area_vector(piece).norm() > smallest) panels.push_back(make_panel(piece));
  }
}

}  // namespace

WettedBody make_wetted_body(const Hull& hull, const Pose& X_WB, const Vector3& p_BoR_B) {
  WettedBody body{hull.name(), {}, X_WB.apply(p_BoR_B)};
  const auto add = [&](const Polygon& polygon) {
    const Polygon below = cut_at_surface(polygon);
    const bool on_surface = std::all_of(below.begin(), below.end(),
                                        [](const Vector3& vertex) { return vertex.z() == 0.0; });
    if (below.size() >= 3 && !on_surface) add_panels(below, body.hull.panels);
  };
  for (int k = 0; k < hull.panel_count(); ++k) {
    Polygon polygon;
    for (const int vertex : hull.panel(k)) polygon.push_back(X_WB.apply(hull.vertex(vertex)));
    if (is_flat(polygon)) {
      add(polygon);
      continue;
    }
    for (std::size_t number = 0; number + 2 < polygon.size(); ++number) {
      add({polygon[0], polygon[number + 1], polygon[number + 2]});
    }
  }
  if (body.hull.panels.empty()) {
    throw ModelError("hull " + hull.name() + " is wholly above the water at z = 0: lower it first");
  }
  return body;
}

}  // namespace blocklift::dynamics
