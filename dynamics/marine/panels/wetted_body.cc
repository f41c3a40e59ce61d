#include "dynamics/marine/panels/wetted_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

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

/// Do the vertices lie in a plane, to a share of the polygon's size?
bool is_flat(const Polygon& polygon, double share) {
  const Vector3 normal = area_vector(polygon).normalized();
  const double tolerance = share * diameter_of(polygon);
  return std::all_of(polygon.begin(), polygon.end(), [&](const Vector3& vertex) {
    return std::abs(normal.dot(vertex - polygon[0])) < tolerance;
  });
}

/// The hull's vertices in the world. One nearer to the surface than a thousandth of the smallest
/// panel that it belongs to lies on it, for all of its panels alike.
Polygon vertices_in_world(const Hull& hull, const Pose& X_WB) {
  std::vector<double> size(hull.vertices().size(), std::numeric_limits<double>::infinity());
  for (int k = 0; k < hull.panel_count(); ++k) {
    const double diameter = hull.panel_diameter(k);
    for (const int vertex : hull.panel(k)) {
      double& smallest = size[vertex];
      smallest = std::min(smallest, diameter);
    }
  }
  Polygon vertices;
  for (std::size_t v = 0; v < size.size(); ++v) {
    vertices.push_back(X_WB.apply(hull.vertices()[v]));
    if (std::abs(vertices[v].z()) < 1e-3 * size[v]) vertices[v].z() = 0.0;
  }
  return vertices;
}

/// The part at z <= 0, by Sutherland and Hodgman.
Polygon cut_at_surface(const Polygon& polygon) {
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

bool touches_surface(const Polygon& polygon) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [](const Vector3& vertex) { return vertex.z() == 0.0; });
}

/// Quadrangles and at the end a triangle between the first vertex and the edges. At the water line
/// vertices must stay where they are: a quadrangle there that is not flat becomes two triangles.
void add_panels(const Polygon& polygon, std::vector<Panel>& panels) {
  const double smallest = 1e-9 * std::pow(diameter_of(polygon), 2);
  for (std::size_t k = 1; k + 1 < polygon.size(); k += 2) {
    Polygon piece{polygon[0], polygon[k], polygon[k + 1]};
    if (k + 2 < polygon.size()) piece.push_back(polygon[k + 2]);
    if (piece.size() == 4 && touches_surface(piece) && !is_flat(piece, 1e-9)) {
      const Polygon rest{piece[0], piece[2], piece[3]};
      if (area_vector(rest).norm() > smallest) panels.push_back(make_panel(rest));
      piece.pop_back();
    }
    if (area_vector(piece).norm() > smallest) panels.push_back(make_panel(piece));
  }
}

/// One polygon among those of a hull.
struct Face {
  const Polygon* polygon;
  Vector3 mean, area;
  bool is_kept = true;
};

/// Do two faces cover the same place, one from either side?
bool are_opposite(const Face& a, const Face& b, double tolerance) {
  return (a.mean - b.mean).norm() < tolerance && (a.area + b.area).norm() < 1e-6 * a.area.norm();
}

/// Where a hull has no thickness, as at a ship's stem in the centre plane, its two sides lie on
/// each other. No water is kept out between them, and no panel method can tell their potentials
/// apart: both go.
std::vector<Polygon> without_sheets(const std::vector<Polygon>& polygons) {
  std::vector<Face> faces;
  for (const Polygon& polygon : polygons) {
    const Vector3 sum = std::accumulate(polygon.begin(), polygon.end(), Vector3(0.0, 0.0, 0.0));
    faces.push_back({&polygon, sum / static_cast<double>(polygon.size()), area_vector(polygon)});
  }
  std::vector<Face*> ordered;
  for (Face& face : faces) ordered.push_back(&face);
  std::sort(ordered.begin(), ordered.end(),
            [](const Face* a, const Face* b) { return a->mean.x() < b->mean.x(); });
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    Face& face = *ordered[i];
    const double tolerance = 1e-6 * diameter_of(*face.polygon);
    for (std::size_t j = i + 1; face.is_kept && j < ordered.size(); ++j) {
      Face& other = *ordered[j];
      if (other.mean.x() - face.mean.x() > tolerance) break;
      if (other.is_kept && are_opposite(face, other, tolerance)) {
        face.is_kept = other.is_kept = false;
      }
    }
  }
  std::vector<Polygon> kept;
  for (const Face& face : faces) {
    if (face.is_kept) kept.push_back(*face.polygon);
  }
  return kept;
}

}  // namespace

WettedBody make_wetted_body(const Hull& hull, const Pose& X_WB, const Vector3& p_BoR_B) {
  WettedBody body{hull.name(), {}, X_WB.apply(p_BoR_B)};
  std::vector<Polygon> wet;
  const auto add = [&](const Polygon& polygon) {
    const Polygon below = cut_at_surface(polygon);
    const bool on_surface = std::all_of(below.begin(), below.end(),
                                        [](const Vector3& vertex) { return vertex.z() == 0.0; });
    if (below.size() >= 3 && !on_surface) wet.push_back(below);
  };
  const Polygon vertices = vertices_in_world(hull, X_WB);
  for (int k = 0; k < hull.panel_count(); ++k) {
    Polygon polygon;
    for (const int vertex : hull.panel(k)) {
      polygon.push_back(vertices[vertex]);
    }
    if (is_flat(polygon, 0.01)) {
      add(polygon);
      continue;
    }
    for (std::size_t number = 0; number + 2 < polygon.size(); ++number) {
      add({polygon[0], polygon[number + 1], polygon[number + 2]});
    }
  }
  for (const Polygon& polygon : without_sheets(wet)) add_panels(polygon, body.hull.panels);
  if (body.hull.panels.empty()) {
    throw ModelError("hull " + hull.name() + " is wholly above the water at z = 0: lower it first");
  }
  return body;
}

}  // namespace blocklift::dynamics
