#pragma once

#include <algorithm>
#include <vector>

#include "dynamics/marine/panels/plane_polygon.h"

namespace blocklift::dynamics {

/// Widths of rings of panels on the water, from a water line outwards.
struct RingWidths {
  double width;        ///< of the next ring, m
  double slow_from;    ///< width from which the rings widen slowly, m
  double fast_growth;  ///< up to there
  double growth;

  void widen() {
    width = width < slow_from ? std::min(width * fast_growth, std::max(slow_from, width * growth))
                              : width * growth;
  }
};

/// Edges of the rings that cover a distance best, in shares of it: 0 to 1, one ring at least.
/// `widths` is left at the ring that follows.
std::vector<double> ring_edges(double distance, RingWidths& widths);

/// Appends the surface panel through points that run counter-clockwise seen from above, its normal
/// down into the water. Points nearer to each other than `tolerance` (m) count once; fewer than
/// three that are left make no panel.
/// @throws ModelError if the points run the other way: rays of the mesh cross there.
void add_surface_panel(const std::vector<Eigen::Vector2d>& points, double tolerance,
                       std::vector<Panel>& panels);

/// Number of the edge with which a panel of a ring meets the next one out along its rays, and the
/// one before: from that vertex to the next.
inline constexpr int outer_side = 1, inner_side = 3;

/// Appends rings between two neighbouring rays a -> a_end and b -> b_end. Quadrangles have
/// outer_side and inner_side; where rays meet there is a triangle, which has neither.
/// @param edges in shares of the rays, 0 to 1.
void add_surface_rings(const std::array<Eigen::Vector2d, 2>& from,
                       const std::array<Eigen::Vector2d, 2>& to, const std::vector<double>& edges,
                       double tolerance, std::vector<Panel>& panels);

}  // namespace blocklift::dynamics
