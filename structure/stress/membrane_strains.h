#pragma once

#include <memory>
#include <unordered_map>

#include <Eigen/Core>

#include "structure/formulation/shell.h"

namespace blocklift::structure {

/// Membrane strains of motions anywhere in cells, as the stiffness has them.
///
/// Those of the displacements lock: where a curved cell of degree p bends without stretching they
/// are nothing in its p Gauss points along a side and nowhere else. The tied strains of
/// ShellOperator, which do the work, have nothing of it.
///
/// They are found at the (p + 1) x (p + 1) Gauss points of a cell, along axes of their own there,
/// and interpolated; in triangles from degree 2 on at p x p. Those that a curved triangle of
/// degree 2 has tied along its sides are linear, for which that is enough. The others' are those of
/// the displacements, and there elements of degree p are most accurate (Barlow 1976).
///
/// One object serves one thread.
class MembraneStrains {
 public:
  using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param motions freedoms x m, m and rad. It and the space must outlive this object.
  MembraneStrains(const Space& space, const ByRows& motions);
  ~MembraneStrains();

  /// Strains of the mid-surface (11, 22, 2 x 12) at a point of a cell, 3 x m.
  /// @param e_1 its part along the surface is the first axis there.
  /// @param side 1: the second axis is the shell's normal x e_1; -1: its negative.
  Eigen::MatrixXd at(int cell, const Eigen::Vector2d& xi, const Vector3& e_1, double side);

 private:
  struct Sampling;
  struct Known;
  const Known& know(int cell);

  const Space& space_;
  const ByRows& motions_;
  std::unique_ptr<Sampling> of_squares_, of_triangles_;  ///< made when they are needed
  std::unordered_map<int, std::unique_ptr<const Known>> known_;
};

}  // namespace blocklift::structure
