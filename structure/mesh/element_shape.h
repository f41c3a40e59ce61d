#pragma once

#include <Eigen/Core>

#include "structure/mesh/part_mesh.h"

namespace blocklift::structure {

/// Shape functions of an element kind at any place, through its nodes: polynomials of the space
/// that the kind spans (complete for tetrahedra, products for hexahedra and wedges, serendipity
/// where the inner nodes are missing). Source: Zienkiewicz, Taylor, Zhu (2013), chapter 6.
class ElementShape {
 public:
  /// @throws ModelError if the kind is no solid that is known.
  explicit ElementShape(const ElementKind& kind);

  Eigen::VectorXd values(const Vector3& xi) const;
  /// nodes x 3: d N_i / d xi_a.
  Eigen::MatrixX3d gradients(const Vector3& xi) const;

  /// The local coordinates of a place within an element (Newton's method); false if it lies outside
  /// by more than `slack` of the local coordinates.
  bool locate(const Eigen::Matrix3Xd& nodes, const Vector3& place, double slack, Vector3& xi) const;

 private:
  bool inside(const Vector3& xi, double slack) const;

  int corners_;
  Eigen::Matrix3Xi exponents_;    ///< of the monomials
  Eigen::MatrixXd coefficients_;  ///< nodes x monomials
};

}  // namespace blocklift::structure
