#pragma once

#include <Eigen/Core>

#include "structure/elasticity/discretisation.h"
#include "structure/response/stress_state.h"

namespace blocklift::structure {

/// Stresses of one displacement at fixed unit points of any cell.
class CellStress {
 public:
  /// @param points on the unit cube, 3 x m.
  CellStress(const HexMesh& mesh, const Discretisation& space, Eigen::Matrix3Xd points);

  const Eigen::Matrix3Xd& points() const { return points_; }
  /// Stresses (6 x m) of the displacement (3 a node), Pa.
  Eigen::Matrix<double, 6, Eigen::Dynamic> operator()(int cell,
                                                      const Eigen::VectorXd& displacement) const;
  /// Stresses of several displacements (one a column): rows 6 point + component, Pa.
  Eigen::MatrixXd of_all(int cell, const Eigen::MatrixXd& displacements) const;
  /// Von Mises at the m points, Pa.
  Eigen::VectorXd von_mises(int cell, const Eigen::VectorXd& displacement) const;

 private:
  const HexMesh& mesh_;
  const Discretisation& space_;
  Eigen::Matrix3Xd points_;
  Eigen::MatrixXd gradients_;
};

}  // namespace blocklift::structure
