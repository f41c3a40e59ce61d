#pragma once

#include "dynamics/marine/triangle_tree.h"
#include "dynamics/marine/waves.h"

namespace blocklift::dynamics {

/// Force of a pressure on whole boxes of a hull (TriangleTree), from its values at a few points of each:
///
///   (int p x n q dA; int n q dA) = -sum_i w_i q(p_i)    over the box, about Bo, in B; n out of the body,
///
/// exact for the polynomial in the three coordinates through the values at a grid of Chebyshev points.
/// Linear pressure, as that of still water, is met exactly. Of a wave cos(k.x) over a box that reaches H to
/// each side of its middle, n points along a side leave at most (k H)^n / (2^(n-1) n!) (the remainder of
/// interpolation at Chebyshev points); exp(k z) alike. As many points as bring the mean of this
/// over the components of a sea, weighted by their amplitudes, below a tolerance on each side. Boxes for which more
/// points would be needed than those below it take are not held. Immutable.
class PressureBoxes {
 public:
  using Weight = Eigen::Matrix<double, 6, 1>;  ///< -w_i: moment (m3), force (m2)

  /// `per_triangle`: values that a triangle takes where it is not in a box; 0: one at each point of its leaf.
  PressureBoxes(const TriangleTree& tree, const WaveField& waves, double tolerance,
                std::size_t per_triangle = 0);

  /// Is the box of this node held?
  bool has(int node) const { return count_[static_cast<std::size_t>(node)] > 0; }
  /// At most WaveField::most_points, in B, m.
  std::span<const Vector3> points(int node) const {
    const auto i = static_cast<std::size_t>(node);
    return {points_.data() + first_[i], count_[i]};
  }
  std::span<const Weight> weights(int node) const {
    const auto i = static_cast<std::size_t>(node);
    return {weights_.data() + first_[i], count_[i]};
  }

 private:
  struct Grid;
  void add_box(const TriangleTree& tree, int node, const Grid& grid);

  std::vector<std::size_t> first_, count_;  ///< for each node
  std::vector<Vector3> points_;
  std::vector<Weight> weights_;
};

}  // namespace blocklift::dynamics
