#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Piece of one plate of a block's outer shell.
struct ShellRegion {
  Vector3 outward_B =
      Vector3::Zero();  ///< unit normal, away from the block; the mean where it is curved
  Vector3 centre_B = Vector3::Zero();  ///< of its volume, m
  std::vector<int> cells;              ///< of Space::shells()
};

/// Outer shell of a block, which takes the pressure of water, divided into pieces.
///
/// A plate belongs to the shell where nothing of the block stands before it, looking from the
/// middle of each cell along its normal; lugs are neither shell nor cover it. Each region takes a
/// force and a moment spread over its plate such that the resultant is exact (add_spread_wrenches):
/// pressure that is linear over a flat region, as that of still water is, comes out as it is; where
/// the water line crosses a region its resultant and its centre do, at any attitude.
class ShellRegions {
 public:
  /// The model must outlive this object.
  /// @param size of a region, m: the bands that divide a plate run along the two axes of B that lie
  ///   most nearly in it.
  /// @throws ModelError if the size is not positive or no plate looks outwards.
  ShellRegions(const ElasticModel& model, double size);

  const std::vector<ShellRegion>& regions() const { return regions_; }
  /// The region with the plate nearest to a place, m, of those that look outwards as `outward_B` (a
  /// unit vector) does, within 70 degrees; of all if none does.
  int nearest(const Vector3& place_B, const Vector3& outward_B) const;
  /// Load vectors (six rows a node, a column each) of wrenches: rows 6 region + i, force (N) and
  /// moment about the region's centre (N m) in B.
  Eigen::MatrixXd loads(const Eigen::MatrixXd& wrenches) const;

 private:
  struct Face {
    std::vector<Vector3> corners;  ///< of triangles: a corner and two sides, three entries each
    Eigen::AlignedBox3d box;
    Vector3 outward_B = Vector3::Zero();
    int region = -1;
  };
  void divide(double size);
  void find_centres();

  const ElasticModel& model_;
  std::vector<ShellRegion> regions_;
  std::vector<Face> faces_;
};

}  // namespace blocklift::structure
