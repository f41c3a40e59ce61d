#include "structure/practice/hot_spot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "algebra/decompositions.h"

namespace blocklift::structure {

Eigen::Matrix<double, 1, 6> normal_component(const Vector3& n) {
  Eigen::Matrix<double, 1, 6> row;
  row << n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), 2 * n.x() * n.y(), 2 * n.y() * n.z(),
      2 * n.z() * n.x();
  return row;
}

HotSpotStress evaluate_hot_spot(const Stress& structural, const Vector3& direction) {
  const Stress& s = structural;
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const algebra::SymmetricEigensystem<3> axes = algebra::symmetric_eigensystem(tensor);
  const int largest = std::abs(axes.values[2]) >= std::abs(axes.values[0]) ? 2 : 0;
  HotSpotStress result;
  result.normal = normal_component(direction) * s;
  result.principal = axes.values[largest];
  result.angle =
      std::acos(std::min(1.0, std::abs(Vector3(axes.vectors.col(largest)).dot(direction))));
  result.governing = result.angle <= std::numbers::pi / 3 ? result.principal : result.normal;
  return result;
}

}  // namespace blocklift::structure
