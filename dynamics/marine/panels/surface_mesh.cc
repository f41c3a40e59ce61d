#include "dynamics/marine/panels/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "dynamics/errors.h"
#include "dynamics/marine/panels/enclosed_surface.h"

namespace blocklift::dynamics {
namespace {

using Vector2 = Eigen::Vector2d;
/// Points with |n.p| <= offset on the left: n.p <= offset.
struct HalfPlane {
  Vector2 normal;
  double offset;
  double excess(const Vector2& p) const { return normal.dot(p) - offset; }
};

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  Vector2 from, to;
};

/// Nearest points of two polygons, a vertex of the first and a point of an edge of the second.
Nearest nearest_vertex_to_edge(const PlanePolygon& first, const PlanePolygon& second) {
  Nearest best;
  for (const Vector2& p : first) {
    for (std::size_t k = 0; k < second.size(); ++k) {
      const Vector2& a = second[k];
      const Vector2 ab = second[(k + 1) % second.size()] - a;
      const double s = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      const Vector2 q = a + s * ab;
      if ((p - q).norm() < best.distance) best = {(p - q).norm(), p, q};
    }
  }
  return best;
}

/// The half-plane of the first polygon: bounded half way to the second.
HalfPlane separate(const PlanePolygon& first, const PlanePolygon& second, double& gap) {
  Nearest nearest = nearest_vertex_to_edge(first, second);
  const Nearest other = nearest_vertex_to_edge(second, first);
  if (other.distance < nearest.distance) nearest = {other.distance, other.to, other.from};
  const bool overlap = contains(first, second[0]) || contains(second, first[0]);
  HalfPlane half;
  half.normal = (nearest.to - nearest.from).normalized();
  half.offset = half.normal.dot(0.5 * (nearest.from + nearest.to));
  const double tolerance = 1e-9 * (nearest.from.norm() + nearest.to.norm() + 1.0);
  const auto crosses = [&](const Vector2& p) { return half.excess(p) > tolerance; };
  const auto crosses_back = [&](const Vector2& p) { return half.excess(p) < -tolerance; };
  if (overlap || nearest.distance < tolerance || std::any_of(first.begin(), first.end(), crosses) ||
      std::any_of(second.begin(), second.end(), crosses_back)) {
    std::ostringstream message;
    message << "two water lines intersect or embrace each other near (" << nearest.from.x() << ", "
            << nearest.from.y()
            << ") m: a straight line must pass between each two bodies, or one of them float in an "
               "opening of the other";
    throw ModelError(message.str());
  }
  gap = std::min(gap, nearest.distance);
  return half;
}

/// A circle about a water line.
struct Circle {
  Vector2 centre;
  double radius;
};

Circle circle_about(const PlanePolygon& line) {
  Circle circle{centroid(line), 0.0};
  for (const Vector2& p : line) circle.radius = std::max(circle.radius, (p - circle.centre).norm());
  return circle;
}

/// Do no two of the circles meet?
bool are_apart(std::span<const Circle> circles) {
  for (std::size_t i = 0; i < circles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (circles[i].centre - circles[j].centre).norm();
      if (!(distance > circles[i].radius + circles[j].radius)) return false;
    }
  }
  return true;
}

/// The half-plane of the first circle, bounded by the radical axis of both: the points from which
/// tangents to both are equally long.
HalfPlane separate_circles(const Circle& first, const Circle& second) {
  const Vector2 between = second.centre - first.centre;
  const double distance = between.norm();
  const double along = 0.5 * distance + 0.5 * (first.radius - second.radius) *
                                            (first.radius + second.radius) / distance;
  HalfPlane half;
  half.normal = between / distance;
  half.offset = half.normal.dot(first.centre) + along;
  return half;
}

class SurfaceMesher {
 public:
  SurfaceMesher(std::span<const WaterLine> lines, const SurfaceMeshSettings& settings);
  SurfaceMesh make();
  double outer_area() const { return outer_area_; }

 private:
  struct Body {
    PlanePolygon line;
    Vector2 centre;
    std::vector<HalfPlane> region;
    double gap = std::numeric_limits<double>::infinity();
  };
  /// Where a ray leaves its body's region.
  struct RayEnd {
    Vector2 p;
    bool on_circle;  ///< on the common circle, or half way to another body
  };

  void divide_between_bodies();
  void mesh_body(const Body& body);
  std::vector<double> ray_angles(const Body& body) const;
  RayEnd shoot(const Body& body, const Vector2& from, double angle) const;
  std::vector<RayEnd> find_corners(const Body& body) const;
  std::vector<RayEnd> find_ends(const Body& body, const PlanePolygon& from) const;
  void add_rings(const Vector2& a, const Vector2& b, const Vector2& a_end, const Vector2& b_end,
                 const std::vector<double>& edges) {
    add_surface_rings({a, b}, {a_end, b_end}, edges, tolerance(), panels_);
  }
  /// Points nearer than this are one, m.
  double tolerance() const { return 1e-9 * settings_.first_ring; }
  RingWidths widths_at(const PlanePolygon& line) const;
  void add_outer_rings();

