#pragma once

#include <memory>

#include <Eigen/Core>

namespace blocklift::structure {

/// Lagrange hexahedron FE_Q(p) on the unit cube [0, 1]^3, p = 1 .. 4: shape functions through
/// Gauss-Lobatto nodes, (p + 1)^3 of them.
class ReferenceElement {
 public:
  /// @throws ModelError if the degree is not 1 to 4.
  explicit ReferenceElement(int degree);
  ~ReferenceElement();

  int degree() const { return degree_; }
  int node_count() const { return static_cast<int>(nodes_.cols()); }
  /// Nodes on the unit cube, 3 x node_count.
  const Eigen::Matrix3Xd& nodes() const { return nodes_; }

  /// Shape functions at points (3 x m): m x node_count.
  Eigen::MatrixXd values(const Eigen::Matrix3Xd& points) const;
  /// Derivatives by the unit coordinates at points (3 x m): 3m x node_count, row 3 q + a for
  /// d/dxi_a at point q.
  Eigen::MatrixXd gradients(const Eigen::Matrix3Xd& points) const;

 private:
  struct Shapes;
  int degree_;
  std::unique_ptr<Shapes> shapes_;
  Eigen::Matrix3Xd nodes_;
};

/// Gauss points on [0, 1]: the first row holds places, the second weights (their sum is 1).
Eigen::Matrix2Xd gauss_points(int count);

/// Tensor product of three one-dimensional rules (rows: place, weight): 4 x m, rows x, y, z,
/// weight; x runs fastest.
Eigen::Matrix4Xd tensor_rule(const Eigen::Matrix2Xd& x, const Eigen::Matrix2Xd& y,
                             const Eigen::Matrix2Xd& z);

}  // namespace blocklift::structure
