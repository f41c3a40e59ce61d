#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/fields/shell_tree.h"
#include "structure/response/cell_finder.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// A stretch of a straight line beside a block's plates, along which something presses on them.
struct LineStretch {
  Vector3 middle_B = Vector3::Zero();     ///< m
  Vector3 along_B = Vector3::UnitX();     ///< unit
  double half_length = 0;                 ///< m
  Vector3 to_plates_B = Vector3::Zero();  ///< from the line to where it touches the plates, m
};

/// Brings forces that act along lines into the plates nearest to them.
class LineLoads {
 public:
  /// The space must outlive this object.
  explicit LineLoads(const Space& space);

  /// Distance of a place from the nearest plate's middle, m; none if it is beyond `farthest`.
  std::optional<double> find_distance(const Vector3& place, double farthest) const;

  /// Load vectors (freedoms x 3) of unit forces along x, y and z, spread over a stretch by a hat,
  ///   q(s) = (1 - |s| / h) / h,   -h < s < h,   h its half length,
  /// whose parts act at the line and are brought into the nearest point of the plates, at a place
  /// of the line moved by `to_plates_B`, with their moments about it. So the resultant is the unit
  /// force through the stretch's middle, to rounding, wherever the plates are.
  /// @throws ModelError if no plate is within `farthest_plate` of a part.
  Eigen::MatrixXd unit_forces(const LineStretch& stretch) const;

  static constexpr double farthest_plate = 1.0;  ///< m

 private:
  struct Nearest {
    ShellPlace place;
    double distance = 0;
  };
  std::optional<Nearest> find_nearest(const Vector3& place, double farthest) const;

  const Space& space_;
  ShellTree tree_;
  CellFinder cells_;
};

}  // namespace blocklift::structure
