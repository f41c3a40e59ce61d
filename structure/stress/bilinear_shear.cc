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
  static const Eigen::Matrix3Xd rule = square_rule(2);
  for (int i = 0; i < 4; ++i) corners_.col(i) = space.nodes().col(space.shell_nodes(cell)[i]);
  along_ = corners_ * derivatives({0.5, 0.5}).row(0).transpose();
  mean_.setZero();
  double area = 0;
  for (Eigen::Index q = 0; q < rule.cols(); ++q) {
    const Point point = point_at(rule.col(q).head<2>());
    const double part = rule(2, q) * point.area;
    mean_ += part * shear_at(point);
    area += part;
  }
  mean_ /= area;
}

BilinearShear::Point BilinearShear::point_at(const Eigen::Vector2d& xi) const {
  Point point;
  point.by_unit = derivatives(xi);
  point.tangents = corners_ * point.by_unit.transpose();
  const Vector3 across = Vector3(point.tangents.col(0)).cross(Vector3(point.tangents.col(1)));
  point.area = across.norm();
  const Vector3 normal = across.normalized();
  point.axes.col(0) = (along_ - normal * normal.dot(along_)).normalized();
  point.axes.col(1) = normal.cross(Vector3(point.axes.col(0)));
  return point;
}

Eigen::Matrix<double, 3, 4> BilinearShear::shear_at(const Point& point) {
  // d(place along the axes) / d xi
  const Eigen::Matrix2d jacobian = point.axes.transpose() * point.tangents;
  const Eigen::Matrix<double, 2, 4> by_place = jacobian.inverse().transpose() * point.by_unit;
  return point.axes.col(0) * by_place.row(1) + point.axes.col(1) * by_place.row(0);
}

BilinearShear::Excess BilinearShear::excess_at(const Eigen::Vector2d& xi, const Vector3& e_1,
                                               const Vector3& e_2) const {
  const Point point = point_at(xi);
  const Eigen::Vector2d a = point.axes.transpose() * e_1, b = point.axes.transpose() * e_2;
  return {shear_at(point) - mean_, {a[0] * a[1], b[0] * b[1], a[0] * b[1] + b[0] * a[1]}};
}

}  // namespace blocklift::structure
