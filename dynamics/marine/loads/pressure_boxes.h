#pragma once

#include "dynamics/marine/hull/triangle_tree.h"
#include "dynamics/marine/waves/waves.h"

namespace blocklift::dynamics {

/// Force of a pressure on whole boxes of a hull (TriangleTree), from its values at a few points of
/// each:
///
///   (int p x n q dA; int n q dA) = -sum_i w_i q(p_i)    over the box, about Bo, in B; n out of the
///     body,
///
/// exact for the polynomial in the three coordinates through the values at a grid of Chebyshev
/// points. Linear pressure, as that of still water, is met exactly. Of a wave cos(k.x) over a box
/// that reaches H to each side of its middle, n points along a side leave at most (k H)^n /
/// (2^(n-1) n!) (the remainder of interpolation at Chebyshev points); exp(k z) alike. As many
/// points as bring the mean of this over the components of a sea, by their amplitudes, below a
/// tolerance of all of it on each side: the square mean, as their phases have nothing to do with
/// each other. Boxes for which more points would be needed than those below it take are not held.
/// Short waves do not reach down: there are grids of their own for boxes that lie deep below the
/// surface, a component counting with what is left of it there. Immutable.
class PressureBoxes {
 public:
  using Weight = Eigen::Matrix<double, 6, 1>;  ///< -w_i: moment (m3), force (m2)

  /// `per_triangle`: values that a triangle takes where it is not in a box; 0: one at each point of
  /// its leaf.
  PressureBoxes(const TriangleTree& tree, const WaveField& waves, double tolerance,
                std::size_t per_triangle = 0);

  /// Points and weights of a box.
  struct Box {
    std::span<const Vector3> points;  ///< at most WaveField::most_points, in B, m
    std::span<const Weight> weights;
  };
  /// Of the box of this node, all of which lies at least so deep (m) below the surface; empty: it
  /// is not held.
  Box find(int node, double depth) const {
    std::size_t level = depths_.size();
    while (level > 0 && depths_[level - 1] > depth) --level;
    if (level == 0) return {};
    const Place place = places_[(level - 1) * node_count_ + static_cast<std::size_t>(node)];
    return {{points_.data() + place.first, place.count},
            {weights_.data() + place.first, place.count}};
  }

 private:
  struct Grid;
  struct Place {
    std::size_t first = 0, count = 0;
  };
  void add_level(const TriangleTree& tree, const WaveField& waves, double tolerance,
                 std::size_t per_triangle);
  Place add_box(const TriangleTree& tree, int node, const Grid& grid);

  std::size_t node_count_ = 0;
  std::vector<double> depths_;  ///< ascending from 0, m
  std::vector<Place> places_;   ///< for each depth and each node
  std::vector<Vector3> points_;
  std::vector<Weight> weights_;
};

}  // namespace blocklift::dynamics
