#include "structure/rigid_body.h"

#include <Eigen/Dense>

#include "algebra/decompositions.h"

namespace blocklift::structure {

InertiaField InertiaField::at_rest(const Vector3& gravity_B) {
  InertiaField field;
  field.acceleration_less_gravity = -gravity_B;
  return field;
}

InertiaField InertiaField::moving(const Vector3& acceleration_B, const Vector3& gravity_B,
                                  const Vector3& angular_acceleration_B, const Vector3& w) {
  InertiaField field;
  field.acceleration_less_gravity = acceleration_B - gravity_B;
  field.angular_acceleration = angular_acceleration_B;
  field.angular_velocity_products << w.x() * w.x(), w.y() * w.y(), w.z() * w.z(), w.x() * w.y(),
      w.y() * w.z(), w.z() * w.x();
  return field;
}

Eigen::Matrix<double, 12, 1> InertiaField::coefficients() const {
  Eigen::Matrix<double, 12, 1> all;
  all << acceleration_less_gravity, angular_acceleration, angular_velocity_products;
  return all;
}

Wrench resultant(const Eigen::Matrix3Xd& nodes, const Eigen::Ref<const Eigen::VectorXd>& load) {
  Wrench sum;
  for (Eigen::Index n = 0; n < nodes.cols(); ++n) {
    const Vector3 force = load.segment<3>(3 * n);
    sum.force += force;
    sum.moment += nodes.col(n).cross(force);
  }
  return sum;
}

InertiaField balancing_field(const MassProperties& mass, const Wrench& wrench) {
  // Newton-Euler about the centre of mass, then the acceleration of B's origin.
  const Vector3& c = mass.centre_of_mass_B;
  InertiaField field;
  field.angular_acceleration =
      algebra::solve_symmetric<3>(mass.inertia_BBcm_B, wrench.moment - c.cross(wrench.force));
  field.acceleration_less_gravity = wrench.force / mass.mass - field.angular_acceleration.cross(c);
  return field;
}

}  // namespace blocklift::structure
