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
  along_ = corners_ * derivatives({0.5, 0.5}).row(0).transpose();
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
  const Eigen::Matrix<double, 3, 2> axes = axes_at(xi);
  const Eigen::Matrix2d jacobian = axes.transpose() * g;  // d(place along the axes) / d xi
  const Eigen::Matrix<double, 2, 4> by_place = jacobian.inverse().transpose() * by_unit;
  return axes.col(0) * by_place.row(1) + axes.col(1) * by_place.row(0);
}

Eigen::Matrix<double, 3, 2> BilinearShear::axes_at(const Eigen::Vector2d& xi) const {
  const Eigen::Matrix<double, 3, 2> g = corners_ * derivatives(xi).transpose();
  const Vector3 normal = Vector3(g.col(0)).cross(Vector3(g.col(1))).normalized();
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = (along_ - normal * normal.dot(along_)).normalized();
  axes.col(1) = normal.cross(Vector3(axes.col(0)));
  return axes;
}

Vector3 BilinearShear::turned_to(const Eigen::Vector2d& xi, const Vector3& e_1,
                                 const Vector3& e_2) const {
  const Eigen::Matrix<double, 3, 2> axes = axes_at(xi);
  const Eigen::Vector2d a = axes.transpose() * e_1, b = axes.transpose() * e_2;
  return {a[0] * a[1], b[0] * b[1], a[0] * b[1] + b[0] * a[1]};
}

}  // namespace blocklift::structure
