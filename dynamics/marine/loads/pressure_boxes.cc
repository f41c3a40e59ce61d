#include "dynamics/marine/loads/pressure_boxes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blocklift::dynamics {
namespace {

constexpr std::size_t most_on_a_side = 16;

/// What is left of each component of a sea at a depth below the surface, by its amplitude, over the
/// root of the sum of all amplitudes' squares.
std::vector<double> find_shares(const WaveField& waves, double depth) {
  const double bottom = waves.water().depth;
  std::vector<double> shares;
  double energy = 0.0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    const double k = waves.wave_number(c);
    const double image = std::exp(-2.0 * k * std::max(0.0, bottom - depth));
    const double left = std::exp(-k * depth) * (1.0 + image) / (1.0 + std::exp(-2.0 * k * bottom));
    const double amplitude = waves.component(c).amplitude;
    shares.push_back(left * amplitude);
    energy += amplitude * amplitude;
  }
  for (double& share : shares) share = energy > 0.0 ? share / std::sqrt(energy) : 0.0;
  return shares;
}

/// Points along a side of a box that reaches `reach` to each side of its middle.
std::size_t points_needed(const WaveField& waves, const std::vector<double>& shares, double reach,
                          double tolerance) {
  if (reach == 0.0) return 1;
  for (std::size_t n = 2; n < most_on_a_side; ++n) {
    double error = 0.0;
    for (std::size_t c = 0; c < waves.component_count(); ++c) {
      const double half = 0.5 * waves.wave_number(c) * reach;
      const double order = static_cast<double>(n);
      const double share = 2.0 * std::exp(order * std::log(half) - std::lgamma(order + 1.0));
      error += std::pow(shares[c] * std::min(1.0, share), 2);
    }
    if (error <= tolerance * tolerance) return n;
  }
  return most_on_a_side;
}

/// Chebyshev's points between -1 and 1, and the polynomials that are 1 at one and 0 at the others.
class Side {
 public:
  explicit Side(std::size_t count) : points_(count, 0.0) {
    for (std::size_t j = 0; count > 1 && j < count; ++j) {
      points_[j] = std::cos(std::numbers::pi * (2.0 * static_cast<double>(j) + 1.0) /
                            (2.0 * static_cast<double>(count)));
    }
  }
  std::size_t count() const { return points_.size(); }
  double point(std::size_t j) const { return points_[j]; }
  double basis(std::size_t j, double s) const {
    double value = 1.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i != j) value *= (s - points_[i]) / (points_[j] - points_[i]);
    }
    return value;
  }

 private:
  std::vector<double> points_;
};

// Points of a triangle by their barycentric coordinates (a, b, b) and its turns, with weights:
// exact to the fifth degree (Radon 1948).
struct TrianglePoint {
  std::array<double, 3> share;
  double weight;
};
std::array<TrianglePoint, 7> radon_points() {
  const double root = std::sqrt(15.0);
  std::array<TrianglePoint, 7> points;
  points[0] = {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, 9.0 / 40.0};
  for (std::size_t k = 0; k < 2; ++k) {
    const double sign = k == 0 ? -1.0 : 1.0;
    const double b = (6.0 + sign * root) / 21.0;
    const double weight = (155.0 + sign * root) / 1200.0;
    for (std::size_t i = 0; i < 3; ++i) {
      TrianglePoint& point = points[1 + 3 * k + i];
      point.share = {b, b, b};
      point.share[i] = 1.0 - 2.0 * b;
      point.weight = weight;
    }
  }
  return points;
}

}  // namespace

struct PressureBoxes::Grid {
  std::array<Side, 3> sides;
  std::size_t size() const { return sides[0].count() * sides[1].count() * sides[2].count(); }
};

