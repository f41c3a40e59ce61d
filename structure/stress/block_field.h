#pragma once

#include <Eigen/Core>

#include "structure/mesh/fields/plate_finder.h"
#include "structure/response/cell_finder.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// A place within a block's plates.
struct SteelPlace : CellPlace {
  double height = 0;  ///< above the mid-surface, towards the shell's normal, m
};

/// Finds the plate that holds a place.
class SteelFinder {
 public:
  /// The space must outlive this object.
  explicit SteelFinder(const Space& space);

  /// As PlateFinder::find; cell -1 where there is no plate.
  SteelPlace find(const Vector3& place, const Vector3& normal = Vector3::Zero()) const;

 private:
  PlateFinder plates_;
  CellFinder cells_;
};

/// SteelFinder for one place: cell -1 if it lies in no plate.
SteelPlace find_cell(const Space& space, const Vector3& place);

/// Displacements at places of a block: row 3 p + axis for place p, a column for each of `motions`
/// (freedoms x m), m. Off the mid-surface they are those of Reissner and Mindlin, u + theta x arm.
/// @param normal of the plate that is meant where several meet, see SteelFinder.
/// @throws ModelError naming the first place that lies in no plate.
Eigen::MatrixXd displacements_at(const ElasticModel& model,
                                 const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                 const Eigen::Matrix3Xd& places,
                                 const Vector3& normal = Vector3::Zero());

/// The same of points that stand on plates by rigid arms, from the place that each has there.
/// @param feet a column a point, as places of displacements_at.
Eigen::MatrixXd displacements_of_arms(const ElasticModel& model,
                                      const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                      const Eigen::Matrix3Xd& feet, const Eigen::Matrix3Xd& points,
                                      const Vector3& normal = Vector3::Zero());

/// Stresses at a place, row a component (xx, yy, zz, xy, yz, zx) in the block's axes, a column for
/// each of `motions`, Pa. At the height z: membrane + 2 z / t bending, and 3/2 (1 - (2 z / t)^2) of
/// the mean shear.
Eigen::MatrixXd stresses_at(const ElasticModel& model,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions,
                            const SteelPlace& place);

}  // namespace blocklift::structure
