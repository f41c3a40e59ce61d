// Loads by their sets.

#include <algorithm>
#include <memory>
#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/deck/label_range.h"
#include "structure/mesh/files/deck/line_loads.h"
#include "structure/mesh/files/nastran/line_loads.h"
#include "structure/mesh/files/nastran/model.h"
#include "structure/mesh/files/nastran/solid_faces.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Unit vector of a pressure, without length along the normal, and the system about a cylinder or
/// sphere in which it is given.
struct PressureDirection {
  Vector3 vector = Vector3::Zero();
  std::shared_ptr<const LocalSystem> system = nullptr;
};

class Loads {
 public:
  explicit Loads(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {
    for (std::size_t s = 0; s < mesh_.solids.size(); ++s)
      solid_of_[mesh_.solids[s].label] = static_cast<int>(s);
  }

  std::map<long, int> read() {
    const auto point = [&](bool is_moment) {
      return [this, is_moment](const CardView& card) { add_vector(card, is_moment); };
    };
    const auto along = [&](bool is_moment) {
      return [this, is_moment](const CardView& card) { add_along_grids(card, is_moment); };
    };
    model_.for_each({{"FORCE", point(false)},
                     {"MOMENT", point(true)},
                     {"FORCE1", along(false)},
                     {"MOMENT1", along(true)},
                     {"FORCE2", along(false)},
                     {"MOMENT2", along(true)},
                     {"GRAV", [&](const CardView& card) { add_gravity(card); }},
                     {"RFORCE", [&](const CardView& card) { add_spin(card); }},
                     {"PLOAD", [&](const CardView& card) { add_pressure_on_grids(card); }},
                     {"PLOAD2", [&](const CardView& card) { add_pressure(card); }},
                     {"PLOAD4", [&](const CardView& card) { add_corner_pressure(card); }},
                     {"PLOAD1", [&](const CardView& card) { add_line_load(card); }}});
    return set_of_;
  }

 private:
  LoadSet& set(const CardView& card) {
    const long label = card.label(0, "load set");
    auto& sets = model_.deck.load_sets;
    const auto [found, is_new] = set_of_.try_emplace(label, static_cast<int>(sets.size()));
    if (is_new) {
      sets.emplace_back();
      sets.back().label = label;
      sets.back().name = fmt::format("load set {}", label);
    }
    return sets[found->second];
  }

  double unit(bool is_moment) const {
    return is_moment ? model_.units.moment() : model_.units.force;
  }

  void add_point(const CardView& card, int vertex, const Vector3& value, bool is_moment) {
    PointLoad load;
    load.vertex = vertex;
    (is_moment ? load.moment : load.force) = value * unit(is_moment);
    set(card).point_loads.push_back(load);
  }

  // FORCE SID G CID F N1 N2 N3
  void add_vector(const CardView& card, bool is_moment) {
    const int vertex = model_.vertex(card, 1, "grid");
    const double factor = card.real(3, "factor");
    const Vector3 direction = direction_of(card, 4, factor != 0);
    const Eigen::Matrix3d axes = model_.axes_at(card.integer(2, "coordinate system", 0), vertex);
    add_point(card, vertex, factor * (axes * direction), is_moment);
  }

  /// Three components from a field on, which are not all zero where the load has a size.
  static Vector3 direction_of(const CardView& card, std::size_t first, bool has_size) {
    Vector3 direction(card.real(first, "component", 0.0), card.real(first + 1, "component", 0.0),
                      card.real(first + 2, "component", 0.0));
    if (!has_size || !direction.isZero(0)) return direction;
    std::string given;
    for (std::size_t i = first; i < first + 3; ++i)
      given += fmt::format("{}{}", i == first ? "" : ", ", card.has(i) ? card.text(i) : "blank");
    throw CardError{
        fmt::format("the direction of a load of set {} (fields {} to {}) is {}; at least one "
                    "component must not be zero",
                    card.text(0), first + 2, first + 4, given)};
  }

  // FORCE1 SID G F G1 G2: from G1 to G2; FORCE2 ... G3 G4: across G1 G2 and G3 G4
  void add_along_grids(const CardView& card, bool is_moment) {
    const int vertex = model_.vertex(card, 1, "grid");
    const auto between = [&](std::size_t i) -> Vector3 {
      return model_.place(model_.vertex(card, i + 1, "grid")) -
             model_.place(model_.vertex(card, i, "grid"));
    };
    Vector3 direction = between(3);
    if (card.name().back() == '2') direction = direction.cross(between(5));
    if (!(direction.norm() > 0))
      throw CardError{fmt::format("the grids of a load of set {} give no direction", card.text(0))};
    add_point(card, vertex, card.real(2, "magnitude") * direction.normalized(), is_moment);
  }

  // GRAV SID CID A N1 N2 N3
  void add_gravity(const CardView& card) {
    const double acceleration = card.real(2, "acceleration");
    const Vector3 direction = direction_of(card, 3, acceleration != 0);
    const long system = card.integer(1, "coordinate system", 0);
    const Eigen::Matrix3d axes = model_.systems.get(system).axes;
    set(card).gravity += acceleration * model_.units.length * (axes * direction);
  }

  // RFORCE SID G CID A R1 R2 R3 METHOD / RACC MB IDRF: revolutions per unit of time, and of its
  // square. By MSC's reference forces of the velocity act outwards, as inertia does, and those of
  // the acceleration along it, against inertia.
  void add_spin(const CardView& card) {
    if (card.has(9) && !card.is(9, "0"))
      throw CardError{"RFORCE for a part of a superelement (MB) is not known"};
    if (card.has(10) && !card.is(10, "0"))
      throw CardError{"RFORCE on some elements (IDRF) is not known; rotation of all is due"};
    const double velocity = card.real(3, "angular velocity", 0.0);
    const double acceleration = card.real(8, "angular acceleration", 0.0);
    const Vector3 direction = direction_of(card, 4, velocity != 0 || acceleration != 0);
    const Eigen::Matrix3d axes = model_.systems.get(card.integer(2, "coordinate system", 0)).axes;
    const Vector3 revolution = 2 * std::numbers::pi * (axes * direction);
    Spin spin;
    if (card.has(1) && !card.is(1, "0")) spin.place = model_.place(model_.vertex(card, 1, "grid"));
    spin.velocity = velocity * revolution;
    spin.acceleration = acceleration * revolution;
    set(card).spins.push_back(spin);
  }

  // PLOAD SID P G1 G2 G3 G4
  void add_pressure_on_grids(const CardView& card) {
    std::vector<int> corners;
    for (std::size_t i = 2; i < 6; ++i)
      if (card.has(i) && !card.is(i, "0")) corners.push_back(model_.vertex(card, i, "grid"));
    if (corners.size() < 3) throw CardError{"three or four grids are due"};
    const auto place = [&](std::size_t i) { return model_.place(corners[i % corners.size()]); };
    const Vector3 area = corners.size() == 4
                             ? Vector3(0.5 * (place(2) - place(0)).cross(place(3) - place(1)))
                             : Vector3(0.5 * (place(1) - place(0)).cross(place(2) - place(0)));
    const Vector3 force = card.real(1, "pressure") * model_.units.stress() * area;
    for (const int corner : corners) {
      PointLoad load;
      load.vertex = corner;
      load.force = force / static_cast<double>(corners.size());
      set(card).point_loads.push_back(load);
    }
  }

  /// Notes that a load is left out, and says so at its line, for its set lacks it.
  void leave_out(const CardView& card, const char* what) const {
    model_.log.leave_out(card.name(), what);
    model_.log.remark(card.line(), fmt::format("{}: a load of set {} is left out: {}", card.name(),
                                               card.text(0), what));
  }

  /// -1: an element that is no plate; a load of it is left out.
  int shell(const CardView& card, long label) const {
    const auto found = model_.shell_of.find(label);
    if (found != model_.shell_of.end()) return found->second;
    if (model_.any_elements.count(label) > 0) {
      leave_out(card, "pressure on what is no plate, or on solids without the grids of a face");
      return -1;
    }
    throw CardError{fmt::format("a pressure of set {} is on element {}, which does not exist",
                                card.text(0), label)};
  }

  void add_plate_load(const CardView& card, long label, std::array<double, 4> pressure,
                      const PressureDirection& direction) {
    PlateLoad load;
    load.shell = shell(card, label);
    if (load.shell < 0) return;
    for (double& value : pressure) value *= model_.units.stress();
    load.pressure = pressure;
    load.direction = direction.vector;
    load.system = direction.system;
    set(card).plate_loads.push_back(load);
  }

  void for_range(const CardView& card, long from, long to, const std::array<double, 4>& pressure,
                 const PressureDirection& direction) {
    const std::vector<long> labels = known_labels(model_.shell_of, from, to);
    for (const long label : labels) add_plate_load(card, label, pressure, direction);
    if (labels.empty()) shell(card, from);
  }

  // PLOAD2 SID P EID1 EID2 ... or EID1 THRU EID2
  void add_pressure(const CardView& card) {
    const double p = card.real(1, "pressure");
    const std::array<double, 4> pressure{p, p, p, p};
    if (card.is(3, "THRU")) {
      for_range(card, card.label(2, "element"), card.label(4, "element"), pressure, {});
      return;
    }
    (void)card.label(2, "element");  // one at least
    for (std::size_t i = 2; i < card.size(); ++i)
      if (card.has(i)) add_plate_load(card, card.label(i, "element"), pressure, {});
  }

  // The pressures go around the face from G1 on, as seen from outside.
  void add_solid_load(const CardView& card, int number, const std::array<double, 4>& around,
                      const PressureDirection& direction) {
    const Solid& solid = mesh_.solids[number];
    if (!card.has(6))
      throw CardError{
          fmt::format("element {} is a solid; the grids G1 and G3 or G4 that name its "
                      "loaded face are due",
                      solid.label)};
    FaceGrids grids{model_.vertex(card, 6, "grid G1")};
    if (card.has(7)) grids.second = model_.vertex(card, 7, "grid G3");
    SolidLoad load{number, face_of(solid, grids), {}, direction.vector, direction.system};
    if (load.face < 0)
      throw CardError{fmt::format(
          "the grids {} and {} name no face of element {}; G1 is on it, and G3 opposite (four "
          "corners), G4 not on it (CTETRA), G3 the other corner on the base (triangle of a CPYRAM) "
          "or nothing (triangle of a CPENTA)",
          card.text(6), card.has(7) ? card.text(7) : "none", solid.label)};
    const std::vector<int>& face = topology_of(solid.shape).faces[load.face];
    std::size_t corner = 0;
    while (solid.vertices[face[corner]] != grids.corner) ++corner;
    for (std::size_t i = 0; i < face.size(); ++i)
      load.pressure[(corner + i) % face.size()] = around[i] * model_.units.stress();
    set(card).solid_loads.push_back(load);
  }

  // CID N1 N2 N3 of PLOAD4: about a cylinder or sphere the direction turns over the surface.
  PressureDirection direction_of_pressure(const CardView& card) {
    if (!card.has(9) && !card.has(10) && !card.has(11)) return {};
    const Vector3 given(card.real(9, "component", 0.0), card.real(10, "component", 0.0),
                        card.real(11, "component", 0.0));
    if (!(given.norm() > 0)) throw CardError{"the direction of the pressure has no length"};
    LocalSystem system = model_.systems.get(card.integer(8, "coordinate system", 0));
    if (system.kind == SystemKind::rectangular) return {system.axes * given.normalized(), nullptr};
    system.origin *= model_.units.length;
    return {given.normalized(), std::make_shared<const LocalSystem>(system)};
  }

  // PLOAD4 SID EID P1 P2 P3 P4 THRU EID2 / CID N1 N2 N3 SORL LDIR; of solids G1 and G3 or G4 where
  // THRU and EID2 are
  void add_corner_pressure(const CardView& card) {
    const double first = card.real(2, "pressure");
    const std::array<double, 4> around{first, card.real(3, "pressure", first),
                                       card.real(4, "pressure", first),
                                       card.real(5, "pressure", first)};
    if ((card.has(12) && !card.is(12, "SURF")) || (card.has(13) && !card.is(13, "NORM"))) {
      leave_out(card, "loads with SORL and LDIR other than SURF and NORM");
      return;
    }
    const PressureDirection direction = direction_of_pressure(card);
    const long label = card.label(1, "element");
    const auto solid = solid_of_.find(label);
    if (solid != solid_of_.end() && !card.is(6, "THRU")) {
      add_solid_load(card, solid->second, around, direction);
      return;
    }
    const bool is_triangle =
        model_.shell_of.count(label) > 0 && mesh_.shells[model_.shell_of.at(label)].is_triangle();
    const std::array<double, 4> pressure{around[0], around[1], is_triangle ? around[2] : around[3],
                                         around[2]};
    if (card.is(6, "THRU"))
      for_range(card, label, card.label(7, "element"), pressure, direction);
    else
      add_plate_load(card, label, pressure, direction);
  }

  // PLOAD1 SID EID TYPE SCALE X1 P1 X2 P2
  void add_line_load(const CardView& card) {
    const long label = card.label(1, "element");
    if (model_.any_elements.count(label) == 0)
      throw CardError{fmt::format("a load of set {} is on element {}, which does not exist",
                                  card.text(0), label)};
    const auto found = model_.beam_of.find(label);
    const bool is_beam = found != model_.beam_of.end();
    const bool is_bar = is_beam && model_.offsets_of_bar.count(found->second) > 0;
    if (!is_bar && (is_beam || model_.shell_of.count(label) > 0 || solid_of_.count(label) > 0))
      throw CardError{fmt::format(
          "a load of set {} is on element {}, which is no CBAR or CBEAM: a rod bears none between "
          "its grids, where FORCE and MOMENT act, and other elements have PLOAD2 and PLOAD4",
          card.text(0), label)};
    if (!is_bar) {
      leave_out(card, "loads on what is no bar");
      return;
    }
    const std::vector<BeamLoad> loads = line_loads(model_, card, found->second);
    if (std::any_of(loads.begin(), loads.end(),
                    [&](const BeamLoad& load) { return acts_on_released_ends(mesh_, load); })) {
      leave_out(card, "loads along a motion that pin flags leave free");
      return;
    }
    remark_on_undivided(card, loads);
    std::vector<BeamLoad>& of_set = set(card).beam_loads;
    of_set.insert(of_set.end(), loads.begin(), loads.end());
  }

  /// Bars are divided where loads begin and end, but not along edges of plates.
  void remark_on_undivided(const CardView& card, const std::vector<BeamLoad>& loads) {
    const auto is_inside = [](double share) { return share > 0 && share < 1; };
    if (std::any_of(loads.begin(), loads.end(), [&](const BeamLoad& load) {
          return !mesh_.beams[load.beam].is_rod &&
                 (is_inside(load.span[0]) || is_inside(load.span[1]));
        }))
      model_.log.remark(card.line(),
                        "PLOAD1: loads begin or end between the grids of bars along edges of "
                        "plates, which are not divided there: their largest moment may be missed");
  }

  NastranModel& model_;
  Mesh& mesh_;
  std::map<long, int> set_of_;
  std::unordered_map<long, int> solid_of_;  ///< places in the mesh by their numbers
};

}  // namespace

std::map<long, int> read_nastran_loads(NastranModel& model) { return Loads(model).read(); }

}  // namespace blocklift::structure