  SurfaceMeshSettings settings_;
  std::vector<Body> bodies_;
  std::vector<EnclosedSurface> enclosed_;
  Vector2 centre_ = Vector2::Zero();
  double inner_radius_ = 0.0;   ///< holds the bodies
  double common_radius_ = 0.0;  ///< from here on the rings are common
  PlanePolygon common_edge_;
  double outer_area_ = 0.0;  ///< of the polygon that the outer edge is, m2
  std::vector<Panel> panels_;
};

SurfaceMesher::SurfaceMesher(std::span<const WaterLine> lines, const SurfaceMeshSettings& settings)
    : settings_(settings) {
  if (!(settings.first_ring > 0.0) || !(settings.growth >= 1.0) || !(settings.growth < 2.0) ||
      !(settings.edge_share >= 0.0) || !(settings.edge_growth >= 1.0)) {
    throw ModelError(
        "the surface mesh needs a positive first ring and a growth from 1 to 2; they are " +
        std::to_string(settings.first_ring) + " m and " + std::to_string(settings.growth));
  }
  Vector2 low = Vector2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  SortedWaterLines sorted = sort_water_lines(lines);
  enclosed_ = std::move(sorted.enclosed);
  for (PlanePolygon& line : sorted.outer) {
    Body body{std::move(line), {}, {}};
    body.centre = centroid(body.line);
    for (const Vector2& p : body.line) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    bodies_.push_back(std::move(body));
  }
  centre_ = 0.5 * (low + high);
  if (centre_.norm() < 1e-9 * (high - low).norm()) centre_.setZero();
  for (const Body& body : bodies_) {
    for (const Vector2& p : body.line)
      inner_radius_ = std::max(inner_radius_, (p - centre_).norm());
  }
  divide_between_bodies();
  if (!(settings.radius > 1.5 * inner_radius_)) {
    throw ModelError("the surface mesh ends at " + std::to_string(settings.radius) +
                     " m, but the bodies reach " + std::to_string(inner_radius_) +
                     " m: its radius must be at least one and a half times as large");
  }
  common_radius_ = bodies_.size() == 1 ? settings.radius : 1.35 * inner_radius_;
}

/// Half way between each two bodies. Lines that lie half way need not meet in points where three
/// bodies do, as the columns of a platform: something is left out or covered twice. Radical axes
/// do meet, and divide the plane if circles about the water lines are apart (Aurenhammer 1987).
void SurfaceMesher::divide_between_bodies() {
  std::vector<Circle> circles;
  for (const Body& body : bodies_) circles.push_back(circle_about(body.line));
  const bool by_circles = bodies_.size() > 2 && are_apart(circles);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    for (std::size_t j = 0; j < bodies_.size(); ++j) {
      if (i == j) continue;
      body.region.push_back(separate(body.line, bodies_[j].line, body.gap));
      if (!by_circles) continue;
      const HalfPlane& half = body.region.back() = separate_circles(circles[i], circles[j]);
      for (const Vector2& p : body.line) body.gap = std::min(body.gap, -2.0 * half.excess(p));
    }
  }
}

/// Directions (rad) of the rays from the vertices of a water line: evenly fanned out over the whole
/// circle, turned by the mean difference from the directions in which the vertices lie.
std::vector<double> SurfaceMesher::ray_angles(const Body& body) const {
  const double spacing = 2.0 * std::numbers::pi / static_cast<double>(body.line.size());
  double sine = 0.0, cosine = 0.0;
  for (std::size_t k = 0; k < body.line.size(); ++k) {
    const Vector2 r = body.line[k] - body.centre;
    const double difference = std::atan2(r.y(), r.x()) - spacing * static_cast<double>(k);
    sine += std::sin(difference);
    cosine += std::cos(difference);
  }
  std::vector<double> angles;
  for (std::size_t k = 0; k < body.line.size(); ++k) {
    angles.push_back(std::atan2(sine, cosine) + spacing * static_cast<double>(k));
  }
  return angles;
}

SurfaceMesher::RayEnd SurfaceMesher::shoot(const Body& body, const Vector2& from,
                                           double angle) const {
  const Vector2 direction(std::cos(angle), std::sin(angle));
  const Vector2 r = from - centre_;
  const double along = r.dot(direction);
  double distance =
      -along + std::sqrt(along * along + common_radius_ * common_radius_ - r.squaredNorm());
  bool on_circle = true;
  for (const HalfPlane& cut : body.region) {
    const double rate = cut.normal.dot(direction);
    if (rate > 0.0 && -cut.excess(from) < rate * distance) {
      distance = -cut.excess(from) / rate;
      on_circle = false;
    }
  }
  return {from + distance * direction, on_circle};
}

