#pragma once

#include <Eigen/Core>

#include "structure/mesh/part_mesh.h"

namespace blocklift::structure {

/// Shape functions of an element kind at any place, through its nodes: polynomials of the space
/// that the kind spans (complete for tetrahedra, products for hexahedra and wedges, serendipity
/// where the inner nodes are missing). Source: Zienkiewicz, Taylor, Zhu (2013), chapter 6.
///
/// A pyramid over the square [-1, 1] x [-1, 1] at z = 0 with its tip at z = 1 has, beside the
/// complete polynomials, x y / (1 - z), and of second order x^2 y / (1 - z) and x y^2 / (1 - z): on
/// its faces these are the polynomials of its neighbours. Source: Bedrosian (1992), International
/// Journal for Numerical Methods in Engineering 35. At the tip their slopes depend on the side from
/// which it is looked at; those along the axis are given.
class ElementShape {
 public:
  /// @throws ModelError if the kind is no solid that is known.
  explicit ElementShape(const ElementKind& kind);

  Eigen::VectorXd values(const Vector3& xi) const;
  /// nodes x 3: d N_i / d xi_a.
  Eigen::MatrixX3d gradients(const Vector3& xi) const;

  /// The local coordinates of a place within the element (Newton's method), or of the element's own
  /// place beside it: those of the place, cut off at its sides.
  /// @returns how far that is from the place, m: rounding alone inside; infinity if none is found.
  double locate(const Eigen::Matrix3Xd& nodes, const Vector3& place, Vector3& xi) const;

  /// Local coordinates of the element's place that is nearest to a place in space, also beside
  /// skew elements: from locate on along the sides that hold the search back (Gauss-Newton with an
  /// active set; Nocedal and Wright 2006, chapters 10 and 16).
  /// @returns how far that is, m: rounding alone inside; infinity if none is found.
  double nearest(const Eigen::Matrix3Xd& nodes, const Vector3& place, Vector3& xi) const;

 private:
  Vector3 cut_off(const Vector3& xi) const;

  int corners_;
  Eigen::Matrix4Xi exponents_;    ///< of x, y, z and 1 / (1 - z) in the monomials
  Eigen::MatrixXd coefficients_;  ///< nodes x monomials
};

}  // namespace blocklift::structure
