#include "structure/elasticity/bearing_load.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"

namespace blocklift::structure {

namespace {

using Vector2 = Eigen::Vector2d;
using Vector4 = Eigen::Vector4d;

/// Integration point on the hole.
struct HolePoint {
  int element = 0;
  Eigen::Index rule_point = 0;
  double area = 0;                     ///< its share of the hole, m^2
  Vector2 off = Vector2::Zero();       ///< from the axis, in the axes across, m
  double along = 0;                    ///< from the load's point along the axis, m
  Vector2 outwards = Vector2::Zero();  ///< from the axis into the plate, unit, in the axes across
};

/// Axes across the hole's own.
Eigen::Matrix<double, 3, 2> axes_across(const Vector3& axis) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = axis.unitOrthogonal();
  across.col(1) = axis.cross(across.col(0));
  return across;
}

std::vector<HolePoint> find_points(const PartMesh& mesh, const SurfaceLoad& load,
                                   const PartGroup& hole,
                                   const Eigen::Matrix<double, 3, 2>& across) {
  std::vector<HolePoint> points;
  for (const int element : hole.elements) {
    const ElementKind& kind = mesh.kind(element);
    const Eigen::Matrix3Xd places = mesh.places(element);
    for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
      const Eigen::Matrix3d tangents = places * kind.gradients.middleRows<3>(3 * q).transpose();
      const Vector3 place = places * kind.values.row(q).transpose();
      const Vector2 radius = across.transpose() * (place - load.point);
      if (!(radius.norm() > 0))
        throw ModelError(fmt::format("load {}: {} lies on the axis of its hole", load.name,
                                     mesh.describe(element)));
      points.push_back({element, q, kind.weights[q] * tangents.col(0).cross(tangents.col(1)).norm(),
                        radius, load.axis.dot(place - load.point), radius.normalized()});
    }
  }
  return points;
}

/// Pressure at a point of the hole: the positive part of g . x with g = (n, s n), s = along / half
/// the hole's length.
class Pressure {
 public:
  Pressure(const std::vector<HolePoint>& points, const Vector2& force) : points_(points) {
    for (const HolePoint& point : points) {
      area_ += point.area;
      reach_ = std::max(reach_, std::abs(point.along));
    }
    if (force.norm() > 0) find(force);
  }

  double at(const HolePoint& point) const { return std::max(0.0, direction(point).dot(x_)); }

 private:
  Vector4 direction(const HolePoint& point) const {
    Vector4 g;
    g << point.outwards, point.along / reach_ * point.outwards;
    return g;
  }

  // sum area max(0, g . x) g = (force, 0): Newton's method on the gradient of a convex function
  // that is quadratic between the places where points come to bear or cease to.
  void find(const Vector2& force) {
    Vector4 due = Vector4::Zero();
    due.head<2>() = force;
    x_ = 4 / area_ * due;  // right for a whole, even hole
    constexpr int most = 100;
    for (int i = 0; i < most; ++i) {
      Vector4 lacking = due;
      Eigen::Matrix4d slope = Eigen::Matrix4d::Zero();
      for (const HolePoint& point : points_) {
        const Vector4 g = direction(point);
        const double pressure = g.dot(x_);
        if (pressure <= 0) continue;
        lacking -= point.area * pressure * g;
        slope += point.area * g * g.transpose();
      }
      if (lacking.norm() <= 1e-15 * force.norm()) return;
      const Vector4 step = algebra::solve_symmetric(slope, lacking);
      if (!step.allFinite() || step.norm() <= 1e-16 * x_.norm()) return;
      x_ += step;
    }
  }

  const std::vector<HolePoint>& points_;
  double area_ = 0, reach_ = 0;
  Vector4 x_ = Vector4::Zero();
};

/// a, b, c of the traction along the axis: its sum is 1, its moments about the axes across vanish.
Eigen::Vector3d unit_axial_traction(const std::vector<HolePoint>& points) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  for (const HolePoint& point : points)
    matrix += point.area * Eigen::Vector3d(1, point.off.x(), point.off.y()) *
              Eigen::RowVector3d(1, point.outwards.x(), point.outwards.y());
  return algebra::solve_square(matrix, Eigen::Vector3d::UnitX());
}

}  // namespace

void add_bearing_load(const PartMesh& mesh, const SurfaceLoad& load, const PartGroup& hole,
                      Eigen::VectorXd& forces) {
  if (hole.dimension != 2)
    throw ModelError(fmt::format("load {} bears on a hole's faces, but group \"{}\" holds none",
                                 load.name, load.group));
  const Eigen::Matrix<double, 3, 2> across = axes_across(load.axis);
  const std::vector<HolePoint> points = find_points(mesh, load, hole, across);
  const Vector2 radial = across.transpose() * load.vector;
  const Pressure pressure(points, radial);
  Vector2 found = Vector2::Zero();
  for (const HolePoint& point : points) found += point.area * pressure.at(point) * point.outwards;
  if (!((found - radial).norm() <= 1e-10 * radial.norm()))
    throw ModelError(fmt::format(
        "load {}: group \"{}\" cannot bear a force in that direction: it is no whole hole, or the "
        "load's point lies far outside of it",
        load.name, load.group));
  const Eigen::Vector3d axial = load.axis.dot(load.vector) * unit_axial_traction(points);
  for (const HolePoint& point : points) {
    const Vector3 traction = across * (pressure.at(point) * point.outwards) +
                             (axial[0] + axial.tail<2>().dot(point.outwards)) * load.axis;
    const ElementKind& kind = mesh.kind(point.element);
    for (int i = 0; i < kind.nodes; ++i)
      forces.segment<3>(3 * mesh.node(point.element, i)) +=
          point.area * kind.values(point.rule_point, i) * traction;
  }
}

}  // namespace blocklift::structure
