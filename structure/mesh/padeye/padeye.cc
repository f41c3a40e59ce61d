#include "structure/mesh/padeye/padeye.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;

/// The edge of the main plate as seen from the middle of the hole: where each ray leaves the plate.
class Outline {
 public:
  explicit Outline(const PadeyeGeometry& padeye)
      : padeye_(padeye),
        left_(-padeye.base_left, -padeye.height),
        right_(padeye.base_right, -padeye.height),
        left_touch_(touching_point(left_, 1)),
        right_touch_(touching_point(right_, -1)) {}

  /// Angles of the corners, counter-clockwise from the left end of the base, within one turn.
  std::array<double, 5> corners() const {
    std::array<double, 5> angles = {angle(left_), angle(right_), angle(right_touch_),
                                    angle(left_touch_), angle(left_)};
    for (std::size_t i = 1; i < angles.size(); ++i)
      while (angles[i] <= angles[i - 1]) angles[i] += 2 * pi;
    return angles;
  }

  static bool is_straight(int side) { return side != 2; }

  /// The place where the ray leaves the plate, on a side (0 base, 1 right, 2 arc, 3 left).
  Vector2d place(int side, double angle) const {
    const Vector2d direction(std::cos(angle), std::sin(angle));
    switch (side) {
      case 0:
        return cut(direction, left_, right_);
      case 1:
        return cut(direction, right_, right_touch_);
      case 3:
        return cut(direction, left_touch_, left_);
      default:
        return padeye_.radius * direction;
    }
  }

 private:
  static double angle(const Vector2d& p) { return std::atan2(p.y(), p.x()); }

  // Where the tangent from a point touches the arc, turned from the point's direction by +-acos(R /
  // d).
  Vector2d touching_point(const Vector2d& from, int away_from_base) const {
    const double turn = -away_from_base * std::acos(padeye_.radius / from.norm());
    const double direction = angle(from) + turn;
    return padeye_.radius * Vector2d(std::cos(direction), std::sin(direction));
  }

  static Vector2d cut(const Vector2d& direction, const Vector2d& a, const Vector2d& b) {
    const Vector2d along = b - a;
    const double across = direction.x() * along.y() - direction.y() * along.x();
    return direction * ((a.x() * along.y() - a.y() * along.x()) / across);
  }

  PadeyeGeometry padeye_;
  Vector2d left_, right_, left_touch_, right_touch_;
};

/// A line of the plane mesh from the hole to the outline; radial as far as the hole is concerned.
struct Ray {
  double angle = 0;                 ///< at the hole
  Vector2d end = Vector2d::Zero();  ///< on the outline
};

/// Where lines at equal angles end on a side, from its first corner to its last. On a straight
/// side, which a slender plate shows to the hole at a small angle, they are moved half-way to equal
/// distances.
std::vector<Vector2d> side_ends(const Outline& outline, int side, double from, double to,
                                int count) {
  std::vector<Vector2d> ends;
  const Vector2d first = outline.place(side, from), last = outline.place(side, to);
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    const Vector2d by_angle = outline.place(side, from + (to - from) * share);
    const Vector2d by_length = first + share * (last - first);
    ends.push_back(Outline::is_straight(side) ? Vector2d((by_angle + by_length) / 2) : by_angle);
  }
  return ends;
}

/// Rays at whole numbers bound elements, those between at mid-edges: 2 x elements around. Mid-edges
/// lie in the middle, so that elements however long stay regular.
std::vector<Ray> make_rays(const Outline& outline, int divisions, int& base_elements) {
  const std::array<double, 5> corners = outline.corners();
  std::vector<Ray> rays;
  for (int side = 0; side < 4; ++side) {
    const double from = corners[side], to = corners[at(side) + 1];
    const int count =
        std::max(2, static_cast<int>(std::lround((to - from) / (2 * pi) * divisions)));
    if (side == 0) base_elements = count;
    const std::vector<Vector2d> ends = side_ends(outline, side, from, to, count);
    for (int half = 0; half < 2 * count; ++half) {
      const double angle = from + (to - from) * half / (2 * count);
      const Vector2d& end = ends[half / 2];
      const bool middle = half % 2 == 1;
      const Vector2d between = Outline::is_straight(side) ? Vector2d((end + ends[half / 2 + 1]) / 2)
                                                          : outline.place(side, angle);
      rays.push_back({angle, middle ? between : end});
    }
  }
  return rays;
}

