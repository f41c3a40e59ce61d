#pragma once

#include <array>

#include <Eigen/Core>

#include "structure/space/space.h"

namespace blocklift::structure {

/// Membrane shear of a cell of degree 1, which is the mean of the cell in its stiffness
/// (ShellOperator), while the displacements of one that bends in its plane have a shear beside it
/// that no plate has. As in the stiffness it is the shear along tangents of the surface at each
/// point: along one plane of a warped cell a rotation would have a shear, too.
class BilinearShear {
 public:
  /// @param space of degree 1.
  BilinearShear(const Space& space, int cell);

  /// What the displacements' shear at a point of the unit square is for the displacements of the
  /// cell's nodes (a column each), beyond the mean: 1/m.
  Eigen::Matrix<double, 3, 4> excess_at(const Eigen::Vector2d& xi) const {
    return shear_at(xi) - mean_;
  }
  /// (11, 22, 2 x 12) along e_1 and e_2 of a shear of one along the surface's axes at a point.
  Vector3 turned_to(const Eigen::Vector2d& xi, const Vector3& e_1, const Vector3& e_2) const;

 private:
  /// Unit tangents at a point, columns: the part of the cell's direction along the surface, and
  /// across that.
  Eigen::Matrix<double, 3, 2> axes_at(const Eigen::Vector2d& xi) const;
  Eigen::Matrix<double, 3, 4> shear_at(const Eigen::Vector2d& xi) const;
  double area_at(const Eigen::Vector2d& xi) const;

  Eigen::Matrix<double, 3, 4> corners_;
  Vector3 along_;  ///< the cell's direction, as ShellOperator has it
  Eigen::Matrix<double, 3, 4> mean_;
};

}  // namespace blocklift::structure