/// Corners of the body's region: where two of its limits meet.
std::vector<SurfaceMesher::RayEnd> SurfaceMesher::find_corners(const Body& body) const {
  std::vector<RayEnd> corners;
  const auto keep_if_inside = [&](const Vector2& p, bool on_circle) {
    const double tolerance = 1e-9 * common_radius_;
    const bool outside = std::any_of(body.region.begin(), body.region.end(),
                                     [&](const auto& cut) { return cut.excess(p) > tolerance; });
    const bool known = std::any_of(corners.begin(), corners.end(), [&](const RayEnd& corner) {
      return (corner.p - p).norm() < tolerance;
    });
    if (!outside && !known && (p - centre_).norm() < common_radius_ + tolerance) {
      corners.push_back({p, on_circle});
    }
  };
  for (std::size_t i = 0; i < body.region.size(); ++i) {
    const HalfPlane& cut = body.region[i];
    const Vector2 along(-cut.normal.y(), cut.normal.x());
    const double distance = -cut.excess(centre_);
    if (std::abs(distance) < common_radius_) {
      const double half_chord = std::sqrt(common_radius_ * common_radius_ - distance * distance);
      for (const double side : {-half_chord, half_chord}) {
        keep_if_inside(centre_ + distance * cut.normal + side * along, true);
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      const HalfPlane& other = body.region[j];
      const double slope = other.normal.dot(along);
      if (std::abs(slope) < 1e-9) continue;
      const Vector2 foot = cut.offset * cut.normal;
      keep_if_inside(foot - other.excess(foot) / slope * along, false);
    }
  }
  return corners;
}

/// Ends of the rays at the edge of the body's region; the ray that points best to a
/// corner is led there.
std::vector<SurfaceMesher::RayEnd> SurfaceMesher::find_ends(const Body& body,
                                                            const PlanePolygon& from) const {
  const std::vector<double> angles = ray_angles(body);
  std::vector<RayEnd> ends;
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (body.region.empty()) {  // alone: evenly around the circle
      const Vector2 direction(std::cos(angles[k]), std::sin(angles[k]));
      ends.push_back({centre_ + common_radius_ * direction, true});
    } else {
      ends.push_back(shoot(body, from[k], angles[k]));
    }
  }
  std::vector<bool> taken(ends.size(), false);
  for (const RayEnd& corner : find_corners(body)) {
    std::size_t best = ends.size();
    double best_cosine = -2.0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const Vector2 direction(std::cos(angles[k]), std::sin(angles[k]));
      const double cosine = direction.dot((corner.p - from[k]).normalized());
      if (taken[k] || cosine < best_cosine + 1e-9) continue;
      best_cosine = cosine;
      best = k;
    }
    if (best == ends.size()) throw ModelError("a water line has fewer vertices than its region");
    ends[best] = corner;
    taken[best] = true;
  }
  return ends;
}

RingWidths SurfaceMesher::widths_at(const PlanePolygon& line) const {
  double length = 0.0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    length += (line[(k + 1) % line.size()] - line[k]).norm();
  }
  const double edge = length / static_cast<double>(line.size());
  RingWidths widths{settings_.first_ring, settings_.first_ring, settings_.edge_growth,
                    settings_.growth};
  if (settings_.edge_share > 0.0) {
    widths.slow_from = std::min(settings_.first_ring, edge);
    widths.width = std::min(settings_.first_ring, settings_.edge_share * edge);
  }
  return widths;
}

void SurfaceMesher::mesh_body(const Body& body) {
  const std::size_t count = body.line.size();
  // Square off the water line as far as a quarter of the body's size or most of the half gap.
  double size = 0.0;
  for (const Vector2& p : body.line) size = std::max(size, (p - body.centre).norm());
  const double reach = std::min(0.25 * size, 0.3 * body.gap);
  RingWidths widths = widths_at(body.line);
  widths.width = std::min(widths.width, reach);
  const std::vector<double> near_edges = ring_edges(reach, widths);
  PlanePolygon offset(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2 before = (body.line[k] - body.line[(k + count - 1) % count]).normalized();
    const Vector2 after = (body.line[(k + 1) % count] - body.line[k]).normalized();
    const Vector2 sum = before + after;
    const Vector2 normal(sum.y(), -sum.x());
    offset[k] = body.line[k] + 2.0 * reach / normal.squaredNorm() * normal;
  }
  const std::vector<RayEnd> ends = find_ends(body, offset);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    add_rings(body.line[k], body.line[next], offset[k], offset[next], near_edges);
    const double distance =
        0.5 * ((ends[k].p - offset[k]).norm() + (ends[next].p - offset[next]).norm());
    RingWidths further = widths;
    add_rings(offset[k], offset[next], ends[k].p, ends[next].p, ring_edges(distance, further));
    if (ends[k].on_circle) common_edge_.push_back(ends[k].p);
  }
}

