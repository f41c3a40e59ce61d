#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/formulation/cell_heat.h"
#include "structure/formulation/shell.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

/// Rows of a shell's stress at a point of its mid-surface, along the point's tangents e_1, e_2, Pa.
enum ShellStressRow {
  membrane_stress_11,  ///< mean over the thickness
  membrane_stress_22,
  membrane_stress_12,
  bending_stress_11,  ///< at the surface on the normal's side; on the other side its negative
  bending_stress_22,
  bending_stress_12,
  shear_stress_13,  ///< mean over the thickness
  shear_stress_23,
  shell_stress_rows
};

/// Stresses of motions at fixed unit points of any shell cell.
///
/// At the height z above the mid-surface of a plate of thickness t the stress is membrane + 2 z / t
/// bending, and across the plate 3/2 (1 - (2 z / t)^2) of the mean shear. Where an edge of a
/// triangle is a point no strain is defined there; it is taken a hundredth of the cell away. In
/// triangles of degree 3 and above strains are those of the displacements: near that point tied
/// strains, interpolated along tangents that shrink with the distance from it, are divided by its
/// square. Those of degree 2 are tied along the sides, as the stiffness has them.
///
/// One object serves one thread.
class ShellStress {
 public:
  /// @param points of the unit square, 2 x m. The space must outlive this object.
  ShellStress(const Space& space, const Eigen::Matrix2Xd& points);

  /// Stresses in a cell of Space::shells() for motions (freedoms x k): rows shell_stress_rows point
  /// + row.
  /// @param heat of as many cases as there are motions; null: none.
  Eigen::MatrixXd of_all(int cell, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                         const CellHeat* heat = nullptr);
  /// Places and axes at the points of the cell last looked at.
  const std::vector<ShellPoint>& points() const { return current_->points(); }

 private:
  const Space& space_;
  Eigen::Matrix2Xd of_squares_at_, of_triangles_at_;  ///< the points
  ShellOperator of_squares_;
  std::unique_ptr<ShellOperator> of_triangles_;  ///< null: no triangle is there
  ShellOperator* current_ = &of_squares_;
};

/// Motions of a cell's nodes, 6 nodes_per_shell() x k, from those of all (freedoms x k).
Eigen::MatrixXd motions_of_cell(const Space& space, int cell,
                                const Eigen::Ref<const Eigen::MatrixXd>& motions);

/// ShellStress::of_all of a run of cells, found by all threads: rows of one cell after another.
/// @param points of the unit square, 2 x m. @param first of the cells of Space::shells().
Eigen::MatrixXd stresses_of_cells(const Space& space, const Eigen::Matrix2Xd& points, int first,
                                  int count, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                  const CellHeat* heat = nullptr);

/// Stresses (rows 6 point + component of Stress, along e_1, e_2 and the normal) at one height for
/// the rows of ShellStress::of_all, without shear across the plate.
/// @param side 1: the surface on the normal's side, -1: the other one, 0: the membrane stress.
Eigen::MatrixXd stresses_at_side(const Eigen::MatrixXd& rows, double side);

/// Von Mises of a plane stress, Pa: sqrt(s11^2 - s11 s22 + s22^2 + 3 s12^2).
double plane_von_mises(double s11, double s22, double s12);

/// Von Mises stresses of a plate at a point, Pa.
struct PlateVonMises {
  double membrane = 0;
  double top = 0;  ///< on the normal's side
  double bottom = 0;

  /// Of the surfaces; the membrane's never exceeds it, for von Mises stress is convex.
  double largest() const { return top > bottom ? top : bottom; }
};

/// @param rows shell_stress_rows of one point and one motion.
PlateVonMises plate_von_mises(const Eigen::Ref<const Eigen::VectorXd>& rows);

}  // namespace blocklift::structure
