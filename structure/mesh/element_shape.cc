#include "structure/mesh/element_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/error.h"

namespace blocklift::structure {

namespace {

// Whether x^i y^j z^k is in the space of the element with so many corners and nodes.
bool spans(int corners, int nodes, int i, int j, int k) {
  const bool quadratic = nodes > corners;
  if (corners == 4) return i + j + k <= (quadratic ? 2 : 1);
  if (corners == 5) return i + j + k <= (quadratic ? 2 : 1);
  if (corners == 8) {
    if (!quadratic) return std::max({i, j, k}) <= 1;
    return nodes == 27 || (i == 2) + (j == 2) + (k == 2) <= 1;
  }
  if (!quadratic) return i + j <= 1 && k <= 1;
  if (nodes == 18) return i + j <= 2;
  return (i + j <= 2 && k <= 1) || (i + j <= 1 && k == 2);
}

Eigen::VectorXd monomials(const Eigen::Matrix4Xi& exponents, const Vector3& xi) {
  Eigen::VectorXd values(exponents.cols());
  const double left = 1 - xi.z();
  const bool is_tip = std::abs(left) < 1e-12;  // x and y are zero there, along the axis
  for (Eigen::Index m = 0; m < values.size(); ++m) {
    values[m] = is_tip && exponents(3, m) > 0 ? 0 : 1;
    for (int a = 0; a < 3; ++a)
      for (int e = 0; e < exponents(a, m); ++e) values[m] *= xi[a];
    for (int e = 0; !is_tip && e < exponents(3, m); ++e) values[m] /= left;
  }
  return values;
}

/// Sides of the element with so many corners: in it side.head<3>() . xi <= side[3].
const std::vector<Eigen::Vector4d>& sides_of(int corners) {
  using Sides = std::vector<Eigen::Vector4d>;
  static const Sides tetrahedron = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {1, 1, 1, 1}};
  static const Sides pyramid = {
      {0, 0, -1, 0}, {1, 0, 1, 1}, {-1, 0, 1, 1}, {0, 1, 1, 1}, {0, -1, 1, 1}};
  static const Sides wedge = {
      {-1, 0, 0, 0}, {0, -1, 0, 0}, {1, 1, 0, 1}, {0, 0, 1, 1}, {0, 0, -1, 1}};
  static const Sides hexahedron = {{1, 0, 0, 1},  {-1, 0, 0, 1}, {0, 1, 0, 1},
                                   {0, -1, 0, 1}, {0, 0, 1, 1},  {0, 0, -1, 1}};
  return corners == 4 ? tetrahedron : corners == 5 ? pyramid : corners == 6 ? wedge : hexahedron;
}

/// Orthonormal local directions along all sides that a place lies on and a wanted step would leave
/// by.
Eigen::Matrix3Xd free_ways(int corners, const Vector3& xi, const Vector3& wanted) {
  constexpr double rounding = 1e-9;
  std::vector<Vector3> held;
  for (const Eigen::Vector4d& side : sides_of(corners)) {
    const Vector3 normal = side.head<3>();
    if (normal.dot(xi) > side[3] - rounding && normal.dot(wanted) > 0) held.push_back(normal);
  }
  if (held.empty()) return Eigen::Matrix3d::Identity();
  Eigen::MatrixXd normals(3, static_cast<Eigen::Index>(held.size()));
  for (std::size_t i = 0; i < held.size(); ++i) normals.col(static_cast<Eigen::Index>(i)) = held[i];
  return algebra::left_null_space(normals, rounding);
}

}  // namespace

ElementShape::ElementShape(const ElementKind& kind) : corners_(kind.corners) {
  std::vector<Eigen::Vector4i> list;
  for (int k = 0; k <= 2; ++k)
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 2; ++i)
        if (spans(kind.corners, kind.nodes, i, j, k)) list.emplace_back(i, j, k, 0);
  if (kind.corners == 5) list.emplace_back(1, 1, 0, 1);
  if (kind.corners == 5 && kind.nodes > 5) {
    list.emplace_back(2, 1, 0, 1);
    list.emplace_back(1, 2, 0, 1);
  }
  if (kind.dimension != 3 || static_cast<int>(list.size()) != kind.nodes)
    throw ModelError("elements of kind " + kind.name + " are not known");
  exponents_.resize(4, kind.nodes);
  for (int m = 0; m < kind.nodes; ++m) exponents_.col(m) = list[m];
  Eigen::MatrixXd at_nodes(kind.nodes, kind.nodes);  // (monomial, node)
  for (int n = 0; n < kind.nodes; ++n) at_nodes.col(n) = monomials(exponents_, kind.local.col(n));
  coefficients_ = algebra::inverse_of(at_nodes);
}

