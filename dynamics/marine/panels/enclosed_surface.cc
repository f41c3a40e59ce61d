#include "dynamics/marine/panels/enclosed_surface.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr std::size_t nothing = static_cast<std::size_t>(-1);

/// The smallest of the lines that hold a line; `nothing` in the open water.
std::size_t find_holder(std::span<const WaterLine> lines, std::size_t line) {
  const PlanePolygon polygon = to_polygon(lines[line]);
  std::size_t holder = nothing;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (k == line || !contains(to_polygon(lines[k]), polygon[0])) continue;
    if (holder == nothing ||
        std::abs(enclosed_area(lines[k])) < std::abs(enclosed_area(lines[holder]))) {
      holder = k;
    }
  }
  return holder;
}

std::string place_text(const Vector2& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ") m";
  return text.str();
}

/// Directions of a line's vertices about a point, each beyond the one before.
std::vector<double> directions_of(const PlanePolygon& line, const Vector2& middle) {
  std::vector<double> directions;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vector2 r = line[k] - middle, next = line[(k + 1) % line.size()] - middle;
    if (!(cross(r, next) > 0.0)) {
      throw ModelError("the edge of enclosed water at " + place_text(line[k]) +
                       " cannot be seen from its middle, " + place_text(middle) +
                       ": an opening, and what floats in it, must not be hollow");
    }
    directions.push_back(std::atan2(r.y(), r.x()));
  }
  return directions;
}

/// Where a ray from the middle meets a star-shaped line.
Vector2 meet(const PlanePolygon& line, const Vector2& middle, double direction) {
  const Vector2 along(std::cos(direction), std::sin(direction));
  Vector2 best = middle;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vector2 a = line[k] - middle, edge = line[(k + 1) % line.size()] - line[k];
    const double share = std::clamp(-cross(a, along) / cross(edge, along), 0.0, 1.0);
    const Vector2 p = a + share * edge;
    // Of rounding's making is what the nearest edge misses the ray by.
    const double miss = std::abs(cross(along, p));
    if (!std::isfinite(share) || p.dot(along) <= 0.0 || miss >= nearest) continue;
    nearest = miss;
    best = middle + p;
  }
  return best;
}

/// Directions of the rays: through every vertex of both lines.
std::vector<double> ray_directions(const EnclosedSurface& surface, const Vector2& middle) {
  std::vector<double> directions = directions_of(surface.opening, middle);
  if (!surface.inner.empty()) {
    const std::vector<double> more = directions_of(surface.inner, middle);
    directions.insert(directions.end(), more.begin(), more.end());
  }
  std::sort(directions.begin(), directions.end());
  const auto same = [](double a, double b) { return b - a < 1e-8; };
  directions.erase(std::unique(directions.begin(), directions.end(), same), directions.end());
  if (directions.front() + 2.0 * std::numbers::pi - directions.back() < 1e-8) directions.pop_back();
  return directions;
}

/// Rings from the opening inwards: shares of the way to the middle, or from both sides to half way.
std::vector<double> shares_of(double distance, RingWidths outer, const RingWidths* inner) {
  if (inner == nullptr) {
    outer.width = std::min(outer.width, 0.5 * distance);
    return ring_edges(distance, outer);
  }
  const double half = 0.5 * distance;
  RingWidths other = *inner;
  outer.width = std::min(outer.width, half);
  other.width = std::min(other.width, half);
  std::vector<double> shares;
  for (const double edge : ring_edges(half, outer)) shares.push_back(0.5 * edge);
  const std::vector<double> back = ring_edges(half, other);
  for (std::size_t k = back.size() - 1; k-- > 0;) shares.push_back(1.0 - 0.5 * back[k]);
  return shares;
}

}  // namespace

SortedWaterLines sort_water_lines(std::span<const WaterLine> lines) {
  SortedWaterLines sorted;
  std::vector<std::size_t> place(lines.size(), nothing);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (enclosed_area(lines[k]) > 0.0) continue;
    place[k] = sorted.enclosed.size();
    PlanePolygon opening = to_polygon(lines[k]);
    std::reverse(opening.begin(), opening.end());
    sorted.enclosed.push_back({std::move(opening), {}});
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (place[k] != nothing) continue;
    PlanePolygon polygon = to_polygon(lines[k]);
    const std::size_t holder = find_holder(lines, k);
    if (holder == nothing || place[holder] == nothing) {
      sorted.outer.push_back(std::move(polygon));
      continue;
    }
    PlanePolygon& inner = sorted.enclosed[place[holder]].inner;
    if (!inner.empty()) {
      throw ModelError("two bodies float in one opening, near " + place_text(inner[0]) + " and " +
                       place_text(polygon[0]) + ": one is possible");
    }
    inner = std::move(polygon);
  }
  return sorted;
}

void mesh_enclosed_surface(const EnclosedSurface& surface,
                           const std::function<RingWidths(const PlanePolygon&)>& widths_at,
                           double tolerance, std::vector<Panel>& panels) {
  const bool is_empty = surface.inner.empty();
  const Vector2 middle = centroid(is_empty ? surface.opening : surface.inner);
  std::vector<std::array<Vector2, 2>> rays;  // opening, then inner line or middle
  double distance = 0.0;
  for (const double direction : ray_directions(surface, middle)) {
    const Vector2 from = meet(surface.opening, middle, direction);
    const Vector2 to = is_empty ? middle : meet(surface.inner, middle, direction);
    if (!((from - middle).norm() > (to - middle).norm() + tolerance)) {
      throw ModelError("two water lines intersect or embrace each other near " + place_text(to));
    }
    distance += (from - to).norm();
    rays.push_back({from, to});
  }
  distance /= static_cast<double>(rays.size());
  const RingWidths outer = widths_at(surface.opening);
  std::vector<double> shares;
  if (is_empty) {
    shares = shares_of(distance, outer, nullptr);
  } else {
    const RingWidths inner = widths_at(surface.inner);
    shares = shares_of(distance, outer, &inner);
  }
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const auto &ray = rays[k], &next = rays[(k + 1) % rays.size()];
    // Rings run from the outside in: the next ray's points come first to run counter-clockwise.
    add_surface_rings({next[0], ray[0]}, {next[1], ray[1]}, shares, tolerance, panels);
  }
}

}  // namespace blocklift::dynamics
