#include "structure/stress/bilinear_shear.h"

#include <Eigen/Dense>

#include "structure/formulation/shell.h"

namespace blocklift::structure {

namespace {

/// Derivatives of the shape functions by the unit coordinates, a row each.
Eigen::Matrix<double, 2, 4> derivatives(const Eigen::Vector2d& xi) {
  const double x = xi.x(), y = xi.y();
  Eigen::Matrix<double, 2, 4> d;
  d << y - 1, 1 - y, -y, y, x - 1, -x, 1 - x, x;
  return d;
}

}  // namespace

BilinearShear::BilinearShear(const Space& space, int cell) {
  for (int i = 0; i < 4; ++i) corners_.col(i) = space.nodes().col(space.shell_nodes(cell)[i]);
  // The axes of ShellOperator in the middle of the cell.
  const Eigen::Matrix<double, 3, 2> g = corners_ * derivatives({0.5, 0.5}).transpose();
  const Vector3 normal = Vector3(g.col(0)).cross(Vector3(g.col(1))).normalized();
  c_1_ = (g.col(0) - normal * normal.dot(g.col(0))).normalized();
  c_2_ = normal.cross(c_1_);
  mean_.setZero();
  double area = 0;
  const Eigen::Matrix3Xd rule = square_rule(2);
  for (Eigen::Index q = 0; q < rule.cols(); ++q) {
    const double part = rule(2, q) * area_at(rule.col(q).head<2>());
    mean_ += part * shear_at(rule.col(q).head<2>());
    area += part;
  }
  mean_ /= area;
}

double BilinearShear::area_at(const Eigen::Vector2d& xi) const {
  const Eigen::Matrix<double, 3, 2> g = corners_ * derivatives(xi).transpose();
  return Vector3(g.col(0)).cross(Vector3(g.col(1))).norm();
}

Eigen::Matrix<double, 3, 4> BilinearShear::shear_at(const Eigen::Vector2d& xi) const {
  const Eigen::Matrix<double, 2, 4> by_unit = derivatives(xi);
  const Eigen::Matrix<double, 3, 2> g = corners_ * by_unit.transpose();
  Eigen::Matrix2d jacobian;  // d(place along c_1, c_2) / d xi
  jacobian << c_1_.dot(g.col(0)), c_1_.dot(g.col(1)), c_2_.dot(g.col(0)), c_2_.dot(g.col(1));
  const Eigen::Matrix<double, 2, 4> by_place = jacobian.inverse().transpose() * by_unit;
  return c_1_ * by_place.row(1) + c_2_ * by_place.row(0);
}

Vector3 BilinearShear::turned_to(const Vector3& e_1, const Vector3& e_2) const {
  return {c_1_.dot(e_1) * c_2_.dot(e_1), c_1_.dot(e_2) * c_2_.dot(e_2),
          c_1_.dot(e_1) * c_2_.dot(e_2) + c_1_.dot(e_2) * c_2_.dot(e_1)};
}

}  // namespace blocklift::structure