/// Number of steps from 0 to 1 and their growth, so that the first is about `first` and each is up
/// to 1.25 times the last.
std::vector<double> graded(double length, double first) {
  constexpr double growth = 1.25;
  std::vector<double> steps{first};
  double sum = first;
  while (sum < length) {
    steps.push_back(steps.back() * growth);
    sum += steps.back();
  }
  if (steps.size() > 1 && sum - length > 0.5 * steps.back()) {
    sum -= steps.back();
    steps.pop_back();
  }
  std::vector<double> places{0};
  for (const double step : steps) places.push_back(places.back() + step / sum);
  places.back() = 1;
  return places;
}

/// One circle-like line of the plane mesh, as a share of the way from a circle to what lies outside
/// it.
struct Ring {
  bool within_inner =
      true;  ///< between hole and transition circle, else between it and the outline
  double share = 0;
};

class Mesher {
 public:
  Mesher(const PadeyeGeometry& padeye, int divisions) : padeye_(padeye) {
    const Outline outline(padeye);
    rays_ = make_rays(outline, divisions, base_elements_);
    make_rings();
    make_levels();
  }

  PadeyeMesh make() {
    for (int plate = 0; plate < 3; ++plate) add_plate(static_cast<PadeyePlate>(plate));
    return std::move(result_);
  }

 private:
  double hole() const { return padeye_.hole_diameter / 2; }
  int around() const { return static_cast<int>(rays_.size()) / 2; }

  void make_rings() {
    const double first = 2 * pi * hole() / around();
    double start = hole();
    if (padeye_.has_cheeks()) {
      for (const double share : graded(padeye_.cheek_radius - hole(), first))
        rings_.push_back({true, share});
      inner_rings_ = static_cast<int>(rings_.size()) - 1;
      start = padeye_.cheek_radius;
    } else {
      rings_.push_back({true, 0});
    }
    double farthest = 0;
    for (const Ray& ray : rays_) farthest = std::max(farthest, ray.end.norm());
    const double next = first * start / hole();
    const std::vector<double> shares = graded(farthest - start, next);
    for (std::size_t i = 1; i < shares.size(); ++i) rings_.push_back({false, shares[i]});
  }

  void make_levels() {
    const double size = 2 * pi * hole() / around();
    const auto layers = [&](double thickness) {
      return std::clamp(static_cast<int>(std::lround(thickness / (2 * size))), 1, 8);
    };
    main_layers_ = std::max(2, layers(padeye_.thickness));
    const double half = padeye_.thickness / 2;
    if (padeye_.has_cheeks()) cheek_layers_ = layers(padeye_.cheek_thickness);
    const auto add = [&](double from, double to, int count) {
      for (int i = 0; i < 2 * count; ++i) levels_.push_back(from + (to - from) * i / (2 * count));
    };
    if (cheek_layers_ > 0) add(-half - padeye_.cheek_thickness, -half, cheek_layers_);
    add(-half, half, main_layers_);
    if (cheek_layers_ > 0) add(half, half + padeye_.cheek_thickness, cheek_layers_);
    levels_.push_back(half + padeye_.cheek_thickness);
  }

  /// Places by half steps: ring in 0 .. 2 rings, ray in 0 .. 2 around - 1.
  Vector2d plane_place(int half_ring, int half_ray) const {
    const Ray& ray = rays_[half_ray % static_cast<int>(rays_.size())];
    const auto on_ring = [&](const Ring& ring) -> Vector2d {
      const Vector2d direction(std::cos(ray.angle), std::sin(ray.angle));
      const double circle = padeye_.has_cheeks() ? padeye_.cheek_radius : hole();
      if (ring.within_inner) return (hole() + ring.share * (circle - hole())) * direction;
      return circle * direction + ring.share * (ray.end - circle * direction);
    };
    Vector2d lower = on_ring(rings_[half_ring / 2]);
    if (half_ring % 2 == 0) return lower;
    return (lower + on_ring(rings_[half_ring / 2 + 1])) / 2;
  }