PressureBoxes::PressureBoxes(const TriangleTree& tree, const WaveField& waves, double tolerance,
                             std::size_t per_triangle)
    : node_count_(static_cast<std::size_t>(tree.node_count())), depths_{0.0} {
  add_level(tree, waves, tolerance, per_triangle);
  double shortest = 0.0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    shortest = std::max(shortest, waves.wave_number(c));
  }
  const double deepest = 4.0 * tree.node(TriangleTree::root).half_extent.z();
  for (double depth = 1.0 / shortest; depth <= deepest; depth *= 2.0) {
    depths_.push_back(depth);
    add_level(tree, waves, tolerance, per_triangle);
  }
}

void PressureBoxes::add_level(const TriangleTree& tree, const WaveField& waves, double tolerance,
                              std::size_t per_triangle) {
  const std::vector<double> shares = find_shares(waves, depths_.back());
  std::vector<std::size_t> cost(node_count_, 0);
  const std::size_t first = places_.size();
  places_.resize(first + node_count_);
  // Children stand behind their parents.
  for (int node = tree.node_count() - 1; node >= 0; --node) {
    const TriangleTree::Node& box = tree.node(node);
    const auto i = static_cast<std::size_t>(node);
    const auto needed = [&](Eigen::Index axis) {
      return Side(points_needed(waves, shares, box.half_extent[axis], tolerance));
    };
    const Grid grid{{needed(0), needed(1), needed(2)}};
    std::size_t& least = cost[i];
    if (!box.is_leaf()) {
      least = cost[box.left] + cost[box.right];
    } else if (per_triangle > 0) {
      least = per_triangle * static_cast<std::size_t>(box.triangle_count);
    } else {
      least = static_cast<std::size_t>(box.point_count);
    }
    if (grid.size() > std::min(least, WaveField::most_points)) continue;
    least = grid.size();
    places_[first + i] = add_box(tree, node, grid);
  }
}

PressureBoxes::Place PressureBoxes::add_box(const TriangleTree& tree, int node, const Grid& grid) {
  static const std::array<TrianglePoint, 7> rule = radon_points();
  const TriangleTree::Node& box = tree.node(node);
  const Side& sx = grid.sides[0];
  const Side& sy = grid.sides[1];
  const Side& sz = grid.sides[2];
  const std::size_t first = points_.size();
  for (std::size_t i = 0; i < sx.count(); ++i) {
    for (std::size_t j = 0; j < sy.count(); ++j) {
      for (std::size_t k = 0; k < sz.count(); ++k) {
        const Vector3 place(sx.point(i), sy.point(j), sz.point(k));
        points_.emplace_back(box.centre + box.half_extent.cwiseProduct(place));
      }
    }
  }
  weights_.resize(points_.size(), Weight::Zero());
  const Vector3 scale = (box.half_extent.array() > 0.0).select(box.half_extent.cwiseInverse(), 0.0);
  const auto add = [&](const Vector3& p, const Vector3& area) {
    Weight at_p;
    at_p << -p.cross(area), -area;
    const Vector3 s = (p - box.centre).cwiseProduct(scale);
    std::size_t point = first;
    for (std::size_t i = 0; i < sx.count(); ++i) {
      const double by_x = sx.basis(i, s.x());
      for (std::size_t j = 0; j < sy.count(); ++j) {
        const double by_xy = by_x * sy.basis(j, s.y());
        for (std::size_t k = 0; k < sz.count(); ++k) {
          weights_[point++] += by_xy * sz.basis(k, s.z()) * at_p;
        }
      }
    }
  };
  tree.visit([](const TriangleTree::Node&, int) { return true; },
             [&](const TriangleTree::Node& leaf) {
               const std::span<const Vector3> points = tree.points(leaf);
               for (const TriangleTree::Triangle& triangle : tree.triangles(leaf)) {
                 const auto [a, b, c] = triangle.corners;
                 for (const TrianglePoint& point : rule) {
                   const auto& [u, v, w] = point.share;
                   add(u * points[a] + v * points[b] + w * points[c], point.weight * triangle.area);
                 }
               }
             },
             node);
  return {first, grid.size()};
}

}  // namespace blocklift::dynamics
