#pragma once

#include <vector>

#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics {

/// A rectangle of the plane z = 0 on which waves fade, or none can be.
struct WaterPlaneRegion {
  Eigen::Vector2d low, high;  ///< corners, m
};

/// Rectangles of the plane z = 0, along the world's axes; normals into the water.
struct WaterPlaneCells {
  std::vector<Panel> panels;
  /// The region that a cell of the open water lies in; -1: within a body.
  std::vector<int> region;

  int size() const { return static_cast<int>(panels.size()); }
};

/// Divides the water planes within the bodies, and what of the regions is open water, into cells of
/// about `size` (m). With planes of symmetry only what lies in x >= 0 and/or y >= 0. Each cell's
/// middle is on its side of the water lines; oblique lines are followed in steps. Where regions
/// overlap, the first holds.
WaterPlaneCells make_water_plane_cells(const std::vector<WaterLine>& water_lines,
                                       const std::vector<WaterPlaneRegion>& regions,
                                       const Symmetry& symmetry, double size);

}  // namespace blocklift::dynamics
