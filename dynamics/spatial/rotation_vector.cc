#include "dynamics/spatial/rotation_vector.h"

#include <cmath>

namespace blocklift::dynamics {

Matrix3 inverse_left_jacobian(const Vector3& theta) {
  const double angle = theta.norm();
  const double square = angle < 1e-4
                            ? 1.0 / 12.0 + angle * angle / 720.0
                            : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  const Matrix3 cross = skew(theta);
  return Matrix3::Identity() - 0.5 * cross + square * cross * cross;
}

}  // namespace blocklift::dynamics
