#include "structure/mesh/files/nastran/load_cards.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace blocklift::structure {

namespace {

/// @param field of the factor, in revolutions.
void write_turning(long label, const Vector3& radians, std::size_t field, CardWriter& out) {
  if (radians.isZero(0)) return;
  std::vector<CardField> fields{label, 0L, 0L, 0.0};
  const Vector3 revolutions = radians / (2 * std::numbers::pi);
  for (const double component : revolutions) fields.emplace_back(component);
  fields.resize(std::max<std::size_t>(fields.size(), field + 1));
  fields[field] = CardField(1.0);
  out.card("RFORCE", std::move(fields));
}

}  // namespace

void write_loads_of_masses(const LoadSet& set, long label, const UnitSystem& units,
                           CardWriter& out) {
  constexpr std::size_t of_velocity = 3, of_acceleration = 8;
  Vector3 gravity = set.gravity;
  for (const Spin& spin : set.spins) {
    const Vector3& w = spin.velocity;
    gravity += w.cross(w.cross(spin.place)) - spin.acceleration.cross(spin.place);
    write_turning(label, w, of_velocity, out);
    write_turning(label, spin.acceleration, of_acceleration, out);
  }
  if (gravity.isZero()) return;
  gravity /= units.length;
  std::vector<CardField> fields{label, 0L, 1.0};
  for (const double component : gravity) fields.emplace_back(component);
  out.card("GRAV", std::move(fields));
}

}  // namespace blocklift::structure
