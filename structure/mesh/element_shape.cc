#include "structure/mesh/element_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

/// The sides that hold a search within an element back, by their numbers.
class HeldSides {
 public:
  HeldSides(int corners, const Vector3& xi) : sides_(&sides_of(corners)) {
    constexpr double rounding = 1e-9;
    for (std::size_t s = 0; s < sides_->size(); ++s)
      if (side(s).head<3>().dot(xi) > side(s)[3] - rounding) held_.push_back(s);
  }

  /// Orthonormal local directions along all of them.
  Eigen::Matrix3Xd ways() const {
    if (held_.empty()) return Eigen::Matrix3d::Identity();
    return algebra::left_null_space(normals(), 1e-9);
  }

  /// Lets the side go that would have to draw most to resist a pull.
  /// @param pull in local coordinates: minus the slope of half the square of the distance.
  /// @returns false if all sides push.
  bool let_go(const Vector3& pull) {
    if (held_.empty()) return false;
    const Eigen::VectorXd pushes = algebra::least_squares(normals(), Eigen::MatrixXd(pull));
    Eigen::Index least = 0;
    if (pushes.minCoeff(&least) >= 0) return false;
    held_.erase(held_.begin() + least);
    return true;
  }

  /// Holds the first side that a step meets. @returns the share of the step up to there.
  double meet(const Vector3& xi, const Vector3& change) {
    double share = 1;
    std::optional<std::size_t> met;
    for (std::size_t s = 0; s < sides_->size(); ++s) {
      const Vector3 normal = side(s).head<3>();
      const double towards = normal.dot(change);
      if (towards <= 1e-12 * change.norm() || std::count(held_.begin(), held_.end(), s) > 0)
        continue;
      const double up_to = std::max(0.0, (side(s)[3] - normal.dot(xi)) / towards);
      if (up_to >= share) continue;
      share = up_to;
      met = s;
    }
    if (met) held_.push_back(*met);
    return share;
  }

 private:
  const Eigen::Vector4d& side(std::size_t s) const { return (*sides_)[s]; }

  Eigen::MatrixXd normals() const {
    Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(held_.size()));
    for (std::size_t i = 0; i < held_.size(); ++i)
      columns.col(static_cast<Eigen::Index>(i)) = side(held_[i]).head<3>();
    return columns;
  }

  const std::vector<Eigen::Vector4d>* sides_;
  std::vector<std::size_t> held_;
};

Vector3 middle_of(int corners) {
  return corners == 8   ? Vector3(0, 0, 0)
         : corners == 4 ? Vector3(0.25, 0.25, 0.25)
         : corners == 5 ? Vector3(0, 0, 0.25)
                        : Vector3(1 / 3.0, 1 / 3.0, 0);
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
  xi = middle_of(corners_);
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

// Seen from many of its sizes away, a twisted element may have several places that are nearer than
// all about them; one of these is found.
double ElementShape::nearest(const Eigen::Matrix3Xd& nodes, const Vector3& place,
                             Vector3& xi) const {
  constexpr int most_steps = 40;
  double distance = locate(nodes, place, xi);
  if (!std::isfinite(distance)) {  // far off, where the element's map may fold
    xi = middle_of(corners_);
    distance = (place - nodes * values(xi)).norm();
  }
  const double size = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
  const double rounding = 1e-12 * size;
  HeldSides held(corners_, xi);
  for (int step = 0; step < most_steps && distance > rounding; ++step) {
    const Vector3 miss = place - nodes * values(xi);
    const Eigen::Matrix3d jacobian = nodes * gradients(xi);
    const Eigen::Matrix3Xd ways = held.ways();
    Vector3 change = Vector3::Zero();
    if (ways.cols() > 0)
      change = ways * algebra::least_squares(jacobian * ways, Eigen::MatrixXd(miss));
    if ((jacobian * change).norm() <= 1e-9 * size) {
      if (!held.let_go(jacobian.transpose() * miss)) break;
      continue;
    }
    HeldSides beyond = held;
    change *= beyond.meet(xi, change);
    const auto distance_after = [&] {
      return (place - nodes * values(cut_off(xi + change))).norm();
    };
    double nearer = distance_after();
    for (int half = 0; !(nearer <= distance + rounding) && half < most_steps; ++half) {
      beyond = held;  // curved so much that the step overshoots
      change /= 2;
      nearer = distance_after();
    }
    if (!(nearer <= distance + rounding)) break;
    held = beyond;
    distance = nearer;
    xi = cut_off(xi + change);
  }
  return distance;
}

}  // namespace blocklift::structure