  std::size_t node(int half_ring, int half_ray, int half_level) {
    const int ray = half_ray % static_cast<int>(rays_.size());
    const auto [found, is_new] =
        nodes_.try_emplace({half_ring, ray, half_level}, nodes_.size() + 1);
    if (is_new) {
      const Vector2d p = plane_place(half_ring, ray);
      result_.mesh.nodes[found->second] = {p.x(), p.y(), levels_[half_level]};
    }
    return found->second;
  }

  // Abaqus' C3D20: corners of the lower face, of the upper one, middles of the lower face's edges,
  // of the upper one's, of the upright edges. First local axis along the rings, second along the
  // ray is left-handed with z, so rays come first.
  std::size_t add_element(int ring, int ray, int layer) {
    static constexpr std::array<std::array<int, 3>, 20> steps = {
        {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
         {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
         {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}};
    AbaqusElement element{result_.mesh.elements.size() + 1, {}};
    for (const auto& [r, t, z] : steps)
      element.nodes.push_back(node(2 * ring + r, 2 * ray + t, 2 * layer + z));
    // Faces by Abaqus' numbers: 3 lies at 0-1, 4 at 1-2 (outer ring), 5 at 2-3, 6 at 3-0 (inner
    // ring).
    constexpr int outer_face = 4, inner_face = 6;
    if (ring == 0) result_.mesh.surfaces["hole"].push_back({element.tag, inner_face});
    if (ring + 2 == static_cast<int>(rings_.size()) && ray < base_elements_)
      result_.mesh.surfaces["base"].push_back({element.tag, outer_face});
    result_.mesh.elements.push_back(element);
    return element.tag;
  }

  void add_plate(PadeyePlate plate) {
    const bool is_main = plate == PadeyePlate::main;
    if (!is_main && cheek_layers_ == 0) return;
    const int first = plate == PadeyePlate::cheek_back ? 0
                      : is_main                        ? cheek_layers_
                                                       : cheek_layers_ + main_layers_;
    const int layers = is_main ? main_layers_ : cheek_layers_;
    const int rings = is_main ? static_cast<int>(rings_.size()) - 1 : inner_rings_;
    for (int ring = 0; ring < rings; ++ring)
      for (int ray = 0; ray < around(); ++ray) {
        PadeyeMesh::Column column;
        column.plate = plate;
        column.corners = {plane_place(2 * ring, 2 * ray), plane_place(2 * ring + 2, 2 * ray),
                          plane_place(2 * ring + 2, 2 * ray + 2),
                          plane_place(2 * ring, 2 * ray + 2)};
        for (int layer = first; layer < first + layers; ++layer) {
          column.elements.push_back(add_element(ring, ray, layer));
          result_.mesh.element_sets[is_main ? "main" : "cheeks"].push_back(column.elements.back());
        }
        result_.columns.push_back(std::move(column));
      }
  }

  PadeyeGeometry padeye_;
  std::vector<Ray> rays_;
  int base_elements_ = 0;
  std::vector<Ring> rings_;
  int inner_rings_ = 0, main_layers_ = 0, cheek_layers_ = 0;
  std::vector<double> levels_;  ///< by half layers, z
  std::map<std::array<int, 3>, std::size_t> nodes_;
  PadeyeMesh result_;
};

}  // namespace

PadeyeMesh make_padeye_mesh(const PadeyeGeometry& padeye, int divisions) {
  const std::vector<std::string> faults = padeye_faults(padeye);
  if (!faults.empty()) throw ModelError(fmt::format("{}", fmt::join(faults, "; ")));
  if (divisions < 16)
    throw ModelError(
        fmt::format("a padeye of {} elements around its hole is too coarse; 16 are "
                    "due",
                    divisions));
  return Mesher(padeye, divisions).make();
}

}  // namespace blocklift::structure
