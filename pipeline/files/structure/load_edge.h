#pragma once

#include <limits>
#include <string>

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/geometry_format.h"

namespace blocklift::pipeline {

/// An edge of a load that ropes may touch: a straight line, or a cylinder about it. In the load's
/// frame, m.
struct LoadEdge {
  Located<std::string> name;
  std::string origin;  ///< of a copy: the name of what it was made of; else empty
  Vector3 from = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< of its axis
  Vector3 to = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vector3 outside = Vector3::UnitZ();  ///< unit, away from the material; the ropes' side
  double radius = 0;                   ///< m; 0: sharp
  double friction = 0;                 ///< mu between it and ropes; 0: smooth
  /// Of the axis, over which a touch at one place is spread where stress is computed, m.
  double contact_length = std::numeric_limits<double>::quiet_NaN();

  double length() const { return (to - from).norm(); }
  /// Distance of a point from the axis, m.
  double distance_from_axis(const Vector3& point) const;
};

Format<LoadEdge> load_edge_format();

}  // namespace blocklift::pipeline
