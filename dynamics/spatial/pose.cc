#include "dynamics/spatial/pose.h"

#include <cmath>

namespace blocklift::dynamics {

Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(),  //
      a.z(), 0, -a.x(),   //
      -a.y(), a.x(), 0;
  return m;
}

Matrix3 rotation_about(const Vector3& unit_axis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Matrix3 outer = unit_axis * unit_axis.transpose();
  return outer + c * (Matrix3::Identity() - outer) + s * skew(unit_axis);
}

Matrix3 rotation_from_quaternion(const Vector4& quaternion) {
  const double w = quaternion[0];
  const double x = quaternion[1];
  const double y = quaternion[2];
  const double z = quaternion[3];
  const double f = 2.0 / quaternion.squaredNorm();
  Matrix3 R;
  R << 1 - f * (y * y + z * z), f * (x * y - w * z), f * (x * z + w * y),  //
      f * (x * y + w * z), 1 - f * (x * x + z * z), f * (y * z - w * x),   //
      f * (x * z - w * y), f * (y * z + w * x), 1 - f * (x * x + y * y);
  return R;
}

Vector4 quaternion_from_rotation(const Matrix3& R) {
  const Eigen::Quaterniond e(R);
  Vector4 quaternion(e.w(), e.x(), e.y(), e.z());
  if (quaternion[0] < 0) quaternion = -quaternion;
  return quaternion.normalized();
}

Vector4 quaternion_product(const Vector4& a, const Vector4& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Vector4 quaternion_exponential(const Vector3& rotation_vector) {
  const double angle = rotation_vector.norm();
  const double half = 0.5 * angle;
  // sin(x)/x by its series where the quotient would lose digits or divide by zero.
  const double half_sinc = angle > 1e-4 ? std::sin(half) / angle : 0.5 * (1.0 - half * half / 6.0);
  return {std::cos(half), half_sinc * rotation_vector.x(), half_sinc * rotation_vector.y(),
          half_sinc * rotation_vector.z()};
}

Vector3 rotation_vector(const Vector4& quaternion) {
  // Both signs of a quaternion mean one rotation; w >= 0 gives the shorter way round.
  const double sign = quaternion[0] < 0 ? -1.0 : 1.0;
  const Vector3 imaginary = sign * quaternion.tail<3>();
  const double w = sign * quaternion[0];
  const double n = imaginary.norm();
  // Near zero, 2 atan2(n, w) / n -> 2/w (1 - (n/w)^2 / 3).
  const double factor =
      n > 1e-6 * w ? 2.0 * std::atan2(n, w) / n : 2.0 / w * (1.0 - n * n / (3.0 * w * w));
  return factor * imaginary;
}

Vector4 quaternion_rate(const Vector4& quaternion, const Vector3& w_AB_B) {
  return 0.5 * quaternion_product(quaternion, Vector4(0, w_AB_B.x(), w_AB_B.y(), w_AB_B.z()));
}

}  // namespace blocklift::dynamics
