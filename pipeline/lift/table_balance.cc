#include "pipeline/lift/table_balance.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

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

std::vector<structure::Vector3> table_forces(const LoadTable& table,
                                             const std::vector<Named<double>>& loads,
                                             const std::vector<structure::LiftingPoint>& lugs) {
  std::vector<structure::Vector3> forces(lugs.size(), structure::Vector3::Zero());
  for (const Named<double>& load : loads) {
    for (std::size_t i = 0; i < lugs.size(); ++i) {
      if (lugs[i].name == load.name.value)
        forces[i] = load.value * table.direction_at(lugs[i].name);
    }
  }
  return forces;
}

TableBalance find_table_balance(const LoadTable& table, const std::vector<Named<double>>& loads,
                                const structure::ElasticModel& model, double gravity) {
  const std::vector<structure::LiftingPoint>& lugs = model.mesh().lifting_points;
  return find_table_balance(table_forces(table, loads, lugs), lugs, model.mass_properties(),
                            gravity);
}

void check_that_table_lifts(const LoadTable& table, const TableBalance& at_rest,
                            Diagnostics& diagnostics) {
  const std::string sum = fmt::format(
      "the static loads of the load table sum to ({:.4g}, {:.4g}, {:.4g}) kN in the block's frame",
      at_rest.force_B.x() / 1e3, at_rest.force_B.y() / 1e3, at_rest.force_B.z() / 1e3);
  if (at_rest.bears_nothing())
    diagnostics.error(table.place, fmt::format("{}, which bears nothing of its weight, {:.4g} kN",
                                               sum, at_rest.weight / 1e3));
  else if (at_rest.presses_down())
    diagnostics.error(table.place, sum + ": they press the block down at its lugs",
                      {"direction is that of the pull on the block, [0, 0, 1] for plumb ropes"});
}

}  // namespace blocklift::pipeline
