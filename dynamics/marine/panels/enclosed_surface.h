#pragma once

#include <functional>

#include "dynamics/marine/panels/surface_rings.h"

namespace blocklift::dynamics {

/// The calm water that a body embraces: a moonpool, or the gap to a body that floats in it.
struct EnclosedSurface {
  PlanePolygon opening;  ///< the embracing body's line, counter-clockwise
  PlanePolygon inner;    ///< line of the one body in it, counter-clockwise; empty: none
};

/// Sorts water lines: lines that run clockwise are openings of the body that they belong to.
struct SortedWaterLines {
  std::vector<PlanePolygon> outer;  ///< of the bodies that the open water reaches
  std::vector<EnclosedSurface> enclosed;
};

/// @throws ModelError if an opening holds more than one body.
SortedWaterLines sort_water_lines(std::span<const WaterLine> lines);

/// Appends quadrangles in rings between opening and inner line, or triangles and quadrangles around
/// the middle of an opening without a body. Rays run from the middle through the vertices of both
/// lines; the rings begin at both with what `widths_at` says and widen up to half way.
/// @throws ModelError if a line is not star-shaped about the middle, or the lines cut each other.
void mesh_enclosed_surface(const EnclosedSurface& surface,
                           const std::function<RingWidths(const PlanePolygon&)>& widths_at,
                           double tolerance, std::vector<Panel>& panels);

}  // namespace blocklift::dynamics
