#include "dynamics/marine/panels/plane_polygon.h"

namespace blocklift::dynamics {

using Vector2 = Eigen::Vector2d;

PlanePolygon to_polygon(const WaterLine& line) {
  PlanePolygon polygon;
  for (const Vector3& p : line) polygon.emplace_back(p.x(), p.y());
  return polygon;
}

Vector2 centroid(const PlanePolygon& polygon) {
  Vector2 sum = Vector2::Zero();
  double doubled = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    sum += cross(a, b) * (a + b);
    doubled += cross(a, b);
  }
  return sum / (3.0 * doubled);
}

bool contains(const PlanePolygon& polygon, const Vector2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace blocklift::dynamics
