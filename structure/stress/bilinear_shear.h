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

  /// At a point of the unit square.
  struct Excess {
    /// What the displacements' shear is beyond the mean for the displacements of the cell's nodes
    /// (a column each): 1/m.
    Eigen::Matrix<double, 3, 4> by_nodes;
    /// (11, 22, 2 x 12) along e_1 and e_2 of a shear of one along the surface's axes.
    Vector3 turned;
  };
  Excess excess_at(const Eigen::Vector2d& xi, const Vector3& e_1, const Vector3& e_2) const;

 private:
  using UnitDerivatives = Eigen::Matrix<double, 2, 4>;
  /// What a point has: derivatives of the shape functions by the unit coordinates, a row each; of
  /// places by these, a column each; unit tangents, columns: the part of the cell's direction along
  /// the surface, and across that.
  struct Point {
    UnitDerivatives by_unit;
    Eigen::Matrix<double, 3, 2> tangents, axes;
    double area;  ///< m^2 per unit of the square
  };
  Point point_at(const Eigen::Vector2d& xi) const;
  static Eigen::Matrix<double, 3, 4> shear_at(const Point& point);

  Eigen::Matrix<double, 3, 4> corners_;
  Vector3 along_;  ///< the cell's direction, as ShellOperator has it
  Eigen::Matrix<double, 3, 4> mean_;
};

}  // namespace blocklift::structure
