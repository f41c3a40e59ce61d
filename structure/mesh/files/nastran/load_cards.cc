#include "structure/mesh/files/nastran/load_cards.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "structure/mesh/files/deck/coordinate_systems.h"

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
  if (!set.pulls.empty()) throw ModelError("gravity on a part of the masses: Nastran knows none");
  for (const Spin& spin : set.spins) {
    if (spin.part) throw ModelError("rotation of a part of the masses: Nastran knows none");
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

void PressureCards::write(std::vector<CardField> fields, const Vector3& direction,
                          const std::shared_ptr<const LocalSystem>& system) {
  if (!direction.isZero()) {
    fields.resize(8);
    // Without CID: along the basic axes.
    fields.push_back(system ? CardField(number_of(system)) : CardField());
    for (const double component : direction) fields.emplace_back(component);
  }
  out_.card("PLOAD4", std::move(fields));
}

long PressureCards::number_of(const std::shared_ptr<const LocalSystem>& system) {
  constexpr long first = 10'000'000;  // beyond the numbers of straight systems
  const auto found = std::find(systems_.begin(), systems_.end(), system);
  const long number = first + (found - systems_.begin());
  if (found != systems_.end()) return number;
  systems_.push_back(system);
  const Vector3 origin = system->origin / units_.length;
  std::vector<CardField> fields{number, 0L};
  for (const Vector3& point : {origin, Vector3(origin + system->axes.col(2)),
                               Vector3(origin + system->axes.col(0) + system->axes.col(2))})
    for (const double coordinate : point) fields.emplace_back(coordinate);
  out_.card(system->kind == SystemKind::cylindrical ? "CORD2C" : "CORD2S", std::move(fields));
  return number;
}

}  // namespace blocklift::structure
