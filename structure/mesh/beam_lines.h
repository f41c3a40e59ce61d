#pragma once

#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Where the beams of a mesh run: between their vertices, along the curved edge of a shell or solid
/// if they are its ends, else straight. Elements have it so (Space), and masses and lengths.
class BeamLines {
 public:
  explicit BeamLines(const Mesh& mesh);

  /// A point of the line between the vertices, without offsets.
  struct Point {
    Vector3 place = Vector3::Zero();  ///< m
    Vector3 slope = Vector3::Zero();  ///< by the share of the way, m
  };
  /// @param share of the way from the beam's first vertex to its second one
  Point point_at(const Beam& beam, double share) const;
  bool is_curved(const Beam& beam) const;
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
  void add_edge(int from, int to, Eigen::Matrix3Xd points);
  std::vector<Part> parts(const Beam& beam, const Vector3& arm, const Vector3& arm_slope) const;

  const Mesh& mesh_;
  /// Points of curved edges from the smaller vertex to the larger one, equally spaced.
  std::map<std::pair<int, int>, Eigen::Matrix3Xd> curved_;
};

}  // namespace blocklift::structure
