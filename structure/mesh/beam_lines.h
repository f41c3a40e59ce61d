#pragma once

#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Where the beams of a mesh run: between their vertices, along a curved shell's edge if they are
/// its ends, as Space has them from elements of the shells' order on; else straight.
class BeamLines {
 public:
  explicit BeamLines(const Mesh& mesh);

  /// Of the line between the vertices, without offsets, m.
  double length(const Beam& beam) const;

  /// A point of Gauss' rule along the line of a beam's centroids.
  struct Part {
    double share = 0;                 ///< of the way from the first vertex
    double length = 0;                ///< that it stands for, m
    Vector3 place = Vector3::Zero();  ///< m
  };
  /// Two of a straight beam, three of one along a curved edge.
  std::vector<Part> centroid_parts(const Beam& beam) const;

 private:
  std::vector<Part> parts(const Beam& beam, const Vector3& arm, const Vector3& arm_slope) const;
  /// From the first vertex to the last, equally spaced.
  Eigen::Matrix3Xd points_of(const Beam& beam) const;

  const Mesh& mesh_;
  std::map<std::pair<int, int>, Eigen::Matrix3Xd> curved_;  ///< from the smaller vertex on
};

}  // namespace blocklift::structure
