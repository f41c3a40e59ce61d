#include "dynamics/spatial/spatial_inertia.h"

namespace blocklift::dynamics {

ForceVector RigidBodyInertia::operator*(const MotionVector& V) const {
  const Vector3 momentum = mass * (V.linear + V.angular.cross(p_BoBcm));
  return {I_BBcm * V.angular + p_BoBcm.cross(momentum), momentum};
}

RigidBodyInertia transform(const Pose& X_AB, const RigidBodyInertia& inertia_B) {
  return {inertia_B.mass, X_AB.apply(inertia_B.p_BoBcm), rotate(X_AB.R, inertia_B.I_BBcm)};
}

RigidBodyInertia operator+(const RigidBodyInertia& a, const RigidBodyInertia& b) {
  RigidBodyInertia sum{a.mass + b.mass, a.p_BoBcm, a.I_BBcm};
  sum.I_BBcm += b.I_BBcm;
  if (sum.mass == 0) return sum;
  const Vector3 d = b.p_BoBcm - a.p_BoBcm;
  sum.p_BoBcm += b.mass / sum.mass * d;
  // Steiner's theorem for both about the common centre: reduced mass times (d^2 1 - d d^T).
  const double reduced = a.mass * b.mass / sum.mass;
  const double square = reduced * d.squaredNorm();
  sum.I_BBcm += Symmetric3{square, 0, 0, square, 0, square};
  sum.I_BBcm.add_outer(-reduced, d);
  return sum;
}

SpatialInertia SpatialInertia::of(const RigidBodyInertia& body) {
  const Vector3& c = body.p_BoBcm;
  const double square = body.mass * c.squaredNorm();
  SpatialInertia inertia{
      body.I_BBcm, body.mass * skew(c), {body.mass, 0, 0, body.mass, 0, body.mass}};
  inertia.J += Symmetric3{square, 0, 0, square, 0, square};
  inertia.J.add_outer(-body.mass, c);
  return inertia;
}

Eigen::Matrix<double, 6, 6> SpatialInertia::matrix() const {
  Eigen::Matrix<double, 6, 6> m;
  m << J.matrix(), H, H.transpose(), M.matrix();
  return m;
}

SpatialInertia rotate(const Matrix3& R_AB, const SpatialInertia& inertia_B) {
  return {rotate(R_AB, inertia_B.J), R_AB * inertia_B.H * R_AB.transpose(),
          rotate(R_AB, inertia_B.M)};
}

}  // namespace blocklift::dynamics