Eigen::VectorXd ElementShape::values(const Vector3& xi) const {
  return coefficients_ * monomials(exponents_, xi);
}

Eigen::MatrixX3d ElementShape::gradients(const Vector3& xi) const {
  Eigen::MatrixX3d slopes(exponents_.cols(), 3);
  for (int a = 0; a < 3; ++a) {
    Eigen::Matrix4Xi lowered = exponents_;
    lowered.row(a) = (lowered.row(a).array() - 1).max(0);
    slopes.col(a) =
        monomials(lowered, xi).cwiseProduct(exponents_.row(a).transpose().cast<double>());
  }
  Eigen::Matrix4Xi raised = exponents_;  // d/dz of 1 / (1 - z)
  raised.row(3).array() += 1;
  slopes.col(2) += monomials(raised, xi).cwiseProduct(exponents_.row(3).transpose().cast<double>());
  return coefficients_ * slopes;
}

Vector3 ElementShape::cut_off(const Vector3& xi) const {
  if (corners_ == 8) return xi.cwiseMax(-1).cwiseMin(1);
  if (corners_ == 4) return xi.cwiseMax(0) / std::max(1.0, xi.cwiseMax(0).sum());
  Vector3 cut = xi;
  if (corners_ == 5) {
    cut.z() = std::clamp(xi.z(), 0.0, 1.0);
    const double half = 1 - cut.z();
    cut.head<2>() = xi.head<2>().cwiseMax(-half).cwiseMin(half);
  } else {
    cut.head<2>() = xi.head<2>().cwiseMax(0) / std::max(1.0, xi.head<2>().cwiseMax(0).sum());
    cut.z() = std::clamp(xi.z(), -1.0, 1.0);
  }
  return cut;
}

double ElementShape::locate(const Eigen::Matrix3Xd& nodes, const Vector3& place,
                            Vector3& xi) const {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  xi = corners_ == 8   ? Vector3(0, 0, 0)
       : corners_ == 4 ? Vector3(0.25, 0.25, 0.25)
       : corners_ == 5 ? Vector3(0, 0, 0.25)
                       : Vector3(1 / 3.0, 1 / 3.0, 0);
  for (int step = 0; step < 20; ++step) {
    const Vector3 miss = place - nodes * values(xi);
    const Eigen::Matrix3d jacobian = nodes * gradients(xi);
    const Vector3 change = algebra::solve_square(jacobian, miss);
    if (!change.allFinite() || xi.norm() > 10) return nowhere;
    xi += change;
    if (change.norm() < 1e-13) break;
  }
  xi = cut_off(xi);
  return (place - nodes * values(xi)).norm();
}

double ElementShape::nearest(const Eigen::Matrix3Xd& nodes, const Vector3& place,
                             Vector3& xi) const {
  constexpr int most_steps = 20;
  double distance = locate(nodes, place, xi);
  const double rounding = 1e-12 * (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
  for (int step = 0; step < most_steps && std::isfinite(distance); ++step) {
    const Vector3 miss = place - nodes * values(xi);
    const Eigen::Matrix3d jacobian = nodes * gradients(xi);
    const Vector3 wanted = algebra::solve_square(jacobian, miss);
    const Eigen::Matrix3Xd ways = free_ways(corners_, xi, wanted);
    if (!wanted.allFinite() || ways.cols() == 0 || ways.cols() == 3) break;
    const Vector3 change = ways * algebra::least_squares(jacobian * ways, Eigen::MatrixXd(miss));
    const Vector3 next = cut_off(xi + change);
    const double nearer = (place - nodes * values(next)).norm();
    if (!(nearer < distance - rounding)) break;
    distance = nearer;
    xi = next;
  }
  return distance;
}

}  // namespace blocklift::structure