/// Rings beyond the common circle, on the rays that reach it.
void SurfaceMesher::add_outer_rings() {
  const auto angle = [&](const Vector2& p) {
    return std::atan2(p.y() - centre_.y(), p.x() - centre_.x());
  };
  std::sort(common_edge_.begin(), common_edge_.end(),
            [&](const Vector2& a, const Vector2& b) { return angle(a) < angle(b); });
  const double tolerance = 1e-7 * common_radius_;
  PlanePolygon edge;
  for (const Vector2& p : common_edge_) {
    if (edge.empty() || (p - edge.back()).norm() > tolerance) edge.push_back(p);
  }
  if ((edge.front() - edge.back()).norm() < tolerance) edge.pop_back();
  const double first = std::max(settings_.first_ring, 2.0 * std::numbers::pi * common_radius_ /
                                                          static_cast<double>(edge.size()));
  RingWidths widths{first, first, settings_.growth, settings_.growth};
  const std::vector<double> edges = ring_edges(settings_.radius - common_radius_, widths);
  const double ratio = settings_.radius / common_radius_;
  for (std::size_t k = 0; k < edge.size(); ++k) {
    outer_area_ +=
        0.5 * ratio * ratio * cross(edge[k] - centre_, edge[(k + 1) % edge.size()] - centre_);
  }
  if (!(settings_.radius > common_radius_)) return;
  for (std::size_t k = 0; k < edge.size(); ++k) {
    const Vector2 &a = edge[k], &b = edge[(k + 1) % edge.size()];
    add_rings(a, b, centre_ + ratio * (a - centre_), centre_ + ratio * (b - centre_), edges);
  }
}

SurfaceMesh SurfaceMesher::make() {
  for (const Body& body : bodies_) mesh_body(body);
  add_outer_rings();
  for (const EnclosedSurface& water : enclosed_) {
    mesh_enclosed_surface(
        water, [&](const PlanePolygon& line) { return widths_at(line); }, tolerance(), panels_);
  }
  SurfaceMesh surface;
  surface.mesh = make_panel_mesh(std::move(panels_));
  surface.centre = Vector3(centre_.x(), centre_.y(), 0.0);
  surface.inner_radius = inner_radius_;
  surface.outer_radius = settings_.radius;
  return surface;
}

}  // namespace

SurfaceMeshSettings surface_settings(std::span<const WaterLine> water_lines, double shortest_wave,
                                     double longest_wave) {
  if (!(shortest_wave > 0.0) || !(longest_wave >= shortest_wave)) {
    throw ModelError("the surface mesh is asked for waves from " + std::to_string(shortest_wave) +
                     " m to " + std::to_string(longest_wave) +
                     " m: lengths must be positive and in this order");
  }
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double smallest = std::numeric_limits<double>::infinity();
  for (const WaterLine& line : water_lines) {
    for (const Vector3& p : line) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    smallest = std::min(smallest, std::sqrt(std::abs(enclosed_area(line)) / std::numbers::pi));
  }
  SurfaceMeshSettings settings;
  settings.first_ring = std::max(shortest_wave / 15.0, 0.06 * smallest);
  settings.radius = std::max(0.5 * (high - low).norm() + 1.4 * longest_wave,
                             0.8 * (high - low).norm() + longest_wave);
  settings.edge_share = 0.25;
  // Slower growth costs a tenth more panels and halves an error that is a hundredth already.
  settings.edge_growth = 1.7;
  return settings;
}

SurfaceMesh make_surface_mesh(std::span<const WaterLine> water_lines,
                              const SurfaceMeshSettings& settings) {
  if (water_lines.empty()) return {{}, Vector3::Zero(), 0.0, 0.0};
  SurfaceMesher mesher(water_lines, settings);
  SurfaceMesh surface = mesher.make();
  // The panels must cover the outer polygon less the water lines, once.
  double covered = surface.mesh.total_area();
  for (const WaterLine& line : water_lines) covered += enclosed_area(line);
  if (std::abs(covered - mesher.outer_area()) > 1e-6 * std::abs(enclosed_area(water_lines[0]))) {
    throw ModelError(
        "the regions half way between the bodies do not fill the surface: " +
        std::to_string(covered) + " m2 of " + std::to_string(mesher.outer_area()) +
        " m2 are covered; place three or more bodies in a row, or compute them in groups");
  }
  return surface;
}

}  // namespace blocklift::dynamics
