#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/report/block_surface.h"

namespace blocklift::pipeline {

/// Where a point of one surface lies on another: within a triangle of the other's points.
struct MappedPoint {
  std::array<std::int32_t, 3> points{-1, -1, -1};  ///< negative: the point has no counterpart
  std::array<double, 3> weights{};                 ///< of the points, sum 1

  bool has_counterpart() const { return points[0] >= 0; }
};

/// Whether two surfaces have the same quadrangles of the same groups, and points that differ by a
/// millionth of the surface's size at most.
bool have_same_mesh(const BlockSurface& first, const BlockSurface& second);

/// For each point of `surface` the nearest place of the same part on `reference`.
///
/// Parts are groups of one name. As plates share places at their joints, the plate is sought first:
/// of all those of the group the one that is nearest to the point moved by 5 % towards the centre
/// of its quadrangle; then the place of that plate that is nearest to the point itself. Plates are
/// what hangs together by shared points. Quadrangles are taken as the two triangles that the page
/// draws, so that a field that is linear in place is mapped exactly on flat plates.
///
/// A point has no counterpart if no part of the reference has the name of its own, or if the
/// nearest place is farther than the longest edge of both its quadrangle and the triangle found (a
/// plate that was made longer). Between surfaces of the same mesh points are mapped one to one.
std::vector<MappedPoint> map_surface(const BlockSurface& surface, const BlockSurface& reference);

/// A field's value there, linear within the triangle; NaN without a counterpart.
/// @param values `components` of each point of the reference, which component is asked for
double mapped_value(const MappedPoint& place, const std::vector<double>& values,
                    std::size_t components = 1, std::size_t component = 0);

}  // namespace blocklift::pipeline
