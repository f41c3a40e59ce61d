#include "pipeline/lift/table_balance.h"

#include <cmath>

namespace blocklift::pipeline {

double TableBalance::lever() const {
  const double force = force_B.norm();
  return force > 0 ? moment_B.norm() / force : 0;
}

bool TableBalance::bears_nothing() const {
  constexpr double least = 0.01;
  return over_weight() < least;
}

bool TableBalance::presses_down() const {
  constexpr double level = 1e-6;  // rounding of directions
  return force_B.z() < -level * force_B.norm() && drawing < 0;
}

bool TableBalance::is_off_weight() const { return std::abs(acceleration()) > largest_share; }

bool TableBalance::turns() const { return lever() > largest_lever * radius_of_gyration; }

TableBalance find_table_balance(const std::vector<structure::Vector3>& lug_forces_B,
                                const std::vector<structure::LiftingPoint>& lugs,
                                const structure::MassProperties& mass, double gravity) {
  TableBalance balance;
  for (std::size_t i = 0; i < lug_forces_B.size(); ++i) {
    const structure::Vector3 arm = lugs[i].p_BPin - mass.centre_of_mass_B;
    balance.force_B += lug_forces_B[i];
    balance.moment_B += arm.cross(lug_forces_B[i]);
    balance.drawing += arm.dot(lug_forces_B[i]);
  }
  balance.angular_acceleration_B =
      map_load_table(lug_forces_B, lugs, mass).field.angular_acceleration;
  balance.weight = mass.mass * gravity;
  balance.radius_of_gyration = std::sqrt(mass.inertia_BBcm_B.trace() / (3 * mass.mass));
  return balance;
}

}  // namespace blocklift::pipeline
