#include "structure/mesh/files/nastran/load_cards.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/deck/coordinate_systems.h"
#include "structure/mesh/files/deck/line_loads.h"

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

void write_component(const std::string& type, const BeamLoad& load, double from, double to,
                     std::vector<CardField> fields, CardWriter& out) {
  if (from == 0 && to == 0) return;
  for (const CardField& field :
       {CardField(type), CardField("FR"), CardField(load.span[0]), CardField(from)})
    fields.push_back(field);
  if (!load.is_at_a_place()) {
    fields.emplace_back(load.span[1]);
    fields.emplace_back(to);
  }
  out.card("PLOAD1", std::move(fields));
}

}  // namespace

void write_line_load(const Mesh& mesh, const BeamLoad& load, long set, long number,
                     const std::array<Vector3, 2>& offsets, const UnitSystem& units,
                     CardWriter& out) {
  constexpr double rounding = 1e-9;
  const auto& vertices = mesh.beams[load.beam].vertices;
  const Vector3 line = mesh.vertices[vertices[1]] - mesh.vertices[vertices[0]];
  double stretch = 1, length = 1;
  if (!load.is_at_a_place()) {
    stretch = (line + load.arm[1] - load.arm[0]).norm() / (line + offsets[1] - offsets[0]).norm();
    length = units.length;
  }
  std::array<Vector3, 2> beside{load.arm[0] - offsets[0], load.arm[1] - offsets[1]};
  for (Vector3& arm : beside)
    if (arm.norm() < rounding * line.norm()) arm.setZero();
  // Per length of the line that the card is about, not of the one that bears the load.
  const auto on_line = [&](double share_of_span) {
    const LoadAtPlace here = load_at(load, beside, share_of_span);
    return LoadAtPlace{stretch * here.force, stretch * here.moment};
  };
  const LoadAtPlace from = on_line(0), middle = on_line(0.5),
                    to = on_line(load.is_at_a_place() ? 0 : 1);
  const Vector3 bulge = middle.moment - (from.moment + to.moment) / 2;
  if (!load.is_at_a_place() && bulge.norm() > rounding * line.norm() * middle.force.norm())
    throw ModelError(
        fmt::format("beam {}: a load beside the line that its offsets lead to, whose "
                    "moments are not linear in place, is not written here",
                    mesh.beams[load.beam].label));
  for (int i = 0; i < 3; ++i) {
    const char axis = static_cast<char>('X' + i);
    const double force = length / units.force, moment = length / units.moment();
    write_component(std::string("F") + axis, load, force * from.force[i], force * to.force[i],
                    {set, number}, out);
    write_component(std::string("M") + axis, load, moment * from.moment[i], moment * to.moment[i],
                    {set, number}, out);
  }
}

void write_loads_of_masses(const LoadSet& set, long label, const UnitSystem& units,
                           CardWriter& out) {
  constexpr std::size_t of_velocity = 3, of_acceleration = 8;
  if (!set.edge_loads.empty() || !set.volume_loads.empty())
    throw ModelError("loads of edges or per volume: Nastran knows none");
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
